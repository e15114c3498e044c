// The requests that the page sends to the libraries, and their answers: bridge.cpp reads and writes this JSON.
// Numbers of any length are decimal strings.

/// A pattern with values that replace those in its text: keys and defines by name.
export interface PatternRequest {
    name: string; // in messages: `curve.lsys`
    text: string;
    variant?: string;
    settings?: [string, string][]; // [["derivation length", "4"], ["seed", "7"], ["angle", "80"]]
}

export type Options = [string, string][]; // names as in `help`; flags have the value "true"

/// Requests. All except `patterns`, `arrangements`, `help`, `show`, `import`, `link`, `dots`, `grid` and `read` concern a pattern.
export type Request =
    | { do: "patterns" }
    | { do: "texts" } // as bytes, separated by NUL
    | { do: "arrangements" }
    | { do: "help" }
    | { do: "open"; pattern: PatternRequest }
    | { do: "make"; interpreter: "draw" | "play"; format: string; options?: Options; pattern: PatternRequest }
    /// A picture as RGBA bytes. With `window` the drawing's rectangle [x0, y0, x1, y1], in turtle steps and y up, fills
    /// the picture; without it the page of `options` is shown, fitted into width x height.
    | { do: "pixels"; width: number; height: number; window?: [string, string, string, string];
        ratio?: number; // pixels of the picture per CSS pixel (1); strokes keep their width on the screen
        options?: Options; pattern: PatternRequest }
    /// The text of the word, or of a map, as bytes in UTF-8.
    | { do: "derive"; interpreted?: boolean; pattern: PatternRequest }
    | { do: "measure"; pattern: PatternRequest }
    | { do: "kolam"; pattern: PatternRequest }
    | { do: "check"; pattern: PatternRequest }
    /// A request of the language server protocol about a text: the answer of `sikku lsp`, as `result`.
    | { do: "editor"; method: string; parameters: EditorParameters }
    /// The largest derivation length that is drawn quickly, at most one less than the pattern's: see Affordable.
    | { do: "affordable"; seconds: number; pattern: PatternRequest }
    /// Of a pattern, or of an arrangement, whose patterns are bundled or in its text.
    | { do: "notes"; options?: Options; pattern: PatternRequest }
    | { do: "notes"; options?: Options; arrangement: ArrangementRequest }
    | { do: "make"; interpreter: "play"; format: string; options?: Options; arrangement: ArrangementRequest }
    /// The lines of a drawing in the plane: see Lines.
    | { do: "lines"; pattern: PatternRequest }
    /// The options of prints that the format, the drawing or other options exclude, or that have no effect.
    | { do: "unfit"; format: string; options?: Options; pattern: PatternRequest }
    /// Where the modules of the word come from; see Origin. `symbols` are positions in the word, counted from 1, decimal texts.
    | { do: "origins"; symbols: string[]; pattern: PatternRequest }
    | { do: "import"; name: string; view?: string } // with the file's bytes
    | { do: "show"; name: string } // with the file's bytes
    | { do: "scale"; name: string } // with the bytes of a .scl file: stored under that name, for the option `scale`
    /// A grid of dots in any notation that parse_dot_grid() reads; `add` and `remove` name places of dots, which the
    /// symmetry multiplies.
    | { do: "dots"; grid: string; symmetry?: SymmetryName; add?: [number, number][]; remove?: [number, number][] }
    /// A kolam on a grid, as a pattern: of the gaps given as digits, or by chance. `single_line` joins its lines into
    /// one; with a symmetry by looking for another kolam.
    | { do: "grid"; grid: string; gaps?: string; symmetry?: SymmetryName; density?: number; joined?: number; seed?: string;
        composed?: boolean; single_line?: boolean; coloured?: boolean; title?: string; rim?: RimName; centred?: boolean; strands?: boolean }
    /// The kolam of a photograph, whose bytes are RGBA pixels from the top: the kolam number `part` (1), or the one on
    /// this grid. `fixes` as in `sikku kolam --fix`. `source` names the file.
    | { do: "read"; width: number; height: number; source: string; part?: string; grid?: string; fixes?: string[] }
    /// Write a work as a link, and read one. `Shared` is the contents of a link.
    | { do: "link"; shared: Shared }
    | { do: "read_link"; link: string }
    /// The command line that makes the same output. `source` names the pattern in it: a file, a bundled pattern, or a
    /// link; without it, the pattern's name.
    | { do: "command"; interpreter: "draw" | "play"; format: string; options?: Options; pattern: PatternRequest;
        source?: string };

