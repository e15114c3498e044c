// Small random edits of productions in the text of a pattern; the result is always a pattern.
import { Chance } from "./chance";

/// The place of a production, as the libraries report it.
export interface ProductionPlace {
    line: number;
    successor: string;
}

const brackets = new Set(["[", "]", "{", "}"]);
const closing: Readonly<Record<string, string>> = { "[": "]", "{": "}" };
const longestSuccessor = 400; // modules

/// The modules of a word: symbols with their parameters. Names of several characters are those of `symbols:`.
export function modulesOf(word: string, names: readonly string[] = []): string[] {
    const byLength = [...names].sort((one, other) => other.length - one.length);
    const modules: string[] = [];
    for (let at = 0; at < word.length;) {
        const rest = word.slice(at);
        if (/^\s/.test(rest)) {
            ++at;
            continue;
        }
        const name =
            byLength.find((each) => rest.startsWith(each)) ??
            (rest.startsWith("@") ? rest.slice(0, 2) : String.fromCodePoint(rest.codePointAt(0)!));
        let end = at + name.length;
        if (word[end] === "(") {
            let depth = 0;
            do {
                depth += word[end] === "(" ? 1 : word[end] === ")" ? -1 : 0;
                ++end;
            } while (depth > 0 && end < word.length);
        }
        modules.push(word.slice(at, end));
        at = end;
    }
    return modules;
}

export function isBalanced(modules: readonly string[]): boolean {
    const open: string[] = [];
    for (const module of modules) {
        if (closing[module]) open.push(closing[module]);
        else if (module === "]" || module === "}") {
            if (open.pop() !== module) return false;
        }
    }
    return open.length === 0;
}

/// Modules of these successors except brackets, as often as they occur, with the opposite of each turn.
export function alphabetOf(successors: readonly string[], names: readonly string[] = []): string[] {
    const modules = successors.flatMap((word) => modulesOf(word, names)).filter((module) => !brackets.has(module));
    if (modules.includes("+") || modules.includes("-")) modules.push("+", "-");
    return modules;
}

// Balanced sequences of limited length, which can be put in brackets, moved or repeated.
function stretches(modules: readonly string[], most: number): [number, number][] {
    const found: [number, number][] = [];
    for (let from = 0; from < modules.length; ++from) {
        for (let to = from + 1; to <= Math.min(modules.length, from + most); ++to) {
            if (isBalanced(modules.slice(from, to))) found.push([from, to]);
        }
    }
    return found;
}

type Edit = (modules: string[], alphabet: readonly string[], chance: Chance) => string[] | null;

function spliced(modules: readonly string[], at: number, removed: number, ...added: string[]): string[] {
    return [...modules.slice(0, at), ...added, ...modules.slice(at + removed)];
}

function plainPlaces(modules: readonly string[]): number[] {
    return modules.flatMap((module, index) => (brackets.has(module) ? [] : [index]));
}

const edits: readonly { edit: Edit; weight: number }[] = [
    {
        // swap neighbours
        weight: 4,
        edit: (modules, _, chance) => {
            const places = plainPlaces(modules).filter(
                (index) =>
                    index + 1 < modules.length &&
                    !brackets.has(modules[index + 1]!) &&
                    modules[index] !== modules[index + 1],
            );
            if (places.length === 0) return null;
            const at = chance.one(places);
            return spliced(modules, at, 2, modules[at + 1]!, modules[at]!);
        },
    },
    {
        // insert
        weight: 4,
        edit: (modules, alphabet, chance) => {
            if (alphabet.length === 0) return null;
            return spliced(modules, chance.below(modules.length + 1), 0, chance.one(alphabet));
        },
    },
    {
        // delete
        weight: 3,
        edit: (modules, _, chance) => {
            const places = plainPlaces(modules);
            return places.length < 2 ? null : spliced(modules, chance.one(places), 1);
        },
    },
    {
        // replace
        weight: 4,
        edit: (modules, alphabet, chance) => {
            const places = plainPlaces(modules);
            if (places.length === 0 || alphabet.length === 0) return null;
            return spliced(modules, chance.one(places), 1, chance.one(alphabet));
        },
    },
    {
        // turn the other way
        weight: 3,
        edit: (modules, _, chance) => {
            const opposite: Record<string, string> = { "+": "-", "-": "+", "&": "^", "^": "&", "\\": "/", "/": "\\" };
            const places = plainPlaces(modules).filter((index) => opposite[modules[index]!]);
            if (places.length === 0) return null;
            const at = chance.one(places);
            return spliced(modules, at, 1, opposite[modules[at]!]!);
        },
    },
    {
        // repeat a sequence
        weight: 2,
        edit: (modules, _, chance) => {
            const choices = stretches(modules, 4).filter(([from, to]) => to - from > 1);
            if (choices.length === 0) return null;
            const [from, to] = chance.one(choices);
            return spliced(modules, to, 0, ...modules.slice(from, to));
        },
    },
    {
        // reverse a sequence
        weight: 2,
        edit: (modules, _, chance) => {
            const choices = stretches(modules, 6).filter(
                ([from, to]) => to - from > 2 && !modules.slice(from, to).some((module) => brackets.has(module)),
            );
            if (choices.length === 0) return null;
            const [from, to] = chance.one(choices);
            return spliced(modules, from, to - from, ...modules.slice(from, to).reverse());
        },
    },
    {
        // add a branch, if there are branches already
        weight: 2,
        edit: (modules, _, chance) => {
            if (!modules.includes("[")) return null;
            const choices = stretches(modules, 4);
            if (choices.length === 0) return null;
            const [from, to] = chance.one(choices);
            return spliced(modules, from, to - from, "[", ...modules.slice(from, to), "]");
        },
    },
];

