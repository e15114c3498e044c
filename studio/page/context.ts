// Interfaces shared by the parts of the page: the libraries, the work, and the panels that show it.
import type {
    ArrangementEntry, ArrangementRequest, Diagnostic, Failure, Help, Opened, Options, PatternEntry, PatternRequest,
    Place, Request,
} from "./protocol";

export interface Answer<T> { json: T; bytes: Uint8Array }

/// An error of the libraries; `message` is a sentence without the notation of terminals.
export class RequestFailed extends Error {
    constructor(readonly failure: Failure["error"]) { super(sentenceOf(failure)); }
}

/// The message of an error that was thrown, as the user sees it.
export function messageOf(error: unknown): string {
    return error instanceof Error ? error.message : String(error);
}

// Errors of patterns have places: "Line 6: a map has no turtle" instead of "curve.lsys:6:1: …" with the line below.
function sentenceOf({ message, diagnostics = [] }: Failure["error"]): string {
    const errors = diagnostics.filter((each) => !each.warning);
    const first = errors.find((each) => each.line > 0) ?? errors[0];
    if (!first) return message;
    const where = first.line > 0 ? `Line ${first.line}: ` : first.setting ? `${first.setting}: ` : "";
    return where + first.message + (errors.length > 1 ? ` (and ${errors.length - 1} more)` : "");
}

export interface RequestOptions {
    bytes?: Uint8Array; // of a file
    /// A later request with the same key replaces this one if it is waiting, and stops it if it is running.
    key?: string;
    /// `front`: requests that the user waits for; `back`: thumbnails and tiles, which leave a worker free for `front`.
    lane?: "front" | "back";
    seconds?: number; // the request is stopped after this time (20)
    signal?: AbortSignal;
}

/// The libraries in workers.
export interface Engine {
    /// Throws RequestFailed, and DOMException "AbortError" if it was replaced or aborted.
    request<T>(request: Request, options?: RequestOptions): Promise<Answer<T>>;
    readonly workers: number;
}

/// The user's work. Immutable: changes replace it and can be undone.
export interface Work {
    pattern: Required<PatternRequest>;
    draw: Options; // options of prints, without the window
    play: Options;
    /// View of the map: centre in turtle steps (decimal strings of any length) and turtle steps per CSS pixel;
    /// null: the whole page.
    place: { x: string; y: string; scale: number } | null;
    panel: string; // the panel that is open: see Panel.name
    arrangement?: ArrangementRequest | null; // played instead of the pattern
    locked?: string[]; // settings and defines that variations and random seeds must not change
}

export interface Store {
    readonly work: Work;
    /// `merge`: changes with the same label within a second of each other are undone together.
    change(change: Partial<Work>, merge?: string): void;
    setting(name: string, value: string | null, merge?: string): void; // of work.pattern.settings; null removes it
    undo(): void;
    redo(): void;
    subscribe(listener: (work: Work, before: Work) => void): () => void;
}

export type OpenedListener = (facts: Opened, work: Work) => void;
/// Called after each check of the text, with its error or null and all diagnostics.
export type CheckedListener = (error: Failure["error"] | null, diagnostics: Diagnostic[]) => void;

export interface Studio {
    readonly engine: Engine;
    readonly store: Store;
    readonly help: Help;
    readonly patterns: PatternEntry[];
    readonly arrangements: ArrangementEntry[];
    /// The facts of the last valid text and the work they belong to; null before the first.
    readonly opened: { facts: Opened; work: Work } | null;
    /// True if the present text has errors.
    readonly hasErrors: boolean;
    onOpened(listener: OpenedListener): () => void;
    onChecked(listener: CheckedListener): void;
    /// Shows a message in the status bar, which screen readers announce.
    say(text: string, kind?: "fact" | "warning" | "error"): void;
    /// Highlights a place in the editor, such as the production being played; null removes the highlight.
    highlight(place: Place | null): void;
    /// Saves a file as a download.
    save(name: string, bytes: Uint8Array, type: string): void;
}

/// A panel of the page. Built once; shown and hidden as its tab is selected.
export interface Panel {
    name: string; // in links: `map`, `gallery`, `bench`, `play`, `variations`, `steps`, `space`
    label: string;
    element: HTMLElement;
    show(): void;
    hide(): void;
}
export type MakePanel = (studio: Studio) => Panel;
