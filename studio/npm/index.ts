// The npm package `sikku`: the libraries as functions for node and browsers. node.ts and browser.ts load the module.
import type { Diagnostic, Failure, Help, Made, Opened, OptionHelp, PatternRequest, Patterns } from "../page/protocol.js";
import type { Bridge } from "./bridge.js";

export type { Diagnostic, FormatHelp, KeyHelp, OptionHelp } from "../page/protocol.js";

/** The name of a bundled pattern, or a text with its name in messages. */
export type Pattern = string | { text: string; name?: string };

/**
 * Options of `sikku draw` and `sikku play` (`size`, `dot-spacing` or `dotSpacing`), keys and defines of the pattern
 * (`"angle factor"`), and `n`, `seed`, `variant`. Flags are true or false; undefined and null leave a value out.
 */
export type Values = Record<string, string | number | boolean | readonly (string | number)[] | null | undefined>;

/** A bundled pattern. */
export interface PatternInfo { name: string; kind: string; title: string; source: string; text: string }

/** An output: text for SVG, G-code, MusicXML and other text formats, bytes for the others. */
export interface Output { name: string; content: string | Uint8Array }

/** An error of a pattern, an option, or a limit. */
export class SikkuError extends Error {
    override name = "SikkuError";
    constructor(
        readonly kind: Failure["error"]["kind"],
        message: string,
        readonly option: string | undefined, // of kind "setting": the name of an option, a key or a define
        readonly diagnostics: Diagnostic[], // every error of the pattern and its settings, with its place
    ) {
        super(message);
    }
}

export class Sikku {
    private bundled: Map<string, PatternInfo> | null = null; // read on first use, because that takes a second
    private readonly known: Record<"draw" | "play", Map<string, OptionHelp>>;
    private readonly texts: Set<string>; // formats
    /** Keys of the language, symbols of the turtle, options and formats with their help. */
    readonly help: Help;
    /** The version of the libraries. */
    readonly version: string;

    /** Not public; use start(). */
    constructor(private readonly bridge: Bridge) {
        this.help = this.ask<Help>({ do: "help" }).answer;
        this.version = this.help.version;
        const options = (rows: Help["draw"]["options"]) => new Map(rows.map((row) => [row.name, row]));
        this.known = { draw: options(this.help.draw.options), play: options(this.help.play.options) };
        const formats = [...this.help.draw.formats, ...this.help.play.formats];
        this.texts = new Set(formats.filter((row) => row.is_text).flatMap((row) => [row.extension, row.alias]));
    }

    /** The bundled patterns. The first call takes a second. */
    patterns(): PatternInfo[] {
        return [...this.library().values()];
    }

    /** Draws a print or a model: `draw("hilbert", "svg", { n: 5, size: "A4" })`. Throws SikkuError. */
    draw(pattern: Pattern, format = "svg", values: Values = {}): string | Uint8Array {
        return only(this.outputs("draw", pattern, format, values));
    }

    /** Plays a pattern: `play("hilbert", "mid", { scale: "dorian" })`. Throws SikkuError. */
    play(pattern: Pattern, format = "mid", values: Values = {}): string | Uint8Array {
        return only(this.outputs("play", pattern, format, values));
    }

    /** All files of an output: a model (.obj and .mtl), or a print in sheets. */
    outputs(use: "draw" | "play", pattern: Pattern, format: string, values: Values = {}): Output[] {
        const { request, options } = this.split(use, pattern, values);
        const { answer, bytes } = this.ask<Made>({ do: "make", interpreter: use, format, options, pattern: request });
        let at = 0;
        return answer.outputs.map(({ name, size }) => {
            const content = bytes.slice(at, (at += size));
            return { name, content: this.texts.has(format) ? new TextDecoder().decode(content) : content };
        });
    }

    /** Measures the word, also of large n: see `sikku measure --json`. Large integers are decimal strings. */
    measure(pattern: Pattern, values: Values = {}): Record<string, unknown> {
        return this.ask<Record<string, unknown>>({ do: "measure", pattern: this.split(null, pattern, values).request }).answer;
    }

