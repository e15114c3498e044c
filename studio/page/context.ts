// What the parts of the page share: the libraries, the work, and the panels that show it.
import type { Failure, Help, Opened, Options, PatternEntry, PatternRequest, Request } from "./protocol";

export interface Answer<T> { json: T; bytes: Uint8Array }

export class RequestFailed extends Error {
    constructor(readonly failure: Failure["error"]) { super(failure.message); }
}

export interface RequestOptions {
    bytes?: Uint8Array; // of a file
    /// A later request of the same key replaces this one while it waits, and stops it while it runs.
    key?: string;
    /// `front`: what the user waits for; `back`: thumbnails and tiles, which leave one worker free for `front`.
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

/// What the user makes. Immutable: changes replace it, and can be undone.
export interface Work {
    pattern: Required<PatternRequest>;
    draw: Options; // options of prints, without the window
    play: Options;
    /// What the map shows: centre in turtle steps (decimal texts of any length) and steps in a CSS pixel;
    /// null: the whole page.
    place: { x: string; y: string; scale: number } | null;
    panel: string; // the panel that is open: see Panel.name
    locked?: string[]; // settings and defines that dice and variations leave alone, such as `seed`
}

export interface Store {
    readonly work: Work;
    /// `merge`: changes with the same text that follow each other within a second are undone as one.
    change(change: Partial<Work>, merge?: string): void;
    setting(name: string, value: string | null, merge?: string): void; // of work.pattern.settings; null removes it
    undo(): void;
    redo(): void;
    subscribe(listener: (work: Work, before: Work) => void): () => void;
}

export interface Studio {
    readonly engine: Engine;
    readonly store: Store;
    readonly help: Help;
    readonly patterns: PatternEntry[];
    /// The facts of the last text without errors, and the work they belong to; null before the first.
    readonly opened: { facts: Opened; work: Work } | null;
    onOpened(listener: (facts: Opened, work: Work) => void): () => void;
    /// A line for screen readers and the status bar.
    say(text: string, kind?: "fact" | "warning" | "error"): void;
    /// Marks a part of the text in the editor, such as the production that sounds; null removes the mark.
    highlight(place: { line: number; column: number; length: number } | null): void;
    /// Offers a file for saving.
    save(name: string, bytes: Uint8Array, type: string): void;
}

/// A part of the page with a place in its layout. Built once; `show` and `hide` as its tab is chosen.
export interface Panel {
    name: string; // in links: `map`, `space`, `play`, `bench`, `variations`, `gallery`
    label: string;
    element: HTMLElement;
    show(): void;
    hide(): void;
}
export type MakePanel = (studio: Studio) => Panel;
