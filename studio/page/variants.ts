// Variants of a work: other seeds, other values, edited productions. Each is a pattern with its own settings.
import { Chance } from "./chance";
import type { Work } from "./context";
import { alphabetOf, mutated, namesIn, otherAngle, otherNumber, withSuccessor } from "./mutations";
import { withOption } from "./options";
import type { Opened } from "./protocol";

export type Pattern = Work["pattern"];

export interface Variant {
    readonly pattern: Pattern;
    readonly label: string; // describes the difference
    readonly part?: ChangedPart & { readonly predecessor: string }; // of an edited production
}

/// The part of a text that replaces part of another, with a little context.
export interface ChangedPart {
    readonly before: string;
    readonly changed: string;
    readonly after: string;
}

export function changedPart(old: string, now: string): ChangedPart {
    const shorter = Math.min(old.length, now.length);
    let same = 0;
    while (same < shorter && old[same] === now[same]) ++same;
    let end = 0;
    while (end < shorter - same && old[old.length - 1 - end] === now[now.length - 1 - end]) ++end;
    const before = now.slice(0, same);
    return {
        before: before.length > 4 ? `…${before.slice(-3)}` : before,
        changed: now.slice(same, now.length - end),
        after: now.slice(now.length - end),
    };
}

/// A value that can be varied or kept.
export interface Parameter {
    readonly name: string; // of the setting, or `production 3`
    readonly label: string;
    readonly kind: "n" | "seed" | "angle" | "define" | "production";
    readonly value: string;
}

export function parametersOf(facts: Opened): Parameter[] {
    const list: Parameter[] = [{ name: "derivation length", label: "n", kind: "n", value: facts.n }];
    const angle =
        facts.keys.find(({ name }) => name === "angle increment") ??
        facts.keys.find(({ name }) => name === "angle factor");
    if (facts.is_map) {
        // no turtle that turns
    } else if (angle?.name === "angle factor") {
        list.push({ name: "angle factor", label: "angle 360/", kind: "angle", value: angle.value });
    } else {
        list.push({
            name: "angle increment",
            label: "angle",
            kind: "angle",
            value: String(degreesOf(angle?.value ?? "90")),
        });
    }
    if (facts.is_random) list.push({ name: "seed", label: "seed", kind: "seed", value: facts.seed });
    for (const { name, value } of facts.defines) {
        if (Number.isFinite(Number(value))) list.push({ name, label: name, kind: "define", value });
    }
    return list;
}

export function productionsOf(facts: Opened): Parameter[] {
    return facts.productions.map(({ predecessor, successor }, index) => ({
        name: `production ${index}`,
        label: `${predecessor} → ${successor}`,
        kind: "production" as const,
        value: successor,
    }));
}

/// `25.7`, or `360/7`.
export function degreesOf(text: string): number {
    const [above, below] = text.split("/").map(Number);
    return below === undefined ? (above ?? NaN) : (above ?? NaN) / below;
}

export function withSetting(pattern: Pattern, name: string, value: string): Pattern {
    return { ...pattern, settings: withOption(pattern.settings, name, value) };
}

/// Further seeds, from `first`.
export function seedVariant(pattern: Pattern, first: bigint, index: number): Variant {
    const seed = String(first + BigInt(index));
    return { pattern: withSetting(pattern, "seed", seed), label: `seed ${seed}` };
}

/// An axis of a sheet: a parameter with its values.
export interface Axis {
    readonly parameter: Parameter;
    readonly values: readonly string[];
}

/// A range around the present value; whole numbers where required.
export function rangeOf(parameter: Parameter, most: string): { from: number; to: number } {
    const value = Number(parameter.value);
    if (parameter.kind === "n") {
        const limit = most === "" ? value + 2 : Math.min(Number(most), value + 2);
        const to = Math.max(limit, 1);
        return { from: Math.max(0, to - 5), to };
    }
    if (parameter.kind === "seed") return { from: value, to: value + 5 };
    if (parameter.name === "angle factor") return { from: 3, to: Math.max(8, value + 2) };
    const away = value === 0 ? 1 : Math.abs(value) * 0.3;
    return { from: rounded(value - away), to: rounded(value + away) };
}

/// `count` values in a range; fewer if the range contains fewer whole numbers.
export function valuesOf(parameter: Parameter, from: number, to: number, count: number): string[] {
    const isWhole = parameter.kind === "n" || parameter.kind === "seed" || parameter.name === "angle factor";
    const values = Array.from({ length: count }, (_, index) => {
        const value = count === 1 ? from : from + ((to - from) * index) / (count - 1);
        return String(isWhole ? Math.round(value) : rounded(value));
    });
    return [...new Set(values)];
}

