// The npm package `sikku` in browsers and their workers.
import type { Sikku } from "./index.js";
import { startFrom } from "./start.js";

export * from "./index.js";

/**
 * Loads the libraries. Each call makes an instance of its own.
 * @param wasm  the bytes of sikku.wasm, or its address; by default beside this file
 */
export async function start(wasm: BufferSource | string | URL = new URL("./sikku.wasm", import.meta.url)): Promise<Sikku> {
    const load = async (address: string | URL): Promise<ArrayBuffer> => {
        const answer = await fetch(address);
        if (!answer.ok) throw new Error(`${address}: ${answer.status} ${answer.statusText}`);
        return answer.arrayBuffer();
    };
    return startFrom(typeof wasm === "string" || wasm instanceof URL ? load(wasm) : Promise.resolve(wasm));
}
