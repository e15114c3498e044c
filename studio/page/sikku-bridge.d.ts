// The C++ libraries as Emscripten's glue loads them: see bridge.ts.
declare module "sikku-bridge" {
    export default function makeModule(hooks: object): Promise<unknown>;
}
