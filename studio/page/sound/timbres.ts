// The timbres, and the timbre of each General MIDI instrument.
import { drum, tunedDrum } from "./drums";
import { curvedBridge, electricPiano, piano, struck, type CurvedBridge, type Struck } from "./partials";
import { pluckedString, type PluckedString } from "./plucked_string";
import type { Sample } from "./sample";
import { levelled } from "./sample";
import type { Sustained } from "./sustained";
import { formants, sustained } from "./sustained";

export interface Timbre {
    name: string;
    label: string;
    render(key: number, rate: number): Sample;
    attack: number; // seconds
    release: number; // seconds until the note is silent after its end
    brightness: [number, number]; // the filter opens to this many harmonics for the softest and the loudest notes
    vibrato?: { hertz: number; cents: number; delay: number }; // begins after a delay
    reverb: number; // share sent to the reverb
    trim?: number; // level, to compensate for the filter
    lasts?: boolean; // sustained as long as the note
    everyKey?: boolean; // each key has a different sound, as in a drum kit
}

const lasting = (sound: Sustained) => ({
    lasts: true, render: (key: number, rate: number): Sample => sustained(sound, key, rate),
});
const plucked = (string: PluckedString) => ({
    render: (key: number, rate: number): Sample => pluckedString(string, key, rate),
});
const bridged = (string: CurvedBridge) => ({
    render: (key: number, rate: number): Sample => curvedBridge(string, key, rate),
});
/// A bar or bell with these partials: ratio, level, seconds.
const bar = (list: [number, number, number][], rest: Omit<Struck, "partials">) => {
    const partials = list.map(([ratio, level, seconds]) => ({ ratio, level, seconds }));
    return { render: (key: number, rate: number): Sample => struck({ partials, ...rest }, key, rate) };
};

const guitarBody: [number, number, number][] = [[104, 22, 0.9], [206, 30, 0.7], [420, 60, 0.35]];
const harpBody: [number, number, number][] = [[190, 60, 0.4], [380, 90, 0.3]];
const violin = formants([[290, 90, 1], [560, 180, 0.9], [1300, 500, 0.7], [2700, 900, 0.7]], 0.25);
const vowel = formants([[620, 110, 1], [1080, 130, 0.6], [2500, 220, 0.16], [3300, 300, 0.1]], 0.015);
const reed = formants([[1050, 350, 1], [2900, 600, 0.5]], 0.12);
const brassTilt = (hertz: number): number => 1 / (1 + (hertz / 1500) ** 2.2);
const drawbars: Record<number, number> = { 1: 1, 2: 0.9, 3: 0.55, 4: 0.5, 6: 0.25, 8: 0.3 };
const odd = (k: number): number => (k % 2 === 1 ? 1 : 0.12);