/// A position in a text: lines from 0, UTF-16 code units from 0.
export interface TextPlace { line: number; character: number }
export interface TextRange { start: TextPlace; end: TextPlace }
export interface TextEdit { range: TextRange; newText: string }
export interface Markdown { kind: "markdown"; value: string }
export interface EditorParameters {
    textDocument: { uri: string; text: string }; // uri: of the pattern file, or its name
    position?: TextPlace;
    newName?: string;
}
export interface CompletionItem { label: string; kind: number; textEdit: TextEdit; detail?: string; documentation?: Markdown }
/// The results of `textDocument/hover` and others.
export interface EditorMethods {
    hover: { contents: Markdown; range: TextRange } | null;
    completion: { isIncomplete: boolean; items: CompletionItem[] };
    definition: { uri: string; range: TextRange }[] | null;
    prepareRename: { range: TextRange; placeholder: string };
    rename: { changes: Record<string, TextEdit[]> }; // by uri
}

export interface Shared {
    pattern: PatternRequest;
    draw?: Options; // options of `sikku draw`, including the window
    play?: Options;
    page?: Record<string, string>; // values that only the studio uses
}

export interface Diagnostic {
    line: number; // 0: not in the text
    column: number; // code points, from 1
    message: string;
    warning: boolean;
    setting?: string; // the name of the invalid setting, if line is 0
}

/// Every answer. Bytes are returned separately.
export interface Failure {
    error: {
        kind: "pattern" | "setting" | "budget" | "word" | "score" | "stopped" | "request" | "other";
        message: string; // plain text, perhaps several lines
        option?: string; // of kind "setting", and of "pattern" if all errors are in settings
        diagnostics?: Diagnostic[]; // of kind "pattern"
    };
}

export interface PatternEntry { name: string; kind: string; title: string; source: string; text: string; is_melody: boolean; is_spatial: boolean }
export interface Patterns { patterns: PatternEntry[] }
/// An arrangement: several patterns played as one piece, as TOML.
export interface ArrangementRequest { name: string; text: string } // name: in messages: `canon.toml`
export interface ArrangementEntry extends ArrangementRequest { title: string; source: string; parts: number }
export interface Arrangements { arrangements: ArrangementEntry[] }

export interface KeyHelp {
    name: string; owner: "engine" | "art" | "music"; values: string; if_absent: string; help: string;
    scope: "words" | "maps" | "all"; names_file: boolean; // files: of some or all values
}
export interface SymbolHelp { symbol: string; help: string }
export interface OptionHelp {
    name: string; help: string; value: string; group: string; unit: string;
    kind: "text" | "number" | "whole" | "flag"; least: number; most: number;
    is_list: boolean; is_on: boolean; is_key: boolean; is_alone: boolean; letter: string;
    scope: string; // of engine/base/option.h
    sets_scale: boolean; names_file: boolean;
}
export interface FormatHelp { extension: string; label: string; alias: string; is_several: boolean; is_text: boolean }
export interface Help {
    version: string;
    sizes: Record<string, [width: number, height: number]>; // of sheets by name, upright, in millimetres: `a4`, `jisb4`
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
    defines: { name: string; value: string; line: number }[]; // in the text, with changed values
    keys: { name: string; value: string; line: number }[];
    productions: { line: number; column: number; length: number; predecessor: string; successor: string; table: string }[];
    warnings: Diagnostic[]; // and errors of the word, such as brackets that do not balance
    is_melody: boolean; // sets keys of melodies
    is_spatial: boolean; // draws in space: no windows; models instead
    is_map: boolean; // a map system: it has no word and no turtle
    is_random: boolean; // depends on the seed
    has_view: boolean; // a window of any depth costs only the visible part
    cost: {
        symbols: string; // "1365", or "about 10^24081"; empty if unknown before deriving, and for maps
        cells: string; // of a map; empty if it is too large to be derived at once
        edges: string;
        segments: string;
        is_derivable: boolean; // within the budget
        most: string; // the largest derivation length within the budget
    };
    /// Extent of the drawing in turtle steps: x0, y0, x1, y1; decimal strings of any length. Absent if unknown.
    extent?: [string, string, string, string];
}

export interface Derived { is_whole: boolean } // false: cut off after 64 MB
export interface Made { outputs: { name: string; size: number }[]; remarks: { is_warning: boolean; text: string }[] } // bytes: the outputs, one after the other
export interface Pixels { width: number; height: number; remarks: { is_warning: boolean; text: string }[] } // bytes: RGBA, straight alpha, from the top

