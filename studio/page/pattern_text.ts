// Reads and writes values in the text of a pattern without the libraries: the values that sliders reset to, and the
// places where changed values are written.
import type { PatternRequest } from "./protocol";

// Texts come from anywhere. `[ \t]` instead of `\s`, which matches line breaks, keeps the time linear: otherwise all
// empty lines would be read again from each of them.

// Expressions as they stand in `define r = 0.75` or `variant a: r = 0.8, derivation length = 9`.
function written(line: string, name: string): string | null {
    const [given, value] = [line.slice(0, line.indexOf("=")).trim(), line.slice(line.indexOf("=") + 1).trim()];
    return given === name ? value : null;
}

function escaped(name: string): string {
    return name.replace(/[.*+?^${}()|[\]\\]/g, "\\$&");
}

// A regular expression for the text before the value of a key or define.
function startOf(name: string): string {
    return `[ \\t]*(?:define[ \\t]+${escaped(name)}[ \\t]*=|${escaped(name)}[ \\t]*:)`;
}

function withoutLastBreaks(text: string): string {
    let end = text.length;
    while (end > 0 && text[end - 1] === "\n") --end;
    return text.slice(0, end);
}

/// The value that a key or define has in the text, the chosen variant included; null if the text does not set it.
export function valueInText(pattern: PatternRequest, name: string): string | null {
    if (pattern.variant) {
        const start = `[ \\t]*variant[ \\t]+${escaped(pattern.variant)}[ \\t]*:`;
        const line = new RegExp(`^${start}(.*)$`, "mu").exec(pattern.text);
        for (const part of line?.[1]!.split(",") ?? []) {
            const value = written(part, name);
            if (value !== null) return value;
        }
    }
    const key = new RegExp(`^${startOf(name)}(.*)$`, "mu").exec(pattern.text);
    return key ? key[1]!.trim() : null;
}

/// The text with the settings written into it.
export function withSettings(pattern: PatternRequest): string {
    let { text } = pattern;
    for (const [name, value] of pattern.settings ?? []) {
        // A pattern has one of the two.
        const other = { "angle increment": "angle factor", "angle factor": "angle increment" }[name];
        if (other && !new RegExp(`^${startOf(name)}`, "mu").test(text)) {
            text = text.replace(new RegExp(`^([ \\t]*)${escaped(other)}(?=[ \\t]*:)`, "mu"), (_, space: string) => space + name);
        }
        const line = new RegExp(`^(${startOf(name)}[ \\t]*)(.*)$`, "mu");
        if (line.test(text)) text = text.replace(line, (_, start: string) => start + value);
        else text = `${withoutLastBreaks(text)}\n${name}: ${value}\n`;
    }
    return text;
}

/// The title in a text; empty if it has none.
export function titleIn(text: string): string {
    return valueInText({ name: "", text }, "title") ?? "";
}

/// The title of a pattern, or its name if it has none.
export function titleOf(pattern: { name: string; text: string }): string {
    return titleIn(pattern.text) || pattern.name.replace(/\.lsys$/, "");
}
