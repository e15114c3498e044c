// Repeatable random numbers: the same seed gives the same numbers.
import { makeChance } from "./sound/chance";

export class Chance {
    /// A number in [0, 1).
    readonly share: () => number;

    constructor(seed: number, index = 0) {
        this.share = makeChance(Math.imul(seed | 0, 0x9e3779b1) ^ Math.imul((index | 0) + 1, 0x85ebca6b));
        for (let round = 0; round < 3; ++round) this.share();
    }

    /// A whole number from 0 to `count` - 1.
    below(count: number): number {
        return Math.floor(this.share() * count);
    }

    one<Item>(items: readonly Item[]): Item {
        return items[this.below(items.length)]!;
    }
}

/// A number of 53 bits from a text: cyrb53. Different texts almost certainly give different numbers.
export function hashOf(text: string): number {
    let high = 0xdeadbeef;
    let low = 0x41c6ce57;
    for (let index = 0; index < text.length; ++index) {
        const code = text.charCodeAt(index);
        high = Math.imul(high ^ code, 2654435761);
        low = Math.imul(low ^ code, 1597334677);
    }
    high = Math.imul(high ^ (high >>> 16), 2246822507) ^ Math.imul(low ^ (low >>> 13), 3266489909);
    low = Math.imul(low ^ (low >>> 16), 2246822507) ^ Math.imul(high ^ (high >>> 13), 3266489909);
    return 4294967296 * (2097151 & low) + (high >>> 0);
}
