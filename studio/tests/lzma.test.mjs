// The decoder of the page, compared with what xz compresses.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { load } from "./load.mjs";

const { unpackLzma } = await load("lzma");

function returns(contents, settings) {
    const file = execFileSync("xz", ["--format=lzma", `--lzma1=${settings}`, "-c"], { input: contents });
    const packed = Buffer.concat([file.subarray(0, 1), file.subarray(13)]);
    assert.ok(Buffer.from(unpackLzma(packed, contents.length)).equals(contents), `${contents.length} bytes, ${settings}`);
}

test("data come back", () => {
    const source = readFileSync(new URL("../page/lzma.ts", import.meta.url));
    let seed = 1;
    const noise = Buffer.from(Array.from({ length: 100_000 }, () => (seed = (seed * 48271) % 2147483647) & 0xff));
    const far = Buffer.concat([source, noise, source, noise.subarray(0, 50_000), Buffer.alloc(70_000), source]);
    for (const settings of ["preset=9e,lc=4,pb=0", "preset=6", "lc=0,lp=2,pb=2", "lc=1,lp=3,pb=4,nice=8"]) {
        for (const contents of [Buffer.alloc(0), Buffer.from("a"), Buffer.alloc(5000, "ab"), source, noise, far]) {
            returns(contents, settings);
        }
    }
});

test("damaged data end", () => {
    for (let i = 0; i < 50; ++i) {
        const bytes = new Uint8Array(200).map((_, k) => (k * 31 + i * 97) & 0xff);
        bytes[0] = 93;
        assert.equal(unpackLzma(bytes, 10_000).length, 10_000);
    }
});
