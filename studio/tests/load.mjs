// Loads a module of the page for tests in node.
import { build } from "esbuild";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const page = join(dirname(fileURLToPath(import.meta.url)), "../page");

export async function load(name) {
    const made = await build({
        entryPoints: [join(page, `${name}.ts`)],
        bundle: true,
        write: false,
        format: "esm",
        platform: "neutral",
        target: "es2022",
        logLevel: "warning",
    });
    return import(`data:text/javascript;base64,${Buffer.from(made.outputFiles[0].text).toString("base64")}`);
}
