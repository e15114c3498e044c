// Reads patterns with the TextMate grammar as VS Code does. Every character except blanks must have a scope. Comments
// must be where a scanner of this file finds them; keys, sections, constants, parameters and arrows where the language
// server finds them, which uses the parser of the language; symbols where they occur in words.
// usage: grammar.mjs NODE_MODULES PROGRAM GRAMMAR PATTERN…
import assert from "node:assert/strict";
import {readFileSync} from "node:fs";
import {createRequire} from "node:module";
import {LanguageClient} from "./language_client.mjs";

const [modules, program, grammarFile, ...files] = process.argv.slice(2);
const require = createRequire(modules + "/");
const {Registry, INITIAL, parseRawGrammar} = require("vscode-textmate");
const oniguruma = require("vscode-oniguruma");
await oniguruma.loadWASM(readFileSync(require.resolve("vscode-oniguruma/release/onig.wasm")).buffer);
const registry = new Registry({
  onigLib: Promise.resolve({
    createOnigScanner: sources => new oniguruma.OnigScanner(sources),
    createOnigString: text => new oniguruma.OnigString(text),
  }),
  loadGrammar: async () => parseRawGrammar(readFileSync(grammarFile, "utf8"), grammarFile),
});
const grammar = await registry.loadGrammar("source.sikku");

/// For each UTF-16 unit of each line: its scopes except the first, without the suffix.
function scopesOf(lines) {
  let state = INITIAL;
  return lines.map(line => {
    const {tokens, ruleStack, stoppedEarly} = grammar.tokenizeLine(line, state);
    assert.ok(!stoppedEarly, line);
    state = ruleStack;
    const scopes = [];
    for (const {startIndex, endIndex, scopes: list} of tokens) {
      const names = list.slice(1).map(name => name.replace(/\.sikku$/, ""));
      for (let at = startIndex; at < Math.min(endIndex, line.length); ++at) scopes[at] = names;
    }
    return scopes;
  });
}

/// A second scanner of comments: true for each unit that belongs to a comment.
function commentsOf(lines) {
  let inside = false, continues = false;
  return lines.map(line => {
    const found = new Array(line.length).fill(false);
    let at = 0;
    if (!inside && !continues && /^[ \t]*\/\//.test(line)) {
      for (at = line.indexOf("//"); at < line.length; ++at) found[at] = true;
      return found;
    }
    for (; at < line.length; ++at) {
      if (!inside && line.startsWith("/*", at)) {
        inside = true;
        found[at] = found[++at] = true;
      } else if (inside && line.startsWith("*/", at)) {
        inside = false;
        found[at] = found[++at] = true;
      } else {
        found[at] = inside;
      }
    }
    continues = / \\$/.test(line);
    return found;
  });
}

const symbolScopes =
  /^(support\.function\.draw|punctuation\.section\.branch|keyword\.operator\.turn|support\.constant\.pen|variable\.other\.symbol)$/;
const kinds = {
  property: /^keyword\.other\.key$/,
  class: /^(entity\.name\.section|support\.function\.draw)$/,
  variable: /^variable\.(other\.constant|parameter)$/,
  parameter: /^variable\.parameter$/,
  operator: /^keyword\.operator\.arrow$/,
  function: symbolScopes,
};
const classes = new Map([
  ...[..."Ff"].map(letter => [letter, "support.function.draw"]),
  ...[..."+-&^|/$"].map(letter => [letter, "keyword.operator.turn"]),
  ...[..."[]{}%"].map(letter => [letter, "punctuation.section.branch"]),
  ...[..."#!',;"].map(letter => [letter, "support.constant.pen"]),
  ...[..."ABCXYZ"].map(letter => [letter, "variable.other.symbol"]),
]);
const counts = {files: 0, units: 0, comments: 0, names: 0, symbols: 0};

const client = new LanguageClient(program);
const {capabilities} = await client.start();
const {tokenTypes} = capabilities.semanticTokensProvider.legend;
const failures = [];
for (const file of files) {
  const text = readFileSync(file, "utf8").replace(/^\uFEFF/, "");
  const lines = text.split(/\r?\n/);
  const scopes = scopesOf(lines), comments = commentsOf(lines);
  const fail = (line, column, what) => failures.push(`${file}:${line + 1}:${column + 1}: ${what}: ${lines[line]}`);
  lines.forEach((line, number) => {
    for (let at = 0; at < line.length; ++at) {
      if (/\s/.test(line[at])) continue;
      ++counts.units;
      const names = scopes[number][at];
      // Scopes of whole lines have no colour.
      if (!names.some(name => !name.startsWith("meta."))) fail(number, at, `'${line[at]}' has no scope`);
      const isComment = names.some(name => name.startsWith("comment."));
      if (isComment !== comments[number][at]) fail(number, at, isComment ? "not a comment" : "a comment");
      if (isComment) ++counts.comments;
    }
  });
  const uri = client.open(file, text);
  const {data} = await client.request("textDocument/semanticTokens/full", {textDocument: {uri}});
  client.close(uri);
  let line = 0, column = 0;
  const named = lines.map(each => new Array(each.length).fill(false));
  for (let at = 0; at < data.length; at += 5) {
    if (data[at] > 0) column = 0;
    line += data[at];
    column += data[at + 1];
    const kind = tokenTypes[data[at + 3]];
    for (let unit = column; unit < column + data[at + 2]; ++unit) {
      named[line][unit] = true;
      if (!scopes[line][unit].some(name => kinds[kind].test(name))) {
        fail(line, unit, `a ${kind} has the scopes ${scopes[line][unit].join(", ")}`);
      }
    }
    ++counts.names;
  }
  // Conversely, no other text has these scopes.
  scopes.forEach((units, number) => units.forEach((names, at) => {
    if (!named[number][at] && names.some(name => kinds.property.test(name) || kinds.operator.test(name))) {
      fail(number, at, `${names.join(", ")} is none`);
    }
  }));
  // Words of productions and of the axiom, which have no parentheses or comments.
  const listed = /^symbols:/im.test(text);
  lines.forEach((each, number) => {
    const part = /^axiom:(.*)$/i.exec(each) ?? /^[^():]*-->([^():]*)$/.exec(each);
    if (!part || /^(title|source|description):/i.test(each) || /[(@~*\\ε]|\/\*/.test(part[1])) return;
    for (let at = each.length - part[1].length; at < each.length; ++at) {
      if (/\s/.test(each[at])) continue;
      const names = scopes[number][at];
      ++counts.symbols;
      if (!names.some(name => symbolScopes.test(name))) fail(number, at, `'${each[at]}' is not a symbol`);
      const expected = classes.get(each[at]);
      if (expected && !listed && names.at(-1) !== expected) {
        fail(number, at, `'${each[at]}' has ${names.join(", ")} instead of ${expected}`);
      }
    }
  });
  ++counts.files;
}
assert.equal(await client.stop(), 0);
for (const failure of failures.slice(0, 50)) console.error(failure);
assert.equal(failures.length, 0, `${failures.length} places`);
assert.ok(counts.files > 0 && counts.comments > 0 && counts.names > 0 && counts.symbols > 0);
console.log(`TextMate grammar: ${counts.files} patterns, ${counts.units} characters, of which ${counts.comments} in comments and ` +
  `${counts.symbols} symbols; ${counts.names} names where the language server finds them`);
