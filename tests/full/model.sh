#!/usr/bin/env bash
# Models through the validator of the Khronos Group.
# usage: tests/full/model.sh PROGRAM
set -euo pipefail
[ $# -eq 1 ] || { echo "usage: tests/full/model.sh PROGRAM" >&2; exit 2; }
program=$(realpath "$1")
skip() { echo "skipped: models through the glTF validator ($1)"; exit 0; }
command -v npm > /dev/null || skip "npm is not installed"
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
npm install --silent --no-audit --no-fund --no-save gltf-validator > npm.log 2>&1 ||
    skip "npm cannot install gltf-validator: $(tail -n 1 npm.log)"
cat > validate.mjs << 'END'
import { readFileSync } from "node:fs";
import validator from "gltf-validator";
for (const file of process.argv.slice(2)) {
    const report = await validator.validateBytes(new Uint8Array(readFileSync(file)));
    if (report.issues.messages.length > 0) {
        console.log(file, JSON.stringify(report.issues, null, 1));
        process.exit(1);
    }
    console.log(`gltf-validator: ${file}, ${report.info.totalTriangleCount} triangles, no issues`);
}
END
for pattern in bush-3d flowering-plant honda-trees dragon; do
    "$program" --quiet draw "$pattern" -o "$pattern.glb"
done
"$program" --quiet draw penrose-rhombs -n 3 --relief 2mm,3mm --size 100x100mm -o relief.glb
"$program" --quiet draw snake-kolam -n 2 --dots --relief=-0.8mm --base 2mm,5mm --size 100x100mm -o sunk.glb
"$program" --quiet draw bush-3d --set 'palette=#5a463280 red' -o translucent.glb
node validate.mjs ./*.glb