export const timbres: readonly Timbre[] = [
    {
        name: "piano", label: "Piano", attack: 0.001, release: 0.28, brightness: [2, 34], reverb: 0.16,
        render: piano,
    },
    {
        name: "electric-piano", label: "Electric piano", attack: 0.002, release: 0.3,
        brightness: [1.4, 20], reverb: 0.18,
        render: electricPiano,
    },
    {
        name: "harpsichord", label: "Harpsichord", attack: 0.001, release: 0.14, brightness: [30, 60], reverb: 0.2,
        ...plucked({ seconds: 3.2, ring: 0.5, position: 0.11, hardness: 1, noise: 0.5, body: harpBody }),
    },
    {
        name: "celesta", label: "Music box", attack: 0.001, release: 0.9, brightness: [2, 16], reverb: 0.3,
        ...bar([[1, 1, 1.9], [2.76, 0.22, 0.7], [5.4, 0.16, 0.3], [8.93, 0.06, 0.12]],
            { stretch: 0.7, attack: 0.001, knock: [4500, 0.02, 0.12] }),
    },
    {
        name: "vibraphone", label: "Vibraphone", attack: 0.001, release: 0.7, brightness: [1.5, 12], reverb: 0.26,
        ...bar([[1, 1, 3.2], [3.99, 0.22, 1], [9.9, 0.05, 0.2]], { stretch: 0.6, attack: 0.002 }),
    },
    {
        name: "marimba", label: "Marimba", attack: 0.001, release: 0.3, brightness: [1.6, 12], reverb: 0.2,
        ...bar([[1, 1, 0.75], [3.93, 0.3, 0.16], [9.2, 0.12, 0.06]],
            { stretch: 1, attack: 0.001, knock: [900, 0.025, 0.35] }),
    },
    {
        name: "xylophone", label: "Xylophone", attack: 0.001, release: 0.2, brightness: [3, 20], reverb: 0.2,
        ...bar([[1, 1, 0.42], [3, 0.5, 0.2], [6.1, 0.3, 0.1]],
            { stretch: 0.8, attack: 0.001, knock: [2500, 0.02, 0.3] }),
    },
    {
        name: "bell", label: "Bell", attack: 0.001, release: 1.6, brightness: [2, 20], reverb: 0.34,
        ...bar([[1, 1, 4.2], [0.501, 0.5, 5.2], [1.19, 0.55, 3], [1.502, 0.4, 2.2], [2.003, 0.6, 2],
            [2.62, 0.3, 1.1], [3.01, 0.25, 0.9], [4.17, 0.2, 0.6], [5.43, 0.14, 0.4]],
            { stretch: 0.45, attack: 0.001, knock: [3500, 0.015, 0.15] }),
    },
    {
        name: "organ", label: "Organ", attack: 0.012, release: 0.07, brightness: [16, 30], reverb: 0.26, trim: 0.8,
        ...lasting({ level: (k) => drawbars[k] ?? 0, spread: 0, breath: 0.012, breath_hertz: [900, 5000] }),
    },
    {
        name: "pipe-organ", label: "Pipe organ", attack: 0.04, release: 0.2, brightness: [20, 40], reverb: 0.45,
        ...lasting({ level: (k) => ([1, 2, 4, 8].includes(k) ? 1 : 0.22) / k ** 0.75, spread: 5, breath: 0.03 }),
    },
    {
        name: "accordion", label: "Accordion", attack: 0.03, release: 0.09, brightness: [14, 30], reverb: 0.2,
        ...lasting({ level: (k, hertz) => reed(hertz) / k ** 0.7 + (k === 1 ? 0.3 : 0), spread: 9, breath: 0.02 }),
    },
    {
        name: "guitar", label: "Guitar", attack: 0.001, release: 0.35, brightness: [3.5, 50], reverb: 0.16,
        ...plucked({ seconds: 4.2, ring: 0.16, position: 0.16, hardness: 0.45, noise: 0.9, body: guitarBody }),
    },
    {
        name: "harp", label: "Harp", attack: 0.001, release: 0.9, brightness: [3, 40], reverb: 0.3,
        ...plucked({ seconds: 4.6, ring: 0.1, position: 0.4, hardness: 0.3, noise: 0.4, body: harpBody }),
    },
    {
        name: "koto", label: "Koto", attack: 0.001, release: 0.5, brightness: [6, 55], reverb: 0.22,
        ...plucked({ seconds: 3.4, ring: 0.3, position: 0.08, hardness: 0.9, noise: 0.7,
            body: [[310, 60, 0.6], [720, 120, 0.4]] }),
    },
    {
        name: "banjo", label: "Banjo", attack: 0.001, release: 0.15, brightness: [8, 55], reverb: 0.14,
        ...plucked({ seconds: 1.1, ring: 0.5, position: 0.1, hardness: 1, noise: 0.6,
            body: [[520, 160, 1.2], [950, 220, 0.8]] }),
    },
    {
        name: "pizzicato", label: "Plucked strings", attack: 0.001, release: 0.2, brightness: [3, 26], reverb: 0.28,
        ...plucked({ seconds: 0.9, ring: 0.2, position: 0.25, hardness: 0.2, noise: 0.6,
            body: [[280, 60, 1], [460, 90, 0.7]] }),
    },
    {
        name: "bass", label: "Bass", attack: 0.002, release: 0.14, brightness: [4, 26], reverb: 0.06,
        ...plucked({ seconds: 2.6, ring: 0.08, position: 0.2, hardness: 0.25, noise: 0.3, body: [[95, 50, 0.5]] }),
    },
    {
        name: "veena", label: "Veena", attack: 0.001, release: 0.5, brightness: [4, 34], reverb: 0.2,
        ...bridged({ seconds: 4.4, begin: 14, end: 3, fall: 1.1, buzz: 2.2, position: 0.13, attack: 0.002 }),
    },
    {
        name: "sitar", label: "Sitar", attack: 0.001, release: 0.5, brightness: [7, 50], reverb: 0.24,
        ...bridged({ seconds: 4, begin: 26, end: 6, fall: 0.9, buzz: 5, position: 0.08, attack: 0.0015 }),
    },
    {
        name: "tanpura", label: "Tanpura", attack: 0.004, release: 1.8, brightness: [6, 50], reverb: 0.34,
        ...bridged({ seconds: 8, begin: 22, end: 4, fall: 3.2, buzz: 6, position: 0.22, attack: 0.012 }),
    },
    {
        name: "kalimba", label: "Kalimba", attack: 0.001, release: 0.5, brightness: [1.5, 14], reverb: 0.24,
        ...bar([[1, 1, 1.2], [5.8, 0.16, 0.14], [2.02, 0.1, 0.5]],
            { stretch: 0.6, attack: 0.0015, knock: [700, 0.03, 0.3] }),
    },
    {
        name: "steel-drum", label: "Steel drum", attack: 0.002, release: 0.4, brightness: [2, 14], reverb: 0.24,
        ...bar([[1, 1, 1], [2, 0.7, 0.8], [3, 0.3, 0.45], [4.05, 0.25, 0.3], [0.9975, 0.2, 0.9], [1.0025, 0.2, 0.9]],
            { stretch: 0.6, attack: 0.004 }),
    },
    {
        name: "strings", label: "Strings", attack: 0.16, release: 0.35, brightness: [5, 22], reverb: 0.34,
        vibrato: { hertz: 5.1, cents: 7, delay: 0.35 },
        ...lasting({ level: (k, hertz) => violin(hertz) / k ** 0.95, spread: 26, breath: 0.015 }),
    },
    {
        name: "violin", label: "Violin", attack: 0.06, release: 0.14, brightness: [8, 26], reverb: 0.26,
        vibrato: { hertz: 5.6, cents: 17, delay: 0.28 },
        ...lasting({ level: (k, hertz) => violin(hertz) / k ** 0.85, spread: 3, breath: 0.05 }),
    },
    {
        name: "choir", label: "Choir", attack: 0.14, release: 0.4, brightness: [16, 30], reverb: 0.42, trim: 0.9,
        vibrato: { hertz: 4.8, cents: 9, delay: 0.3 },
        ...lasting({ level: (k, hertz) => vowel(hertz) / k ** 0.4, spread: 30,
            breath: 0.05, breath_hertz: [500, 6000] }),
    },
    {
        name: "brass", label: "Brass", attack: 0.05, release: 0.12, brightness: [4, 26], reverb: 0.24,
        vibrato: { hertz: 4.8, cents: 6, delay: 0.5 },
        ...lasting({ level: (k, hertz) => brassTilt(hertz) / k ** 0.25, spread: 3, breath: 0.02 }),
    },
    {
        name: "saxophone", label: "Saxophone", attack: 0.035, release: 0.1, brightness: [7, 24], reverb: 0.2,
        vibrato: { hertz: 5.2, cents: 14, delay: 0.4 },
        ...lasting({ level: (k, hertz) => (reed(hertz) + 0.5 / k) / k ** 0.6, spread: 2, breath: 0.07 }),
    },
    {
        name: "oboe", label: "Oboe", attack: 0.03, release: 0.09, brightness: [10, 24], reverb: 0.22,
        vibrato: { hertz: 5.4, cents: 10, delay: 0.35 },
        ...lasting({ level: (k, hertz) => reed(hertz) / k ** 0.35, spread: 0, breath: 0.025 }),
    },
    {
        name: "clarinet", label: "Clarinet", attack: 0.04, release: 0.09, brightness: [8, 22], reverb: 0.22,
        vibrato: { hertz: 4.9, cents: 4, delay: 0.6 },
        ...lasting({ level: (k, hertz) => odd(k) / (k * (1 + (hertz / 3200) ** 2)), spread: 0, breath: 0.02 }),
    },
    {
        name: "flute", label: "Flute", attack: 0.07, release: 0.12, brightness: [2.2, 12], reverb: 0.3, trim: 0.87,
        vibrato: { hertz: 5.2, cents: 11, delay: 0.35 },
        ...lasting({
            level: (k, hertz) => [1, 0.55, 0.22, 0.1, 0.06, 0.035, 0.02][k - 1] / (1 + (hertz / 4500) ** 2) || 0,
            spread: 0, breath: 0.13,
        }),
    },
    {
        name: "bansuri", label: "Bamboo flute", attack: 0.09, release: 0.16, brightness: [2, 11], reverb: 0.34,
        vibrato: { hertz: 4.6, cents: 18, delay: 0.45 },
        ...lasting({
            level: (k) => [1, 0.3, 0.26, 0.05, 0.07, 0.02][k - 1] ?? 0, spread: 0, breath: 0.26,
        }),
    },
    {
        name: "lead", label: "Synth lead", attack: 0.008, release: 0.1, brightness: [5, 30], reverb: 0.18, trim: 1.35,
        vibrato: { hertz: 5.5, cents: 8, delay: 0.4 },
        ...lasting({ level: (k) => 1 / k, spread: 6, breath: 0 }),
    },
    {
        name: "square", label: "Square wave", attack: 0.006, release: 0.08, brightness: [7, 30], reverb: 0.16,
        ...lasting({ level: (k) => (k % 2 === 1 ? 1 / k : 0), spread: 0, breath: 0 }),
    },
    {
        name: "pad", label: "Pad", attack: 0.35, release: 0.9, brightness: [5, 14], reverb: 0.45,
        ...lasting({ level: (k) => 1 / k ** 1.25, spread: 45, breath: 0.02 }),
    },
    {
        name: "air", label: "Air", attack: 0.2, release: 0.6, brightness: [12, 30], reverb: 0.4,
        ...lasting({ level: (k) => 0.5 / k ** 1.2, spread: 20, breath: 0.9 }),
    },
    {
        name: "mridangam", label: "Mridangam", attack: 0.001, release: 0.4, brightness: [6, 30], reverb: 0.16,
        render: tunedDrum,
    },
    {
        name: "drums", label: "Drum kit", attack: 0.0005, release: 0.5,
        brightness: [200, 200], reverb: 0.12, trim: 1.25,
        render: drum, everyKey: true,
    },
];

