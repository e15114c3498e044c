// Bundles the extension into dist/extension.js, and writes the licences of its packages into dist/NOTICES.txt.
import {build} from "esbuild";
import {readdirSync, readFileSync, writeFileSync} from "node:fs";

const {metafile} = await build({
  entryPoints: ["extension.js"],
  outfile: "dist/extension.js",
  bundle: true,
  minify: true,
  platform: "node",
  target: "node18",
  external: ["vscode"],
  legalComments: "none",
  metafile: true,
});
const folders = new Set();
for (const file of Object.keys(metafile.inputs)) {
  const folder = /^.*node_modules\/(?:@[^/]+\/)?[^/]+/.exec(file);
  if (folder) folders.add(folder[0]);
}
const notices = [...folders].sort().map(folder => {
  const {name, version, license} = JSON.parse(readFileSync(`${folder}/package.json`, "utf8"));
  const file = readdirSync(folder).find(each => /^licen[cs]e/i.test(each));
  if (!file) throw new Error(`${name} has no licence file`);
  return `${name} ${version} (${license})\n\n${readFileSync(`${folder}/${file}`, "utf8").trim()}\n`;
});
writeFileSync("dist/NOTICES.txt", notices.join("\n" + "-".repeat(80) + "\n\n"));
