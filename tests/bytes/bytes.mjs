// Makes the outputs of a gallery's list (`sikku gallery --list --json`, from standard input) by the libraries as
// WebAssembly, and prints the SHA-256 and the name of each as tests/bytes.sh does.
//     node bytes.mjs BRIDGE_FOLDER < LIST
import { createHash } from "node:crypto";
import { readFileSync } from "node:fs";
import { resolve } from "node:path";
import { loadBridge } from "../../studio/load_bridge.mjs";

const bridge = await loadBridge(resolve(process.argv[2]));
const ask = (request) => {
    const { json, bytes } = bridge(JSON.stringify(request));
    return { answer: JSON.parse(json), bytes };
};
const texts = new Map(ask({ do: "patterns" }).answer.patterns.map(({ name, text }) => [name, text]));
const help = ask({ do: "help" }).answer;
const prints = new Set(help.draw.formats.flatMap(({ extension, alias }) => [extension, alias]));

const lines = [];
for (const line of readFileSync(0, "utf8").split("\n").filter(Boolean)) {
    if (line.includes('"name":"pieces/')) continue; // the web build has no arrangements
    const { name, format, pattern, set = {}, n, seed, variant, budget, ...keys } = JSON.parse(line);
    const settings = Object.entries(set);
    if (n !== undefined) settings.push(["derivation length", n]);
    if (seed !== undefined) settings.push(["seed", seed]);
    if (!texts.has(pattern)) throw new Error(`unknown pattern ${pattern}`);
    const request = { name: `${pattern}.lsys`, text: texts.get(pattern), settings, variant };
    const { answer, bytes } = ask({
        do: "make", interpreter: prints.has(format) ? "draw" : "play", format, options: Object.entries(keys), pattern: request,
    });
    if (answer.error) continue; // fails everywhere
    lines.push([`./${name}.${format}`, createHash("sha256").update(bytes).digest("hex")]);
}
lines.sort(([one], [other]) => (Buffer.compare(Buffer.from(one), Buffer.from(other))));
for (const [name, hash] of lines) console.log(`${hash}  ${name}`);