export function timbreNamed(name: string): Timbre {
    return timbres.find((timbre) => timbre.name === name) ?? timbres[0];
}

/// Timbres by the first program that uses them, 0 to 127.
const programs: [number, string][] = [
    [0, "piano"], [4, "electric-piano"], [6, "harpsichord"], [8, "celesta"], [11, "vibraphone"], [12, "marimba"],
    [13, "xylophone"], [14, "bell"], [15, "koto"], [16, "organ"], [19, "pipe-organ"], [20, "accordion"],
    [24, "guitar"], [32, "bass"], [38, "lead"], [40, "violin"], [43, "strings"], [45, "pizzicato"], [46, "harp"],
    [47, "mridangam"], [48, "strings"], [50, "pad"], [52, "choir"], [55, "brass"], [64, "saxophone"], [68, "oboe"],
    [71, "clarinet"], [72, "flute"], [75, "bansuri"], [79, "flute"], [80, "square"], [81, "lead"], [85, "choir"],
    [86, "lead"], [88, "pad"], [91, "choir"], [92, "strings"], [93, "bell"], [94, "pad"], [96, "air"], [97, "pad"],
    [98, "celesta"], [99, "air"], [100, "electric-piano"], [101, "pad"], [104, "sitar"], [105, "banjo"],
    [106, "koto"], [108, "kalimba"], [109, "oboe"], [110, "violin"], [111, "oboe"], [112, "celesta"],
    [113, "bell"], [114, "steel-drum"], [115, "xylophone"], [116, "mridangam"], [119, "air"],
];

export function timbreOf(program: number): Timbre {
    return timbreNamed(programs.findLast(([first]) => first <= program)?.[1] ?? "piano");
}

/// The rendered key used for a key, which is played at another rate.
export function renderedKey(timbre: Timbre, key: number): number {
    const step = timbre.everyKey ? 1 : timbre.lasts ? 3 : 2;
    return Math.min(120, Math.max(12, Math.round(key / step) * step));
}

export function renderTimbre(timbre: Timbre, key: number, rate: number): Sample {
    const sample = timbre.render(key, rate);
    levelled(sample, rate, timbre.everyKey ? 60 : key);
    return sample;
}
