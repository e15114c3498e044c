// Decompresses LZMA, which is a quarter smaller than what browsers decompress. Source: LZMA specification (Igor Pavlov,
// 2015, public domain), whose names of decoders are kept.

/// @param packed  the properties lc + 9 (lp + 5 pb) in a byte, then the data
/// @param size  of the result in bytes
export function unpackLzma(packed: Uint8Array, size: number): Uint8Array<ArrayBuffer> {
    const out = new Uint8Array(size);
    const properties = packed[0]!;
    const lc = properties % 9;
    const lpMask = (1 << (Math.floor(properties / 9) % 5)) - 1;
    const pbMask = (1 << Math.floor(properties / 45)) - 1;
    const probabilities = (count: number) => new Uint16Array(count).fill(1024);

    let next = 2; // the first byte of the data is 0
    // Range and code. Variables that closures share would hold numbers above 2^30 in objects of their own, which takes
    // three times as long.
    const coder = new Uint32Array([0xffffffff, 0]);
    for (let i = 0; i < 4; ++i) coder[1] = (coder[1]! << 8) | packed[next++]!;

    function bit(of: Uint16Array, index: number): number {
        const probability = of[index]!;
        let range = coder[0]!;
        let code = coder[1]!;
        const bound = (range >>> 11) * probability;
        let one = 0;
        if (code < bound) {
            range = bound;
            of[index] = probability + ((2048 - probability) >> 5);
        } else {
            range -= bound;
            code -= bound;
            of[index] = probability - (probability >> 5);
            one = 1;
        }
        if (range < 0x1000000) {
            range = (range << 8) >>> 0;
            code = ((code << 8) | packed[next++]!) >>> 0;
        }
        coder[0] = range;
        coder[1] = code;
        return one;
    }
    function bitTree(of: Uint16Array, base: number, bits: number): number {
        let symbol = 1;
        for (let i = 0; i < bits; ++i) symbol = (symbol << 1) | bit(of, base + symbol);
        return symbol - (1 << bits);
    }
    function reverseTree(of: Uint16Array, base: number, bits: number): number {
        let symbol = 1;
        let value = 0;
        for (let i = 0; i < bits; ++i) {
            const one = bit(of, base + symbol);
            symbol = (symbol << 1) | one;
            value |= one << i;
        }
        return value;
    }
    function directBits(count: number): number {
        let range = coder[0]!;
        let code = coder[1]!;
        let value = 0;
        for (let i = 0; i < count; ++i) {
            range >>>= 1;
            const one = code >= range ? 1 : 0;
            if (one) code -= range;
            value = (value << 1) | one;
            if (range < 0x1000000) {
                range = (range << 8) >>> 0;
                code = ((code << 8) | packed[next++]!) >>> 0;
            }
        }
        coder[0] = range;
        coder[1] = code;
        return value;
    }
    function lengthDecoder(): (posState: number) => number {
        const choice = probabilities(2);
        const low = probabilities(16 << 3);
        const mid = probabilities(16 << 3);
        const high = probabilities(256);
        return (posState) => {
            if (bit(choice, 0) === 0) return bitTree(low, posState << 3, 3);
            if (bit(choice, 1) === 0) return 8 + bitTree(mid, posState << 3, 3);
            return 16 + bitTree(high, 0, 8);
        };
    }

    const literals = probabilities(0x300 << (lc + Math.floor(properties / 9) % 5));
    const isMatch = probabilities(12 << 4);
    const isRep = probabilities(12);
    const isRepG0 = probabilities(12);
    const isRepG1 = probabilities(12);
    const isRepG2 = probabilities(12);
    const isRep0Long = probabilities(12 << 4);
    const posSlot = probabilities(4 << 6);
    const posDecoders = probabilities(115);
    const align = probabilities(16);
    const length = lengthDecoder();
    const repLength = lengthDecoder();

    let state = 0;
    let [rep0, rep1, rep2, rep3] = [0, 0, 0, 0];
    for (let at = 0; at < size; ) {
        const posState = at & pbMask;
        if (bit(isMatch, (state << 4) + posState) === 0) {
            const before = at > 0 ? out[at - 1]! : 0;
            const base = 0x300 * (((at & lpMask) << lc) + (before >> (8 - lc)));
            let symbol = 1;
            if (state >= 7) {
                let matched = out[at - rep0 - 1]!;
                while (symbol < 0x100) {
                    const expected = (matched >> 7) & 1;
                    matched <<= 1;
                    const one = bit(literals, base + ((1 + expected) << 8) + symbol);
                    symbol = (symbol << 1) | one;
                    if (one !== expected) break;
                }
            }
            while (symbol < 0x100) symbol = (symbol << 1) | bit(literals, base + symbol);
            out[at++] = symbol & 0xff;
            state = state < 4 ? 0 : state < 10 ? state - 3 : state - 6;
            continue;
        }
        let count: number;
        if (bit(isRep, state) === 1) {
            if (bit(isRepG0, state) === 0) {
                if (bit(isRep0Long, (state << 4) + posState) === 0) {
                    state = state < 7 ? 9 : 11;
                    out[at] = out[at - rep0 - 1]!;
                    ++at;
                    continue;
                }
            } else {
                let distance = rep1;
                if (bit(isRepG1, state) === 1) {
                    distance = rep2;
                    if (bit(isRepG2, state) === 1) {
                        distance = rep3;
                        rep3 = rep2;
                    }
                    rep2 = rep1;
                }
                rep1 = rep0;
                rep0 = distance;
            }
            count = repLength(posState);
            state = state < 7 ? 8 : 11;
        } else {
            rep3 = rep2;
            rep2 = rep1;
            rep1 = rep0;
            count = length(posState);
            state = state < 7 ? 7 : 10;
            const slot = bitTree(posSlot, Math.min(count, 3) << 6, 6);
            rep0 = slot;
            if (slot >= 4) {
                const bits = (slot >> 1) - 1;
                rep0 = ((2 | (slot & 1)) << bits) >>> 0;
                if (slot < 14) {
                    rep0 += reverseTree(posDecoders, rep0 - slot, bits);
                } else {
                    rep0 = (rep0 + ((directBits(bits - 4) << 4) >>> 0) + reverseTree(align, 0, 4)) >>> 0;
                }
            }
        }
        for (count += 2; count > 0 && at < size; --count, ++at) out[at] = out[at - rep0 - 1]!;
    }
    return out;
}