/// A successor with one to three edits that differs from the original; null if none was found.
export function mutated(
    successor: string,
    alphabet: readonly string[],
    chance: Chance,
    names: readonly string[] = [],
): string | null {
    const start = modulesOf(successor, names);
    if (!isBalanced(start)) return null;
    const total = edits.reduce((sum, { weight }) => sum + weight, 0);
    for (let attempt = 0; attempt < 12; ++attempt) {
        let modules = start;
        for (let left = 1 + Math.floor(chance.share() ** 2 * 3); left > 0; --left) {
            let at = chance.share() * total;
            const { edit } = edits.find(({ weight }) => (at -= weight) < 0) ?? edits[0]!;
            modules = edit(modules, alphabet, chance) ?? modules;
        }
        const isNew = modules.join("") !== start.join("");
        if (isNew && isBalanced(modules) && modules.length <= longestSuccessor) return modules.join("");
    }
    return null;
}

/// The text with the successor of one production replaced; null for productions that continue over several lines or
/// contain comments.
export function withSuccessor(text: string, place: ProductionPlace, successor: string): string | null {
    const lines = text.split("\n");
    const line = lines[place.line - 1];
    if (line === undefined || line.includes("/*") || /\s\\\r?$/.test(line)) return null;
    const arrow = line.indexOf("-->");
    const at = place.successor === "" ? -1 : line.indexOf(place.successor, arrow + 3);
    if (arrow < 0 || at < 0) return null;
    lines[place.line - 1] = line.slice(0, at) + successor + line.slice(at + place.successor.length);
    return lines.join("\n");
}

/// Names of several characters, from the value of the key `symbols`.
export function namesIn(value: string | undefined): string[] {
    return value?.split(/[\s,]+/).filter((name) => name !== "") ?? [];
}

const factors = [3, 4, 5, 6, 7, 8, 9, 10, 12, 14, 16, 18, 20, 24];

/// Another angle: a neighbouring `angle factor`, or an increment in degrees that differs by up to a fifth.
export function otherAngle(key: "angle factor" | "angle increment", value: number, chance: Chance): number {
    if (key === "angle factor") {
        const others = factors.filter((factor) => factor !== value && Math.abs(Math.log2(factor / value)) < 1.05);
        return others.length > 0 ? chance.one(others) : value + 1;
    }
    const change = (chance.share() < 0.5 ? -1 : 1) * (0.02 + 0.18 * chance.share()) * Math.max(10, Math.abs(value));
    return Math.round((value + change) * 10) / 10;
}

/// Another value of a define, as precise as it is written.
export function otherNumber(text: string, chance: Chance): string {
    const value = Number(text);
    const decimals = Math.max(/\.(\d+)$/.exec(text)?.[1]?.length ?? 0, Math.abs(value) < 10 ? 2 : 0);
    const size = Math.abs(value) > 0 ? Math.abs(value) : 1;
    const change = (chance.share() < 0.5 ? -1 : 1) * (0.04 + 0.26 * chance.share()) * size;
    return String(Number((value + change).toFixed(decimals)));
}
