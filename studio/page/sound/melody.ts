// The notes of a melody as arrays, in the order of their onsets.
import type { Notes } from "../protocol";

const doubles = 10; // per note in the answer to `notes`

export interface Melody {
    readonly count: number;
    readonly end: number; // ticks, including rests
    readonly ticks: number; // per quarter note
    readonly bar: number; // ticks
    readonly beat: number; // ticks
    readonly beats: number; // per bar
    readonly tempo: number; // quarter notes per minute
    readonly changesTempo: boolean; // after the beginning
    readonly parts: Notes["parts"];
    readonly voices: number;
    readonly partOfVoice: number[];
    readonly longest: number; // ticks
    readonly lowest: number; // keys
    readonly highest: number;
    readonly onset: Float64Array;
    readonly duration: Float64Array;
    readonly key: Float64Array;
    readonly velocity: Uint8Array;
    readonly voice: Uint16Array;
    readonly path: Float64Array; // from x, from y, to x, to y of each note
    readonly symbol: Float64Array; // position in the word, -1: unknown
    readonly glides: ReadonlyMap<number, Glide>; // by note
    readonly box: [number, number, number, number]; // of the curve: x0, y0, x1, y1
}

/// A slide of the pitch at the end of a note.
export interface Glide {
    ticks: number;
    semitones: number;
}

export function readMelody(notes: Notes, bytes: Uint8Array): Melody {
    const count = Math.min(notes.count, Math.floor(bytes.byteLength / (8 * doubles)));
    const aligned = bytes.byteOffset % 8 === 0 ? bytes : bytes.slice();
    const all = new Float64Array(aligned.buffer, aligned.byteOffset, count * doubles);
    const order = inOrder(all, count);
    const slides = readGlides(aligned, notes);
    const glides = new Map<number, Glide>();
    order.forEach((note, place) => {
        const glide = slides.get(note);
        if (glide) glides.set(place, glide);
    });
    const column = (at: number) => Float64Array.from({ length: count }, (_, i) => all[order[i] * doubles + at]);
    const onset = column(0);
    const duration = column(1);
    const key = column(2);
    const voice = Uint16Array.from(column(4));
    const path = new Float64Array(4 * count);
    for (let i = 0; i < count; ++i) for (let k = 0; k < 4; ++k) path[4 * i + k] = all[order[i] * doubles + 5 + k];
    const box: Melody["box"] = [Infinity, Infinity, -Infinity, -Infinity];
    for (let i = 0; i < 4 * count; ++i) {
        const axis = i % 2;
        box[axis] = Math.min(box[axis], path[i]);
        box[axis + 2] = Math.max(box[axis + 2], path[i]);
    }
    const voices = Math.max(
        1,
        most(voice) + 1,
        notes.parts.reduce((sum, part) => sum + part.voices, 0),
    );
    const partOfVoice = notes.parts.flatMap((part, index) => Array<number>(part.voices).fill(index));
    while (partOfVoice.length < voices) partOfVoice.push(Math.max(0, notes.parts.length - 1));
    const unit = (4 * notes.ticks) / notes.unit;
    return {
        count,
        end: Math.max(notes.end, 1),
        ticks: notes.ticks,
        bar: unit * notes.beats,
        beat: unit,
        beats: notes.beats,
        tempo: notes.tempo,
        changesTempo: (notes.changes ?? []).some(({ tempo }) => Math.abs(tempo - notes.tempo) > 1e-9),
        parts: notes.parts,
        voices,
        partOfVoice,
        longest: most(duration),
        lowest: -most(key.map((value) => -value)),
        highest: most(key),
        onset,
        duration,
        key,
        velocity: Uint8Array.from(column(3)),
        voice,
        path,
        symbol: column(9),
        glides,
        box,
    };
}

/// Reads the glides, which follow the notes.
function readGlides(bytes: Uint8Array, notes: Notes): Map<number, Glide> {
    const glides = new Map<number, Glide>();
    const begin = notes.count * doubles * 8;
    const count = Math.min(notes.glides ?? 0, Math.floor((bytes.byteLength - begin) / 24));
    if (count <= 0) return glides;
    const all = new Float64Array(bytes.buffer, bytes.byteOffset + begin, 3 * count);
    for (let i = 0; i < count; ++i) glides.set(all[3 * i], { ticks: all[3 * i + 1], semitones: all[3 * i + 2] });
    return glides;
}

/// The semitones that a note slides, and in how many seconds. @param seconds  that the note lasts
export function slideOf(melody: Melody, note: number, seconds: number): { semitones: number; seconds: number } {
    const glide = melody.glides.get(note);
    if (!glide) return { semitones: 0, seconds: 0 };
    return { semitones: glide.semitones, seconds: (seconds * glide.ticks) / melody.duration[note] };
}

/// Merges the voices, which are listed one after another, in the order of onsets.
function inOrder(all: Float64Array, count: number): Uint32Array {
    const order = Uint32Array.from({ length: count }, (_, i) => i);
    let isSorted = true;
    for (let i = 1; i < count && isSorted; ++i) isSorted = all[(i - 1) * doubles] <= all[i * doubles];
    return isSorted ? order : order.sort((a, b) => all[a * doubles] - all[b * doubles] || a - b);
}

function most(values: ArrayLike<number>): number {
    let found = -Infinity;
    for (let i = 0; i < values.length; ++i) found = Math.max(found, values[i]);
    return found === -Infinity ? 0 : found;
}

/// The first note that begins at or after a tick.
export function firstFrom(melody: Melody, tick: number): number {
    let low = 0;
    let high = melody.count;
    while (low < high) {
        const middle = (low + high) >> 1;
        if (melody.onset[middle] < tick) low = middle + 1;
        else high = middle;
    }
    return low;
}

/// Calls `see` for every note that sounds between two ticks.
export function eachSounding(melody: Melody, begin: number, end: number, see: (note: number) => void): void {
    for (let i = firstFrom(melody, begin - melody.longest); i < melody.count && melody.onset[i] < end; ++i) {
        if (melody.onset[i] + melody.duration[i] > begin) see(i);
    }
}

export const barsOf = (melody: Melody): number => Math.max(1, Math.ceil(melody.end / melody.bar - 1e-9));

/// `Bar 12 of 64, beat 3`
export function placeText(melody: Melody, tick: number): string {
    const inside = Math.min(Math.max(0, tick), melody.end - 1e-6);
    const bar = Math.floor(inside / melody.bar);
    const beat = Math.floor((inside - bar * melody.bar) / melody.beat);
    return `Bar ${bar + 1} of ${barsOf(melody)}, beat ${beat + 1}`;
}

const letters = ["C", "C♯", "D", "E♭", "E", "F", "F♯", "G", "G♯", "A", "B♭", "B"];

/// `C4`, or `C4 +14 cents`.
export function keyName(key: number): string {
    const whole = Math.round(key);
    const cents = Math.round((key - whole) * 100);
    const name = `${letters[((whole % 12) + 12) % 12]}${Math.floor(whole / 12) - 1}`;
    return cents === 0 ? name : `${name} ${cents > 0 ? "+" : "−"}${Math.abs(cents)} cents`;
}
