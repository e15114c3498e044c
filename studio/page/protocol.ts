// The requests that the page sends to the libraries, and their answers: bridge.cpp reads and writes this JSON.
// Numbers that may have any number of digits are decimal texts.

/// A pattern with the values that replace those of its text; keys and defines by name.
export interface PatternRequest {
    name: string; // in messages: `curve.lsys`
    text: string;
    variant?: string;
    settings?: [string, string][]; // [["derivation length", "4"], ["seed", "7"], ["angle", "80"]]
}

export type Options = [string, string][]; // names as in `help`; flags have the value "true"

/// What a request asks for. All but `patterns`, `help`, `show`, `import`, `link` and `grid` concern a pattern.
export type Request =
    | { do: "patterns" }
    | { do: "help" }
    | { do: "open"; pattern: PatternRequest }
    | { do: "make"; interpreter: "draw" | "play"; format: string; options?: Options; pattern: PatternRequest }
    /// A picture as RGBA bytes. With `window` the drawing's rectangle [x0, y0, x1, y1], in turtle steps and y up, fills
    /// the picture; without it the page of `options` is shown, fitted into width x height.
    | { do: "pixels"; width: number; height: number; window?: [string, string, string, string];
        ratio?: number; // pixels of the picture in a CSS pixel (1): strokes keep their width on the screen
        options?: Options; pattern: PatternRequest }
    | { do: "measure"; pattern: PatternRequest }
    | { do: "kolam"; pattern: PatternRequest }
    | { do: "check"; pattern: PatternRequest }
    | { do: "notes"; options?: Options; pattern: PatternRequest }
    /// Where the modules of the word come from; see Origin. `symbols` are positions in the word, counted from 1, decimal texts.
    | { do: "origins"; symbols: string[]; pattern: PatternRequest }
    | { do: "import"; name: string; view?: string } // with the file's bytes
    | { do: "show"; name: string } // with the file's bytes
    | { do: "scale"; name: string } // with the bytes of a .scl file: kept under that name, for the option `scale`
    | { do: "grid"; grid: string; crossings?: string; symmetry?: string; density?: number; seed?: string;
        single_line?: boolean; coloured?: boolean; title?: string }
    /// A work as a link, and back. What a link holds is in `Shared`.
    | { do: "link"; shared: Shared }
    | { do: "read_link"; link: string }
    /// The command line that makes the same output.
    | { do: "command"; interpreter: "draw" | "play"; format: string; options?: Options; pattern: PatternRequest };

export interface Shared {
    pattern: PatternRequest;
    draw?: Options; // options of `sikku draw`, the window included
    play?: Options;
    page?: Record<string, string>; // what only the studio knows
}

export interface Diagnostic {
    line: number; // 0: no place in the text
    column: number; // code points, from 1
    message: string;
    warning: boolean;
    setting?: string; // the name of the setting that is wrong, if line is 0
}

/// Every answer. Bytes come beside it.
export interface Failure {
    error: {
        kind: "pattern" | "setting" | "budget" | "word" | "score" | "stopped" | "request" | "other";
        message: string; // plain text, perhaps several lines
        option?: string; // of kind "setting"
        diagnostics?: Diagnostic[]; // of kind "pattern"
    };
}

export interface PatternEntry { name: string; kind: string; title: string; source: string; text: string; is_melody: boolean; is_spatial: boolean }
export interface Patterns { patterns: PatternEntry[] }

export interface KeyHelp { name: string; owner: "engine" | "art" | "music"; values: string; if_absent: string; help: string }
export interface SymbolHelp { symbol: string; help: string }
export interface OptionHelp {
    name: string; help: string; value: string; group: string; unit: string;
    kind: "text" | "number" | "whole" | "flag"; least: number; most: number;
    is_list: boolean; is_on: boolean; is_key: boolean; is_alone: boolean; letter: string;
}
export interface FormatHelp { extension: string; label: string; alias: string; is_several: boolean; is_text: boolean }
export interface Help {
    version: string;
    keys: KeyHelp[];
    symbols: SymbolHelp[];
    draw: { options: OptionHelp[]; formats: FormatHelp[] };
    play: { options: OptionHelp[]; formats: FormatHelp[] };
}

export interface Opened {
    title: string;
    source: string;
    n: string; // derivation length
    seed: string;
    variants: string[];
    defines: { name: string; value: string; line: number }[]; // of the text, overrides applied
    keys: { name: string; value: string; line: number }[];
    productions: { line: number; column: number; length: number; predecessor: string; successor: string; table: string }[];
    warnings: Diagnostic[];
    is_melody: boolean; // sets keys of melodies
    is_spatial: boolean; // draws in space: no windows; models instead
    is_random: boolean; // depends on the seed
    has_view: boolean; // a window of any depth costs only what is seen
    cost: {
        symbols: string; // "1365", or "about 10^24081"; empty if only deriving tells
        segments: string;
        is_derivable: boolean; // within the budget
        most: string; // the largest derivation length within the budget
    };
    /// Of what is drawn, in turtle steps: x0, y0, x1, y1; decimal texts of any length. Absent where it is unknown.
    extent?: [string, string, string, string];
}

export interface Made { outputs: { name: string; size: number }[]; remarks: { is_warning: boolean; text: string }[] } // bytes: the outputs, one after the other
export interface Pixels { width: number; height: number; remarks: { is_warning: boolean; text: string }[] } // bytes: RGBA, straight alpha, from the top

/// Bytes: for each note 10 little-endian doubles: onset, duration (ticks), key, velocity, voice, from x, from y, to x,
/// to y, position in the word of the symbol that ends it (-1: unknown).
export interface Notes {
    count: number;
    end: number; // ticks, rests included
    tempo: number; // quarters a minute
    beats: number; unit: number; // meter
    ticks: number; // ticks of a quarter
    parts: { name: string; scale: string; program: number; voices: number }[];
}

/// A place of the text; line 0: none, as the text of a setting.
export interface Place { line: number; column: number; length: number }

/// The symbol of the text that a symbol of the word comes from, and its production; null: the axiom.
export type Origin = Place & { production: Place | null };
export interface Origins { origins: (Origin | null)[] } // null: unknown

export interface Imported { systems: { name: string; line: number; text: string; losses: string[] }[]; diagnostics: Diagnostic[] }
export interface Shown { text: string; made: string } // made: the recipe, as in `sikku 0.1.0, -n 4 --size A3`
export interface Grid {
    text: string; // of the pattern file
    rows: number[];
    dots: [number, number][]; // twice the distance from the middle, y up
    gaps: { from: number; to: number; is_crossed: boolean; orbit: number }[]; // dots by index
    crossings: string; // a digit for each gap
    lines: number;
    changed: number; // by single_line
    obstacle?: string; // why no single line on this grid has this symmetry
    /// Lines as closed polygons of points in the coordinates of `dots`.
    strands: [number, number][][];
}
export interface Link { link: string } // the fragment, without `#`
export interface ReadLink { shared: Shared }
export interface Command { command: string }
