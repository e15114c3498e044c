// The libraries for tests that need only their answers: as WebAssembly if that is built, otherwise natively.
import { spawnSync } from "node:child_process";
import { existsSync } from "node:fs";
import { join } from "node:path";
import { loadBridge, root } from "../load_bridge.mjs";

const folder = join(root, "build/studio");
const isBuilt = ["sikku-bridge.wasm", "sikku-bridge.cjs"].every((name) => existsSync(join(folder, name)));
const native = join(root, "build/dev/bin/sikku-bridge");

/// Returns a function from a request, and the bytes of a file, to the answer's JSON; its member `whole` returns the
/// bytes of the answer, too.
export async function anyBridge() {
    if (isBuilt && !process.env.NATIVE) {
        const bridge = await loadBridge();
        return askBy((text, bytes) => bridge(text, bytes));
    }
    return askBy((request, bytes = new Uint8Array()) => {
        const text = Buffer.from(request);
        const input = Buffer.concat([Buffer.from(`${text.length} ${bytes.length}\n`), text, bytes]);
        const { stdout } = spawnSync(native, { input, maxBuffer: 1 << 26 });
        const end = stdout.indexOf(10);
        const size = Number(stdout.subarray(0, end).toString().split(" ")[0]);
        const rest = stdout.subarray(end + 1);
        return { json: rest.subarray(0, size).toString(), bytes: rest.subarray(size) };
    });
}

function askBy(answer) {
    const whole = (request, bytes) => {
        const made = answer(JSON.stringify(request), bytes);
        return { json: JSON.parse(made.json), bytes: made.bytes };
    };
    return Object.assign((request, bytes) => whole(request, bytes).json, { whole });
}
