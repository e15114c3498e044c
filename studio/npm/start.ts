// Starts the libraries from the bytes of sikku.wasm.
import makeModule from "sikku-bridge";
import { hooksOf, startBridge } from "./bridge.js";
import { Sikku } from "./index.js";

export async function startFrom(wasm: Promise<BufferSource>): Promise<Sikku> {
    const module = await WebAssembly.compile(await wasm);
    return new Sikku(
        await new Promise((resolve, reject) => {
            startBridge(makeModule, hooksOf(module, reject)).then(resolve, reject);
        }),
    );
}
