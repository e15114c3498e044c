// The notes of a melody as arrays, in the order of their onsets.
import type { Notes } from "../protocol";

const doubles = 10; // per note in the answer to `notes`

export interface Melody {
    readonly count: number;
    readonly end: number; // ticks, including rests
    readonly ticks: number; // per quarter note
    readonly bar: number; // ticks, at the beginning
    readonly beat: number; // ticks, at the beginning
    readonly meters: readonly Meter[]; // the first, and its changes
    readonly firstBar: number; // its number: 0 for an upbeat
    readonly tempo: number; // quarter notes per minute, at the beginning
    readonly tempos: readonly Tempo[]; // the first, and its changes
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

/// A meter from a bar line on.
export interface Meter {
    onset: number; // ticks; below 0 before an upbeat
    beats: number; // per bar
    beat: number; // ticks
    bar: number; // ticks
    before: number; // bars before it
}

/// A tempo from a tick on.
export interface Tempo {
    onset: number;
    tempo: number; // quarter notes per minute
    seconds: number; // from the beginning
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
    const meters = metersOf(notes);
    return {
        count,
        end: Math.max(notes.end, 1),
        ticks: notes.ticks,
        bar: meters[0]!.bar,
        beat: meters[0]!.beat,
        meters,
        firstBar: notes.upbeat ? 0 : 1,
        tempo: notes.tempo,
        tempos: temposOf(notes),
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

function metersOf({ beats, unit, ticks, upbeat = 0, changes = [] }: Notes): Meter[] {
    const meterOf = (onset: number, beats: number, unit: number, before: number): Meter => {
        const beat = (4 * ticks) / unit;
        return { onset, beats, beat, bar: beats * beat, before };
    };
    const first = meterOf(0, beats, unit, 0);
    const meters = [upbeat > 0 ? { ...first, onset: upbeat - first.bar } : first];
    for (const change of changes) {
        const last = meters.at(-1)!;
        const next = meterOf(change.onset, change.beats ?? last.beats, change.unit ?? (4 * ticks) / last.beat, 0);
        if (next.beats === last.beats && next.beat === last.beat) continue;
        next.before = last.before + Math.ceil((next.onset - last.onset) / last.bar - 1e-9);
        meters.push(next);
    }
    return meters;
}

function temposOf({ tempo, ticks, changes = [] }: Notes): Tempo[] {
    const tempos: Tempo[] = [{ onset: 0, tempo, seconds: 0 }];
    for (const { onset, tempo: next } of changes) {
        const last = tempos.at(-1)!;
        if (Math.abs(next - last.tempo) < 1e-9) continue;
        const seconds = last.seconds + ((onset - last.onset) * 60) / (last.tempo * ticks);
        tempos.push({ onset, tempo: next, seconds });
    }
    return tempos;
}

/// The last entry for which `isAfter` is false; the first one if it is true for all.
function lastBefore<Entry>(entries: readonly Entry[], isAfter: (entry: Entry) => boolean): Entry {
    let low = 0;
    let high = entries.length - 1;
    while (low < high) {
        const middle = (low + high + 1) >> 1;
        if (isAfter(entries[middle]!)) high = middle - 1;
        else low = middle;
    }
    return entries[low]!;
}

/// Quarter notes per minute at a tick. @param chosen  a tempo for the whole piece; null: its own tempos
export function tempoAt(melody: Melody, tick: number, chosen: number | null): number {
    return chosen ?? lastBefore(melody.tempos, ({ onset }) => onset > tick).tempo;
}

/// Seconds from the beginning to a tick. @param chosen  as in tempoAt()
export function secondsAt(melody: Melody, tick: number, chosen: number | null): number {
    if (chosen !== null) return (tick * 60) / (chosen * melody.ticks);
    const { onset, tempo, seconds } = lastBefore(melody.tempos, (each) => each.onset > tick);
    return seconds + ((tick - onset) * 60) / (tempo * melody.ticks);
}

/// The tick at a time after the beginning. @param chosen  as in tempoAt()
export function tickAfter(melody: Melody, time: number, chosen: number | null): number {
    if (chosen !== null) return (time * chosen * melody.ticks) / 60;
    const { onset, tempo, seconds } = lastBefore(melody.tempos, (each) => each.seconds > time);
    return onset + ((time - seconds) * tempo * melody.ticks) / 60;
}

/// The meter at a tick.
const meterAt = (melody: Melody, tick: number): Meter => lastBefore(melody.meters, ({ onset }) => onset > tick);

/// The bar at a tick, counted from 0; whole at bar lines, else between those of the bar lines around it.
export function barAt(melody: Melody, tick: number): number {
    const meter = meterAt(melody, tick);
    return meter.before + (tick - meter.onset) / meter.bar;
}

/// The tick at which a bar begins, counted from 0.
export function barStart(melody: Melody, bar: number): number {
    const meter = lastBefore(melody.meters, ({ before }) => before > bar);
    return Math.max(0, meter.onset + (bar - meter.before) * meter.bar);
}

/// The ticks of the beats of a bar, without the first.
export function beatsIn(melody: Melody, bar: number): number[] {
    const meter = lastBefore(melody.meters, ({ before }) => before > bar);
    const start = meter.onset + (bar - meter.before) * meter.bar;
    return Array.from({ length: meter.beats - 1 }, (_, beat) => start + (beat + 1) * meter.beat);
}

export const barsOf = (melody: Melody): number => Math.max(1, Math.ceil(barAt(melody, melody.end) - 1e-9));

/// `Bar 12 of 64, beat 3`
export function placeText(melody: Melody, tick: number): string {
    const inside = Math.min(Math.max(0, tick), melody.end - 1e-6);
    const meter = meterAt(melody, inside);
    const bar = Math.floor(barAt(melody, inside));
    const beat = Math.floor((inside - meter.onset - (bar - meter.before) * meter.bar) / meter.beat);
    return `Bar ${bar + melody.firstBar} of ${barsOf(melody) + melody.firstBar - 1}, beat ${beat + 1}`;
}

const letters = ["C", "C♯", "D", "E♭", "E", "F", "F♯", "G", "G♯", "A", "B♭", "B"];

/// `C4`, or `C4 +14 cents`.
export function keyName(key: number): string {
    const whole = Math.round(key);
    const cents = Math.round((key - whole) * 100);
    const name = `${letters[((whole % 12) + 12) % 12]}${Math.floor(whole / 12) - 1}`;
    return cents === 0 ? name : `${name} ${cents > 0 ? "+" : "−"}${Math.abs(cents)} cents`;
}
