// What the page contains of others, with the licences: packages of npm from their folders, C++ libraries by name.
import { existsSync, readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";

const run_time = [
    "@codemirror/autocomplete", "@codemirror/commands", "@codemirror/language", "@codemirror/lint", "@codemirror/search",
    "@codemirror/state", "@codemirror/view", "@lezer/common", "@lezer/highlight", "@lezer/lr", "@marijn/find-cluster-break",
    "crelt", "lean-qr", "pako", "style-mod", "w3c-keyname",
];

const libraries = [
    { name: "Boost", what: "graphs, intervals, sorting", licence: "BSL-1.0" },
    { name: "GLM", what: "vectors and rotations", licence: "MIT" },
    { name: "fmt", what: "formatting", licence: "MIT" },
    { name: "nlohmann/json", what: "JSON", licence: "MIT" },
    { name: "fast_float", what: "reading numbers", licence: "MIT" },
    { name: "Emscripten, musl, libc++", what: "the C++ libraries in the browser", licence: "MIT, Apache-2.0 with LLVM exception" },
];

/// A list of {name, version, licence, text}.
export function notices(folder) {
    const packages = run_time.filter((name) => existsSync(join(folder, name))).map((name) => {
        const facts = JSON.parse(readFileSync(join(folder, name, "package.json"), "utf8"));
        const file = readdirSync(join(folder, name)).find((each) => /^licen[cs]e/i.test(each));
        const text = file ? readFileSync(join(folder, name, file), "utf8").trim() : "";
        return { name, what: "", version: facts.version, licence: facts.license, text };
    });
    return [...libraries.map((each) => ({ version: "", text: "", ...each })), ...packages];
}