    /** Examines the drawing as a kolam: see `sikku kolam --json`. */
    kolam(pattern: Pattern, values: Values = {}): Record<string, unknown> {
        return this.ask<Record<string, unknown>>({ do: "kolam", pattern: this.split(null, pattern, values).request }).answer;
    }

    /** All errors and warnings of a pattern and its variants; none if it is right. */
    check(pattern: Pattern): Diagnostic[] {
        return this.ask<{ diagnostics: Diagnostic[] }>({ do: "check", pattern: this.request(pattern) }).answer.diagnostics;
    }

    /** The derived word, or a map, as text. Throws SikkuError for more than 64 MB. */
    derive(pattern: Pattern, values: Values & { interpreted?: boolean } = {}): string {
        const { interpreted = false, ...others } = values;
        const { request } = this.split(null, pattern, others);
        const { answer, bytes } = this.ask<{ is_whole: boolean }>({ do: "derive", interpreted, pattern: request });
        if (!answer.is_whole) throw new SikkuError("budget", "the word has more than 64 MB", undefined, []);
        return new TextDecoder().decode(bytes).trimEnd();
    }

    /** Title, source, defines, keys, productions and cost of a pattern. */
    open(pattern: Pattern, values: Values = {}): Opened {
        return this.ask<Opened>({ do: "open", pattern: this.split(null, pattern, values).request }).answer;
    }

    private library(): Map<string, PatternInfo> {
        const list = () => this.ask<Patterns>({ do: "patterns" }).answer.patterns;
        return (this.bundled ??= new Map(list().map((one) => [one.name, one])));
    }

    private request(pattern: Pattern): PatternRequest {
        if (typeof pattern !== "string" && typeof pattern?.text !== "string") {
            throw new TypeError("the pattern must be the name of a bundled pattern, or { text }");
        }
        if (typeof pattern !== "string") return { name: pattern.name ?? "pattern.lsys", text: pattern.text };
        const found = this.library().get(pattern);
        if (!found) throw new SikkuError("other", `unknown pattern '${pattern}'; patterns() lists the bundled ones; pass { text } to use your own`, undefined, []);
        return { name: `${pattern}.lsys`, text: found.text };
    }

    /** The libraries separate the options of an output from keys and defines, and refuse unknown names. */
    private split(use: "draw" | "play" | null, pattern: Pattern, values: Values) {
        const request = this.request(pattern);
        const options: [string, string][] = [];
        const settings: [string, string][] = [];
        for (const [name, value] of Object.entries(values)) {
            if (value === undefined || value === null) continue;
            const option = name.replace(/[A-Z]/g, (letter) => `-${letter.toLowerCase()}`);
            const row = use ? this.known[use].get(option) : undefined;
            // Options such as `dots` have a default value, for which `true` stands.
            const has_default = row?.value.startsWith("[") ?? false;
            if (has_default && value === false) continue;
            const list = Array.isArray(value) ? value : [has_default && value === true ? "" : value];
            const texts = row?.is_list ? list.map(String) : [list.join(",")];
            if (name === "variant") request.variant = String(value);
            else if (name === "n") settings.push(["derivation length", String(value)]);
            else (use ? options : settings).push(...texts.map((text): [string, string] => [row ? option : name, text]));
        }
        return { request: { ...request, settings }, options };
    }

    private ask<Answer>(request: object): { answer: Answer; bytes: Uint8Array } {
        const { json, bytes } = this.bridge(JSON.stringify(request));
        const answer = JSON.parse(json) as Answer | Failure;
        if (answer && typeof answer === "object" && "error" in answer && answer.error) {
            const { kind, message, option, diagnostics } = (answer as Failure).error;
            throw new SikkuError(option ? "setting" : kind, message, option, diagnostics ?? []);
        }
        return { answer: answer as Answer, bytes };
    }
}

function only(outputs: Output[]): string | Uint8Array {
    if (outputs.length !== 1) {
        throw new SikkuError("other", `this output has ${outputs.length} files; outputs() returns them`, undefined, []);
    }
    return outputs[0]!.content;
}
