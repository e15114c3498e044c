// The libraries for tests that need only their answers: as WebAssembly if that is built, otherwise natively.
import { spawnSync } from "node:child_process";
import { existsSync } from "node:fs";
import { join } from "node:path";
import { loadBridge, root } from "./load_bridge.mjs";

const folder = join(root, "build/studio");
const isBuilt = ["sikku-bridge.wasm", "sikku-bridge.cjs"].every((name) => existsSync(join(folder, name)));
const native = join(root, "build/dev/bin/sikku-bridge");

/// Returns a function from a request to the answer's JSON.
export async function anyBridge() {
    if (isBuilt && !process.env.NATIVE) {
        const bridge = await loadBridge();
        return (request) => JSON.parse(bridge(JSON.stringify(request)).json);
    }
    return (request) => {
        const text = Buffer.from(JSON.stringify(request));
        const input = Buffer.concat([Buffer.from(`${text.length} 0\n`), text]);
        const { stdout } = spawnSync(native, { input, maxBuffer: 1 << 26 });
        const end = stdout.indexOf(10);
        const size = Number(stdout.subarray(0, end).toString().split(" ")[0]);
        return JSON.parse(stdout.subarray(end + 1, end + 1 + size).toString());
    };
}