function rounded(value: number): number {
    return Number(value.toPrecision(4));
}

/// A cell of a sheet of two parameters, followed by nearby values in case it is invalid.
export function sheetVariants(pattern: Pattern, across: Axis, down: Axis, column: number, row: number): Variant[] {
    const made = (x: string, y: string): Variant => ({
        pattern: withSetting(withSetting(pattern, across.parameter.name, x), down.parameter.name, y),
        label: `${across.parameter.label} ${x}, ${down.parameter.label} ${y}`,
    });
    const x = across.values[column]!;
    const y = down.values[row]!;
    const between = (axis: Axis, at: number, share: number) => {
        const value = Number(axis.values[at]);
        const next = Number(axis.values[at > 0 ? at - 1 : at + 1] ?? value);
        return valuesOf(axis.parameter, value + (next - value) * share, value, 1)[0]!;
    };
    const others = [0.25, 0.5].flatMap((share) => [
        made(between(across, column, share), y),
        made(x, between(down, row, share)),
    ]);
    return [made(x, y), ...others.filter(({ label }) => label !== made(x, y).label)];
}

/// A variant with edited productions and other values, except those kept. Depends only on seed and index.
export function mutantOf(
    pattern: Pattern,
    facts: Opened,
    kept: ReadonlySet<string>,
    seed: number,
    index: number,
): Variant | null {
    const chance = new Chance(seed, index);
    const productions = productionsOf(facts).filter(({ name }) => !kept.has(name));
    const values = parametersOf(facts).filter(({ name, kind }) => !kept.has(name) && kind !== "production");
    let made = pattern;
    const labels: string[] = [];
    let part: Variant["part"];
    const change = (parameter: Parameter, value: string, label = `${parameter.label} ${value}`) => {
        made = withSetting(made, parameter.name, value);
        labels.push(label);
    };
    const isEdited = productions.length > 0 && (values.length === 0 || chance.share() < 0.8);
    for (let left = isEdited ? 1 + chance.below(1.3) : 0; left > 0; --left) {
        const place = Number(chance.one(productions).name.split(" ")[1]);
        const text = edited(made.text, facts, place, chance);
        if (!text) continue;
        made = { ...made, text: text.text };
        labels.push(text.label);
        part ??= text.part;
    }
    for (const parameter of values) {
        if (chance.share() > (isEdited ? 0.22 : 0.7)) continue;
        if (parameter.kind === "angle") {
            const key = parameter.name as "angle factor" | "angle increment";
            const value = String(otherAngle(key, Number(parameter.value), chance));
            change(parameter, value, key === "angle factor" ? `angle 360/${value}` : `angle ${value}°`);
        } else if (parameter.kind === "define") {
            change(parameter, otherNumber(parameter.value, chance));
        } else if (parameter.kind === "n") {
            change(parameter, String(Math.max(1, Number(parameter.value) + (chance.share() < 0.5 ? -1 : 1))));
        } else if (parameter.kind === "seed") {
            change(parameter, String(chance.below(1_000_000)));
        }
    }
    if (labels.length === 0) return null;
    return { pattern: made, label: [...new Set(labels)].join(", "), ...(part && labels.length === 1 ? { part } : {}) };
}

function edited(
    text: string,
    facts: Opened,
    index: number,
    chance: Chance,
): { text: string; label: string; part: NonNullable<Variant["part"]> } | null {
    const production = facts.productions[index];
    if (!production) return null;
    const names = namesIn(facts.keys.find(({ name }) => name === "symbols")?.value);
    const axiom = facts.keys.find(({ name }) => name === "axiom")?.value ?? "";
    // Only the production's own modules are certain to use valid names of parameters.
    const sources = production.successor.includes("(")
        ? [production.successor]
        : [...facts.productions.map(({ successor }) => successor), axiom];
    const alphabet = alphabetOf(sources, names).filter((module) => sources.length === 1 || !module.includes("("));
    const successor = mutated(production.successor, alphabet, chance, names);
    if (successor === null) return null;
    // If this line was already edited, the production no longer matches and is left as it is.
    const made = withSuccessor(text, production, successor);
    if (made === null) return null;
    const { predecessor } = production;
    const part = { predecessor, ...changedPart(production.successor, successor) };
    return { text: made, label: `${predecessor} → ${successor}`, part };
}
