// The C++ libraries as Emscripten's glue loads them: see studio/bridge.cpp.
declare module "sikku-bridge" {
    export interface Bridge {
        request(json: string, bytes: Uint8Array): { json: string; bytes: Uint8Array };
    }
    export default function start(options: {
        instantiateWasm(
            imports: WebAssembly.Imports,
            done: (instance: WebAssembly.Instance, module: WebAssembly.Module) => void,
        ): object;
        [hook: string]: unknown;
    }): Promise<Bridge>;
}
