// Calls the WebAssembly module: see studio/wasm/module.cpp.
import { makeZlib } from "./zlib";

export interface RawAnswer {
    json: string;
    bytes: Uint8Array;
    memory: number; // bytes that the module holds; it never gives any back
}
export type Bridge = (json: string, bytes?: Uint8Array) => RawAnswer;

/// Hooks that use a compiled module and print nothing. @param failed  called if it cannot be instantiated
export function hooksOf(module: WebAssembly.Module, failed: (error: unknown) => void): object {
    return {
        instantiateWasm(imports: WebAssembly.Imports, done: (instance: WebAssembly.Instance) => void) {
            WebAssembly.instantiate(module, imports).then(done, failed);
            return {};
        },
        print: () => {},
        printErr: () => {},
    };
}

/// Starts the module. `makeModule` is the default export of sikku-bridge.cjs; `hooks` may contain `instantiateWasm`.
export async function startBridge(makeModule: (hooks: object) => Promise<any>, hooks: object = {}): Promise<Bridge> {
    const module = await makeModule({ zlib: makeZlib(), ...hooks });
    const encoder = new TextEncoder();
    const decoder = new TextDecoder();
    const put = (bytes: Uint8Array): number => {
        const at: number = module._malloc(Math.max(bytes.length, 1)) >>> 0; // addresses over 2 GB come as negative numbers
        if (at === 0) throw new Error("not enough memory");
        module.HEAPU8.set(bytes, at);
        return at;
    };
    const none = new Uint8Array(0);
    return (json, bytes = none) => {
        const text = encoder.encode(json);
        const textAt = put(text);
        const bytesAt = put(bytes);
        try {
            module._sikku_request(textAt, text.length, bytesAt, bytes.length);
        } finally {
            module._free(textAt);
            module._free(bytesAt);
        }
        const taken = (at: number, size: number): Uint8Array => module.HEAPU8.slice(at >>> 0, (at >>> 0) + (size >>> 0));
        return {
            json: decoder.decode(taken(module._sikku_json(), module._sikku_json_size())),
            bytes: taken(module._sikku_bytes(), module._sikku_bytes_size()),
            memory: module.HEAPU8.length,
        };
    };
}
