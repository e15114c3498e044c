// Loads the packed extension for VS Code with a stub of the interface of VS Code. The extension starts the server,
// which reports an error in an open document and ends with the extension.
// usage: extension.mjs EXTENSION_FOLDER PROGRAM PATTERN
import assert from "node:assert/strict";
import {readFileSync} from "node:fs";
import Module, {createRequire} from "node:module";
import {pathToFileURL} from "node:url";

const [folder, program, pattern] = process.argv.slice(2);
const description = JSON.parse(readFileSync(`${folder}/package.json`, "utf8"));

/// A stub of all unused members: a function, a class, an object and a list.
const anything = new Proxy(function () {}, {
  get: (target, key) => {
    if (key === Symbol.iterator) return [][Symbol.iterator].bind([]);
    if (key === Symbol.toPrimitive) return () => "";
    return key === "then" ? undefined : key === "prototype" ? target.prototype : anything;
  },
  apply: () => anything,
  construct: (target, values, type) => Reflect.construct(Object, [], type),
});
const orAnything = known => new Proxy(known, {get: (target, key) => key in target ? target[key] : anything});
class EventEmitter {
  listeners = [];
  event = listener => (this.listeners.push(listener), {dispose: () => {}});
  fire(value) { for (const listener of this.listeners) listener(value); }
  dispose() {}
}
class Disposable { dispose() {} }
class Position { constructor(line, character) { Object.assign(this, {line, character}); } }
class Range {
  constructor(...places) {
    [this.start, this.end] = places.length === 2 ? places : [new Position(places[0], places[1]), new Position(places[2], places[3])];
  }
}
class Diagnostic { constructor(range, message, severity) { Object.assign(this, {range, message, severity}); } }
class CancellationTokenSource {
  token = {isCancellationRequested: false, onCancellationRequested: new EventEmitter().event};
  cancel() { this.token.isCancellationRequested = true; }
  dispose() {}
}
const uri = {scheme: "file", path: pattern, fsPath: pattern, toString: () => pathToFileURL(pattern).href};
const text = "axiom: F\nangel factor: 4\n";
const document = {uri, languageId: "sikku", version: 1, fileName: pattern, isClosed: false, getText: () => text};
let reported, complaint;
const diagnostics = new Promise(resolve => { reported = resolve; });
const output = {append() {}, appendLine() {}, replace() {}, clear() {}, show() {}, hide() {}, dispose() {}};
const vscode = orAnything({
  version: description.engines.vscode.replace("^", ""),
  EventEmitter, CancellationTokenSource, Disposable, Position, Range, Diagnostic,
  DiagnosticSeverity: {Error: 0, Warning: 1, Information: 2, Hint: 3},
  Uri: orAnything({parse: () => uri}),
  workspace: orAnything({
    getConfiguration: () => ({get: name => name === "program" ? program : undefined}),
    textDocuments: [document],
    workspaceFolders: undefined,
    onDidOpenTextDocument: new EventEmitter().event,
  }),
  window: orAnything({
    createOutputChannel: () => output,
    showErrorMessage: message => { complaint = message; return Promise.resolve(); },
    visibleTextEditors: [], activeTextEditor: undefined,
    tabGroups: orAnything({all: []}),
  }),
  languages: orAnything({
    match: (selector, {languageId}) => [selector].flat().some(each => each.language === languageId) ? 10 : 0,
    createDiagnosticCollection: () => orAnything({set: (where, list) => { if (list.length > 0) reported(list); }}),
  }),
  env: orAnything({appName: "stand-in", language: "en"}),
});
const load = Module._load;
Module._load = function (name, ...rest) { return name === "vscode" ? vscode : load.call(this, name, ...rest); };

const extension = createRequire(import.meta.url)(`${folder}/${description.main}`);
const timer = setTimeout(() => { console.error("the extension reports nothing within 20 s", complaint ?? ""); process.exit(1); }, 20000);
await extension.activate({subscriptions: []});
assert.equal(complaint, undefined);
const [error] = await diagnostics;
assert.ok(error.message.includes("did you mean 'angle factor'"), error.message);
assert.deepEqual([error.range.start.line, error.range.start.character, error.range.end.character], [1, 0, 5]);
await extension.deactivate();
clearTimeout(timer);
for (const file of [description.contributes.grammars[0].path, description.contributes.languages[0].configuration]) {
  JSON.parse(readFileSync(`${folder}/${file}`, "utf8"));
}
assert.ok(readFileSync(`${folder}/dist/NOTICES.txt`, "utf8").includes("vscode-languageclient"));
console.log(`extension for VS Code: ${description.name} ${description.version} starts the language server`);
