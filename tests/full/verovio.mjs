// Writes what Verovio reads in scores: [onset in quarters, letter, alteration, octave] of each note that is struck.
// usage: verovio.mjs MODULES FOLDER COUNT
import {readFileSync, writeFileSync} from "node:fs";
import {createRequire} from "node:module";
import {pathToFileURL} from "node:url";

const [modules, folder, count] = process.argv.slice(2);
const load = path => import(pathToFileURL(createRequire(modules + "/").resolve(path)).href);
const {default: createModule} = await load("verovio/wasm");
const {VerovioToolkit} = await load("verovio/esm");
const toolkit = new VerovioToolkit(await createModule());
const signs = {n: 0, s: 1, f: -1, ss: 2, x: 2, ff: -2, ns: 1, nf: -1, su: 1.5, sd: 0.5, fd: -1.5, fu: -0.5, "1qs": 0.5, "1qf": -0.5};
for (let number = 0; number < Number(count); ++number) {
  toolkit.setOptions({transpose: ""});
  if (!toolkit.loadData(readFileSync(`${folder}/${number}.musicxml`, "utf8"))) throw new Error(`score ${number}`);
  const mei = toolkit.getMEI({removeIds: false});
  const read = new Map();
  for (const [, inside, more] of mei.matchAll(/<note ([^>]*?)(?:\/>|>([\s\S]*?)<\/note>)/g)) {
    const attribute = name => new RegExp(`(?:^|\\s)${name}="([^"]+)"`).exec(inside)?.[1];
    const sign = /<accid [^>]*?accid(?:\.ges)?="([^"]+)"/.exec(more ?? "")?.[1];
    read.set(attribute("xml:id"), [attribute("pname")?.toUpperCase(), signs[sign ?? attribute("accid.ges") ?? "n"],
                                   attribute("oct.ges") ?? attribute("oct")]);
  }
  const tied = new Set([...mei.matchAll(/<tie [^>]*endid="#([^"]+)"/g)].map(match => match[1]));
  const notes = [];
  for (const {qstamp, on} of toolkit.renderToTimemap({includeMeasures: false})) {
    for (const id of on ?? []) {
      const note = read.get(id);
      if (note?.[0] && !tied.has(id)) notes.push([qstamp, ...note]);
    }
  }
  writeFileSync(`${folder}/${number}.verovio.json`, JSON.stringify(notes));
}
