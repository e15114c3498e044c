// The editor of the page and `sikku lsp` give the same answers for the same positions.
import assert from "node:assert/strict";
import { existsSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { after, test } from "node:test";
import { LanguageClient } from "../../tests/full/language_client.mjs";
import { anyBridge } from "./any_bridge.mjs";
import { root } from "../load_bridge.mjs";

const program = ["dev", "release"].map((build) => join(root, "build", build, "bin/sikku")).find(existsSync);
const skip = program ? false : "the program is not built";
const ask = await anyBridge();
const client = program ? new LanguageClient(program) : null;
await client?.start();
after(() => client?.stop());

const wrong = "title: 𝄞 α\naxiom: α𝄞(F\nangel factor: 4\ndefine k = 2\ntable a:\nF --> F[+F]F\nschedule: a*k \nturn: ";

/// Both answers of a request: the result, or the message of an error.
async function both(method, uri, text, position, more = {}) {
    const parameters = { textDocument: { uri, text }, position, ...more };
    const { result, error } = ask({ do: "editor", method: `textDocument/${method}`, parameters });
    const there = client.request(`textDocument/${method}`, { textDocument: { uri }, position, ...more });
    return [error ? error.message : result, await there.catch(({ message }) => message.replace(/^[^:]*: /, ""))];
}

const texts = ["curves/hilbert", "plants/bush-3d", "melodies/dragon-blues", "kolams/snake-kolam"]
    .map((name) => join(root, "patterns", `${name}.lsys`))
    .map((file) => [file, readFileSync(file, "utf8")]);

test("help, completion, definitions and renaming are those of the language server", { skip }, async () => {
    const counts = { hover: 0, completion: 0, definition: 0, prepareRename: 0, rename: 0 };
    for (const [file, text] of [...texts, ["/none/wrong.lsys", wrong]]) {
        const uri = client.open(file, text);
        for (const [line, content] of text.split("\n").slice(0, 30).entries()) {
            for (const character of [1, Math.floor(content.length / 2), content.length]) {
                for (const method of Object.keys(counts)) {
                    const more = method === "rename" ? { newName: "Q" } : {};
                    const [here, there] = await both(method, uri, text, { line, character }, more);
                    assert.deepEqual(here, there, `${method} in ${file}:${line + 1}:${character + 1}`);
                    if (typeof here === "object" && here && (here.items ?? Object.keys(here)).length > 0) ++counts[method];
                }
            }
        }
    }
    for (const [method, count] of Object.entries(counts)) assert.ok(count > 5, `${method}: ${count} answers`);
});

test("answers do not depend on the text having been opened, and questions are checked", () => {
    const textDocument = { uri: "mine.lsys", text: wrong };
    const at = (line, character, method = "hover", more = {}) =>
        ask({ do: "editor", method: `textDocument/${method}`, parameters: { textDocument, position: { line, character }, ...more } });
    assert.match(at(3, 7).result.contents.value, /`k = 2`/);
    assert.deepEqual(at(6, 12, "definition").result[0].range, {
        start: { line: 3, character: 7 }, end: { line: 3, character: 8 },
    });
    assert.deepEqual(at(7, 6, "completion").result.items.map(({ label }) => label), ["right", "left"]);
    assert.equal(at(0, 99).result, null);
    assert.match(at(3, 7, "rename", { newName: "m" }).error.message, /errors/);
    assert.equal(at(3, 7, "fly").error.kind, "request");
    assert.equal(at(-1, 7).error.kind, "request");
    assert.equal(ask({ do: "editor", method: "textDocument/hover" }).error.kind, "request");
});
