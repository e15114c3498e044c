// Measures the language server: the time to start it and, for each pattern, the time from a keystroke to the report of
// errors. The requests that VS Code sends follow each keystroke at once: sizes, colours, names.
// usage: node tests/bench/language_server.mjs PROGRAM PATTERN…
import {readFileSync} from "node:fs";
import {LanguageClient} from "../full/language_client.mjs";

const [program, ...files] = process.argv.slice(2);
const median = list => list.toSorted((a, b) => a - b)[list.length >> 1];

const starts = [];
for (let round = 0; round < 10; ++round) {
  const begin = performance.now();
  const client = new LanguageClient(program);
  await client.start();
  starts.push(performance.now() - begin);
  await client.stop();
}
console.log(`start: median ${median(starts).toFixed(1)} ms, most ${Math.max(...starts).toFixed(1)} ms`);

const client = new LanguageClient(program);
await client.start();
const rows = [];
for (const file of files) {
  const text = readFileSync(file, "utf8");
  const textDocument = {uri: client.open(file, text)};
  const {uri} = textDocument;
  let reported = client.diagnostics(uri), version = 1;
  await reported;
  const keystrokes = [];
  for (let round = 0; round < 8; ++round) {
    // The keystrokes of a comment; after its first slash, the pattern has an error.
    const changed = text + "\n// hello".slice(0, 1 + round);
    reported = client.diagnostics(uri);
    const begin = performance.now();
    client.change(uri, changed, ++version);
    const answers = ["codeLens", "documentColor", "semanticTokens/full"].map(name =>
      client.request(`textDocument/${name}`, {textDocument}));
    await reported;
    keystrokes.push(performance.now() - begin);
    // The next key is pressed while the server measures.
    if (round % 2) await Promise.all(answers);
  }
  const begin = performance.now();
  await client.request("textDocument/codeLens", {textDocument});
  rows.push({file, median: median(keystrokes), most: Math.max(...keystrokes), sizes: performance.now() - begin});
  client.close(uri);
}
await client.stop();
rows.sort((a, b) => b.most - a.most);
for (const {file, median, most, sizes} of rows.slice(0, 10)) {
  console.log(`${file}: median ${median.toFixed(1)} ms, most ${most.toFixed(1)} ms, sizes ${sizes.toFixed(1)} ms`);
}
const slowest = rows.toSorted((a, b) => b.sizes - a.sizes)[0];
console.log(`${rows.length} patterns: median keystroke ${median(rows.map(row => row.median)).toFixed(1)} ms, longest ` +
  `${rows[0].most.toFixed(1)} ms; sizes take at most ${slowest.sizes.toFixed(1)} ms (${slowest.file})`);
