// Builds the studio: one HTML file with its style sheet, script, worker and the libraries as WebAssembly.
//     node build.mjs [--bridge FOLDER] [-o FILE] [--readable]
// FOLDER contains sikku-bridge.cjs and sikku-bridge.wasm.
import { build, transform } from "esbuild";
import { execFileSync } from "node:child_process";
import { createHash } from "node:crypto";
import { mkdirSync, readdirSync, readFileSync, writeFileSync } from "node:fs";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { parseArgs } from "node:util";
import { notices } from "./notices.mjs";
import { loadBridge } from "./load_bridge.mjs";
import { alphabet } from "./page/alphabet.js";

const most_bytes = 2_200_000;
const here = dirname(fileURLToPath(import.meta.url));
const { values } = parseArgs({
    options: {
        bridge: { type: "string", default: join(here, "../build/studio") },
        output: { type: "string", short: "o", default: join(here, "../build/studio/sikku-studio.html") },
        readable: { type: "boolean", default: false },
    },
});
const bridge = resolve(values.bridge);

// Bundles one entry as the text of a classic script: workers made from a Blob are classic scripts, so that the page
// also works from a file.
async function bundle(entry) {
    const result = await build({
        entryPoints: [resolve(here, "page", entry)],
        alias: { "sikku-bridge": join(bridge, "sikku-bridge.cjs") },
        bundle: true,
        write: false,
        format: "iife",
        target: "es2022",
        minify: !values.readable,
        charset: "utf8",
        legalComments: "none",
        logLevel: "warning",
        external: ["module", "fs", "path", "url", "crypto", "worker_threads"],
        define: { "import.meta.url": '""', "import.meta": "{}" },
        loader: { ".lsys": "text" },
        plugins: [facts_as_module, notices_as_module, styles_as_text, workers_as_text],
    });
    return result.outputFiles[0].text.replaceAll("</script", "<\\/script").replaceAll("<!--", "<\\!--");
}

// A plugin that makes the modules whose names match the filter.
function made(name, filter, load, placed = ({ path }) => path) {
    return {
        name,
        setup(plugins) {
            plugins.onResolve({ filter }, (asked) => ({ path: placed(asked), namespace: name }));
            plugins.onLoad({ filter: /.*/, namespace: name }, load);
        },
    };
}

const notices_as_module = made("notices", /^notices$/, () => ({
    contents: JSON.stringify(notices(join(here, "node_modules"))),
    loader: "json",
}));

// Facts about patterns, arrangements and options. The page would need a second to request them from the libraries, which
// contain the texts of the patterns.
const ask = await loadBridge(bridge);
const facts_as_module = made("facts", /^library-facts$/, () => {
    const answer = (what) => JSON.parse(ask(JSON.stringify({ do: what })).json);
    const patterns = answer("patterns").patterns.map(({ text, ...facts }) => facts);
    const { arrangements } = answer("arrangements");
    return { contents: JSON.stringify({ patterns, arrangements, help: answer("help") }), loader: "json" };
});

// `worker:sound/file.ts` imports the bundle of that file as a string.
const workers_as_text = made(
    "worker",
    /^worker:/,
    async ({ path }) => ({ contents: await bundle(path), loader: "text" }),
    ({ path, resolveDir }) => {
        const file = path.slice("worker:".length);
        return resolve(file.startsWith(".") ? resolveDir : join(here, "page"), file);
    },
);

// `panel-styles` holds the style rules of the panels, compressed with the script; the rules of the whole page are in
// its head.
const styles_as_text = made("styles", /^panel-styles$/, async () => {
    const names = readdirSync(join(here, "page")).filter((name) => name.endsWith(".css") && name !== page_style);
    return { contents: await style(names.sort()), loader: "text" };
});

const page_style = "studio.css";
async function style(names) {
    const contents = names.map((name) => readFileSync(join(here, "page", name), "utf8")).join("\n");
    return (await transform(contents, { loader: "css", minify: !values.readable, charset: "utf8" })).code;
}

// LZMA, a quarter smaller than deflate: the properties and the data, without the sizes in the header.
function compressed(contents) {
    const options = ["--format=lzma", "--lzma1=preset=9e,lc=4,pb=0", "-c"];
    const file = execFileSync("xz", options, { input: contents, maxBuffer: 1 << 28 });
    return Buffer.concat([file.subarray(0, 1), file.subarray(13)]);
}

// Data that the page unpacks when it opens: compressed, with six bytes in seven characters. See page/embedded.ts.
function packed(contents) {
    const whole = Buffer.from(contents);
    const bytes = compressed(whole);
    const padded = Buffer.concat([bytes, Buffer.alloc(5)]);
    const letters = Buffer.alloc(7 * Math.ceil(bytes.length / 6));
    for (let from = 0, to = 0; from < bytes.length; from += 6, to += 7) {
        for (let place = 6, number = padded.readUIntBE(from, 6); place >= 0; --place) {
            letters[to + place] = alphabet.charCodeAt(number % alphabet.length);
            number = Math.floor(number / alphabet.length);
        }
    }
    return `${bytes.length} ${whole.length} ${letters.toString("latin1")}`;
}

// The page of the first pattern as SVG.
function draft() {
    const text = readFileSync(join(here, "page/first.lsys"), "utf8");
    const pattern = { name: "first.lsys", text, variant: "", settings: [] };
    const { json, bytes } = ask(JSON.stringify({ do: "make", interpreter: "draw", format: "svg", pattern }));
    const { error } = JSON.parse(json);
    if (error) throw new Error(error.message);
    return bytes;
}

const boot = await bundle("boot.ts");
const parts = {
    style: await style([page_style]),
    boot,
    "script-hash": `'sha256-${createHash("sha256").update(boot).digest("base64")}'`,
    draft: packed(draft()),
    script: packed(await bundle("main.ts")),
    worker: packed(await bundle("worker.ts")),
    libraries: packed(readFileSync(join(bridge, "sikku-bridge.wasm"))),
};
const page = readFileSync(join(here, "page/studio.html"), "utf8").replace(
    /\{\{([a-z-]+)\}\}/g,
    (_, name) => parts[name],
);

mkdirSync(dirname(resolve(values.output)), { recursive: true });
writeFileSync(values.output, page);
const thousands = (count) => count.toLocaleString("en");
const sizes = ["libraries", "script", "worker", "style"].map((name) => `${name} ${thousands(parts[name].length)}`);
const size = Buffer.byteLength(page);
console.log(`${values.output}: ${thousands(size)} bytes (${sizes.join(", ")})`);
if (size > most_bytes) {
    console.error(`the page is larger than ${thousands(most_bytes)} bytes`);
    process.exitCode = 1;
}
