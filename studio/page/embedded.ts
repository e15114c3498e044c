// The compressed data in the page: the libraries, the worker and the script itself.
import { alphabet } from "./alphabet";
import { unpackLzma } from "./lzma";

function decode(text: string, start: number, size: number): Uint8Array<ArrayBuffer> {
    const values = new Uint8Array(128);
    for (let index = 0; index < alphabet.length; ++index) values[alphabet.charCodeAt(index)] = index;
    const words = new DataView(new ArrayBuffer(6 * Math.ceil(size / 6)));
    for (let from = start, to = 0; to < size; from += 7, to += 6) {
        let word = 0;
        for (let place = 0; place < 7; ++place) word = word * alphabet.length + values[text.charCodeAt(from + place)]!;
        words.setUint16(to, Math.floor(word / 2 ** 32));
        words.setUint32(to + 2, word % 2 ** 32);
    }
    return new Uint8Array(words.buffer, 0, size);
}

/// The contents of an element that holds data.
export function dataOf(id: string): string {
    return document.getElementById(id)!.textContent!.trim();
}

/// Decompresses what dataOf() returns.
export function unpackText(text: string): Uint8Array<ArrayBuffer> {
    const [packed, whole] = text.split(" ", 2).map(Number) as [number, number];
    return unpackLzma(decode(text, text.lastIndexOf(" ") + 1, packed), whole);
}

/// Decompresses a script, and returns a Blob address for it.
export function scriptAddress(id: string): string {
    return URL.createObjectURL(new Blob([unpackText(dataOf(id))], { type: "text/javascript" }));
}
