// Starts the libraries as WebAssembly under node.
import { build } from "esbuild";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";

export const root = resolve(dirname(fileURLToPath(import.meta.url)), "..");

export async function loadBridge(module_folder = join(root, "build/studio")) {
    const folder = mkdtempSync(join(tmpdir(), "sikku-bridge-"));
    const script = join(folder, "bridge.mjs");
    await build({
        entryPoints: [join(root, "studio/npm/bridge.ts")], bundle: true, format: "esm", outfile: script,
        logLevel: "warning",
    });
    const { startBridge } = await import(pathToFileURL(script));
    rmSync(folder, { recursive: true });
    const makeModule = createRequire(import.meta.url)(join(module_folder, "sikku-bridge.cjs"));
    const wasm = new WebAssembly.Module(readFileSync(join(module_folder, "sikku-bridge.wasm")));
    return startBridge(makeModule, {
        instantiateWasm(imports, done) {
            const instance = new WebAssembly.Instance(wasm, imports);
            done(instance);
            return instance.exports;
        },
    });
}
