// Builds the npm package `sikku` in build/npm and packs it.
//     node npm/build.mjs [--bridge FOLDER] [--output FOLDER]
// FOLDER of the bridge contains sikku-bridge.cjs and sikku-bridge.wasm; the archive goes to the other.
import { build } from "esbuild";
import { execFileSync } from "node:child_process";
import { chmodSync, copyFileSync, mkdirSync, readFileSync, rmSync, statSync, writeFileSync } from "node:fs";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { parseArgs } from "node:util";
import { notices } from "../notices.mjs";

const most_bytes = 2_500_000;
const here = dirname(fileURLToPath(import.meta.url));
const root = resolve(here, "../..");
const { values } = parseArgs({
    options: {
        bridge: { type: "string", default: join(root, "build/studio") },
        output: { type: "string", default: join(root, "build") },
    },
});
const folder = join(root, "build/npm");
rmSync(folder, { recursive: true, force: true });
mkdirSync(folder, { recursive: true });

// The module's own code asks for parts of node where it runs in node.
const node_head =
    'import { createRequire } from "node:module";\nimport { dirname as folderOf } from "node:path";\n' +
    'import { fileURLToPath as pathOf } from "node:url";\nconst require = createRequire(import.meta.url);\n' +
    "const __filename = pathOf(import.meta.url), __dirname = folderOf(__filename);";
for (const [entry, banner] of [["node", node_head], ["browser", ""]]) {
    await build({
        entryPoints: [join(here, `${entry}.ts`)],
        outfile: join(folder, `${entry}.js`),
        alias: { "sikku-bridge": join(values.bridge, "sikku-bridge.cjs") },
        bundle: true,
        format: "esm",
        platform: entry === "node" ? "node" : "browser",
        target: "es2022",
        minifySyntax: true,
        minifyWhitespace: true,
        charset: "utf8",
        legalComments: "none",
        logLevel: "warning",
        banner: { js: banner },
        external: ["module", "fs", "path", "url", "crypto", "worker_threads"],
    });
}
execFileSync(
    "npx",
    ["tsc", "--noEmit", "false", "--declaration", "--emitDeclarationOnly", "--rootDir", join(root, "studio"), "--outDir", join(folder, "types")],
    { cwd: join(root, "studio"), stdio: "inherit" },
);
for (const part of ["page", "npm"]) {
    const kept = part === "page" ? ["protocol.d.ts"] : ["bridge.d.ts", "browser.d.ts", "index.d.ts", "node.d.ts"];
    for (const name of execFileSync("ls", [join(folder, "types", part)], { encoding: "utf8" }).split("\n")) {
        if (name && !kept.includes(name)) rmSync(join(folder, "types", part, name), { recursive: true });
    }
}
copyFileSync(join(values.bridge, "sikku-bridge.wasm"), join(folder, "sikku.wasm"));
copyFileSync(join(here, "README.md"), join(folder, "README.md"));
copyFileSync(join(root, "LICENSE"), join(folder, "LICENSE"));
for (const file of ["sikku.wasm", "README.md", "LICENSE"]) chmodSync(join(folder, file), 0o644); // whatever the umask of the checkout
writeFileSync(join(folder, "NOTICES.json"), JSON.stringify(notices(join(root, "studio/node_modules"), ["pako"]), null, 1));
const version = /project\(sikku VERSION ([0-9.]+)/.exec(readFileSync(join(root, "CMakeLists.txt"), "utf8"))[1];
writeFileSync(
    join(folder, "package.json"),
    JSON.stringify(
        {
            name: "sikku",
            version,
            description: "L-systems: kolams, tilings, plants and music",
            license: "MIT",
            type: "module",
            exports: {
                ".": {
                    node: { types: "./types/npm/node.d.ts", default: "./node.js" },
                    default: { types: "./types/npm/browser.d.ts", default: "./browser.js" },
                },
                "./sikku.wasm": "./sikku.wasm",
            },
            types: "./types/npm/node.d.ts",
            engines: { node: ">=18" },
            keywords: ["l-system", "kolam", "tiling", "svg", "midi", "fractal"],
        },
        null,
        4,
    ) + "\n",
);
const output = resolve(values.output);
execFileSync("npm", ["pack", "--silent", "--pack-destination", output], { cwd: folder, stdio: "inherit" });
const archive = join(output, `sikku-${version}.tgz`);
const size = statSync(archive).size;
console.log(`${archive}: ${size.toLocaleString("en")} bytes`);
if (size > most_bytes) {
    console.error(`the package is larger than ${most_bytes.toLocaleString("en")} bytes`);
    process.exitCode = 1;
}
