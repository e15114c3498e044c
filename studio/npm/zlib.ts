// zlib for the WebAssembly module, which has none of its own: see studio/wasm/zlib.cpp.
import adler32 from "pako/lib/zlib/adler32.js";
import crc32 from "pako/lib/zlib/crc32.js";
import deflate from "pako/lib/zlib/deflate.js";
import inflate from "pako/lib/zlib/inflate.js";
import ZStream from "pako/lib/zlib/zstream.js";

interface Stream { stream: any; isDeflate: boolean }

/// The functions that the module calls as `Module.zlib`.
export function makeZlib() {
    const streams = new Map<number, Stream>();
    let last = 0;
    return {
        open(isDeflate: boolean, level: number, windowBits: number, memoryLevel: number, strategy: number): number {
            const stream = new (ZStream as any)();
            if (isDeflate) deflate.deflateInit2(stream, level, 8, windowBits, memoryLevel, strategy);
            else inflate.inflateInit2(stream, windowBits);
            streams.set(++last, { stream, isDeflate });
            return last;
        },
        run(handle: number, input: Uint8Array, output: Uint8Array, flush: number) {
            const { stream, isDeflate } = streams.get(handle)!;
            Object.assign(stream, { input, next_in: 0, avail_in: input.length });
            Object.assign(stream, { output, next_out: 0, avail_out: output.length });
            const state: number = isDeflate ? deflate.deflate(stream, flush) : inflate.inflate(stream, flush);
            const left = { state, input: stream.avail_in as number, output: stream.avail_out as number };
            stream.input = stream.output = null; // views of the module's memory, which can be reallocated
            return left;
        },
        reset(handle: number): number {
            return deflate.deflateReset(streams.get(handle)!.stream);
        },
        close(handle: number): void {
            streams.delete(handle);
        },
        checksum(isCrc: boolean, checksum: number, bytes: Uint8Array): number {
            return (isCrc ? crc32 : adler32)(checksum, bytes, bytes.length, 0) >>> 0;
        },
    };
}