/// Bytes: for each note 10 little-endian doubles: onset, duration (ticks), key, velocity, voice, from x, from y, to x,
/// to y, position in the word of the symbol that ends it (-1: unknown). Then for each note that slides to another pitch
/// at its end 3 doubles: its number from 0, ticks, semitones.
export interface Notes {
    count: number;
    glides?: number; // notes that slide; absent: none
    end: number; // ticks, including rests
    tempo: number; // quarter notes per minute
    beats: number; unit: number; // meter
    ticks: number; // ticks per quarter note
    parts: { name: string; scale: string; program: number; voices: number; drums: boolean }[];
    upbeat?: number; // ticks before the first bar line; absent or 0: none
    changes?: { onset: number; tempo: number; beats?: number; unit?: number }[]; // of tempo and meter after the beginning
}

/// Bytes: x and y of each point as doubles, in turtle steps; splines are given as control polygons.
export interface Lines { begins: number[] } // the first point of each line, then the number of points
export interface Unfit { options: string[] }

/// A place in the text; line 0: not in the text, but in a setting.
export interface Place { line: number; column: number; length: number }

/// The symbol of the text that a symbol of the word comes from, and its production; null: the axiom.
export type Origin = Place & { production: Place | null };
export interface Origins { origins: (Origin | null)[] } // null: unknown

export interface Imported { systems: { name: string; line: number; text: string; draws: boolean; losses: string[] }[]; diagnostics: Diagnostic[] }
export interface Shown { text: string; made: string } // made: the recipe, as in `sikku 0.2.0, -n 4 --size A3`
export type SymmetryName =
    | "none" | "C2" | "C3" | "C4" | "C6" | "mirror-x" | "mirror-y" | "diagonal" | "mirrors" | "diagonals"
    | "D3" | "D3-y" | "D4" | "D6";
export type RimName = "round" | "pointed" | "petal" | "horn" | "crescent";
export interface Dots {
    grid: string; // canonical notation
    lattice: "square" | "triangular";
    rows: number[]; // dots of each row from the top
    is_solid: boolean; // centred rows without holes
    dots: [number, number][]; // from the middle: half spacings to the right, half distances of rows upwards
    gaps: [from: number, to: number, side: number][]; // dots by index; side of `from`, anticlockwise from the right
    /// Symmetries of the grid, the largest first, `none` last. Gaps with the same orbit are images of each other.
    /// Obstacles are reasons why no single line has the symmetry, without and with joined gaps.
    symmetries: { name: SymmetryName; orbits: number[]; obstacle?: string; joined_obstacle?: string }[];
    /// Images of gaps and arcs under each of the grid's rotations and mirrors. Arc number sides * dot + s lies between the
    /// sides s and s + 1 of a dot.
    gap_images: number[][];
    arc_images: number[][];
    moved: [number, number]; // by editing: from the place of a dot before to its place now
}
export interface Grid {
    text: string; // of the pattern file
    grid: string; // canonical notation
    gaps: string; // a digit for each gap: 0 turned back, 1 crossed, 2 joined
    lines: number;
    changed: number; // by single_line
    shaped: number; // loops at the rim that are not round
    obstacle?: string; // the reason why no single line on this grid has this symmetry, or that none was found
    /// With `strands`: lines as closed polygons of points in the coordinates of Dots.
    strands?: [number, number][][];
    centred?: [number, number][]; // middles of the fields between four crossed gaps, in the same coordinates
    line_orbits?: number[]; // lines that the kolam's symmetries take to each other have the same number, and colour
}
/// With the bytes of the photograph seen from straight above, RGBA from the top.
export interface ReadPhotograph {
    text: string; // of the pattern file
    summary: string; // `9 dots, 12 of 12 gaps crossed, 3 lines, symmetry D4`
    grid: string; // canonical notation
    gaps: string; // as in Grid
    doubtful: number[]; // gaps by index
    repaired: number[]; // changed by symmetry, or by fixes
    notes: string[];
    open_ends: [number, number][]; // places beside the grid that lines lead to, in the coordinates of Dots
    missing: [number, number][]; // places that may have a dot that was not seen
    readable: number; // kolams in the photograph that can be read
    picture: { width: number; height: number; box: [x0: number, y0: number, x1: number, y1: number] }; // half spacings, y up
}
export interface Link { link: string } // the fragment, without `#`
export interface ReadLink {
    shared: Shared;
    withheld: [string, string][]; // options with commands for a plotter, which a link does not set
}
export interface Command { command: string }
export interface Examined { // with more members: see kolam_json()
    kolam: boolean; faults: string[]; lines: number; open_lines: number; symmetry: string; dots: unknown[];
    meetings: number; reused_edges: number;
}
export interface Affordable { n: string } // empty: none, or unknown
