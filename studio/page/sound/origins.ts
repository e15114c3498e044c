// Looks up the origins of notes in the text of the pattern, before they are played.
import type { Engine } from "../context";
import type { Origins, PatternRequest, Place } from "../protocol";
import type { Melody } from "./melody";

const batch = 200;
const most_kept = 20_000;

export class NoteOrigins {
    private found = new Map<number, Place | null>(); // by position in the word
    private asking = false;
    private generation = 0;
    private melody: Melody | null = null;
    private pattern: PatternRequest | null = null;

    constructor(private readonly engine: Engine) {}

    reset(melody: Melody | null, pattern: PatternRequest | null): void {
        this.melody = melody;
        this.pattern = pattern;
        this.found.clear();
        this.asking = false;
        ++this.generation;
    }

    placeOf(note: number): Place | null {
        return this.melody ? (this.found.get(this.melody.symbol[note]) ?? null) : null;
    }

    /// Requests the origins of the notes from this one on, unless they are known.
    async lookAhead(note: number): Promise<void> {
        const { melody, pattern } = this;
        if (!melody || !pattern || this.asking) return;
        const wanted = new Set<number>();
        const until = Math.min(melody.count, note + batch);
        let firstUnknown = -1;
        for (let i = note; i < until; ++i) {
            if (melody.symbol[i] < 0 || this.found.has(melody.symbol[i])) continue;
            if (firstUnknown < 0) firstUnknown = i;
            wanted.add(melody.symbol[i]);
        }
        // Half a batch is left, which is enough time to request the next.
        if (firstUnknown < 0 || (firstUnknown > note + batch / 2 && until < melody.count)) return;
        const symbols = [...wanted];
        const generation = this.generation;
        this.asking = true;
        try {
            const { json } = await this.engine.request<Origins>(
                { do: "origins", symbols: symbols.map(String), pattern },
                { key: "origins", lane: "back" },
            );
            if (generation !== this.generation) return;
            if (this.found.size > most_kept) this.found.clear();
            json.origins.forEach((origin, index) => {
                this.found.set(symbols[index], origin && origin.line > 0 ? origin : null);
            });
        } catch {
            if (generation !== this.generation) return;
            for (const symbol of symbols) this.found.set(symbol, null); // not requested again
        }
        this.asking = false;
    }
}
