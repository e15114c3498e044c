// The npm package `sikku` in node.
import type { Sikku } from "./index.js";
import { startFrom } from "./start.js";

export * from "./index.js";

/**
 * Loads the libraries, which takes about 0.2 s. Each call makes an instance of its own.
 * @param wasm  the bytes of sikku.wasm; by default those beside this file
 */
export async function start(wasm?: BufferSource): Promise<Sikku> {
    const { readFile } = await import("node:fs/promises");
    return startFrom(wasm ? Promise.resolve(wasm) : readFile(new URL("./sikku.wasm", import.meta.url)));
}
