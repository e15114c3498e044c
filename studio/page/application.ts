// The studio as its panels use it: the libraries, the work, and the facts of the last valid text.
import { RequestFailed, type CheckedListener, type Engine, type OpenedListener, type Studio, type Work } from "./context";
import { byId, element } from "./elements";
import type { ArrangementEntry, Help, Opened, PatternEntry, Place } from "./protocol";
import type { History } from "./store";
import { isAnother } from "./versions";

const patience = 400; // milliseconds until the status bar shows that the libraries are working
const fact_seconds = 12; // how long a message stays in the status bar

export class Application implements Studio {
    help!: Help; // set before the first panel is made
    patterns: PatternEntry[] = []; // set before all panels but that of the picture
    arrangements: ArrangementEntry[] = [];
    opened: { facts: Opened; work: Work } | null = null;

    private saying = 0;
    private waiting = 0;
    private readonly listeners = new Set<OpenedListener>();
    private readonly failed = new Set<CheckedListener>();
    private readonly marked = new Set<(place: Place | null) => void>();

    constructor(
        readonly engine: Engine,
        readonly store: History,
    ) {
        store.subscribe((work, before) => {
            if (work.pattern === before.pattern) return;
            if (isAnother(work.pattern, before.pattern)) this.forget();
            void this.open();
        });
    }

    /// True while the text has errors: the facts are those of an earlier text.
    hasErrors = false;

    // Messages about the previous pattern do not apply to another one.
    private forget(): void {
        this.say("");
        byId("facts").textContent = "";
        byId("values").classList.add("stale");
    }

    onOpened(listener: OpenedListener): () => void {
        this.listeners.add(listener);
        return () => this.listeners.delete(listener);
    }

    onChecked(listener: CheckedListener): void {
        this.failed.add(listener);
    }

    onHighlight(listener: (place: Place | null) => void): void {
        this.marked.add(listener);
    }

    /// Reads the pattern of the work; the panels redraw it if it has no errors.
    async open(): Promise<void> {
        const { work } = this.store;
        clearTimeout(this.waiting);
        this.waiting = window.setTimeout(() => { byId("facts").textContent = "Working…"; }, patience);
        try {
            const { json } = await this.engine.request<Opened>({ do: "open", pattern: work.pattern }, { key: "open" });
            if (work.pattern === this.store.work.pattern) clearTimeout(this.waiting);
            this.opened = { facts: json, work };
            this.hasErrors = false;
            for (const listener of this.failed) listener(null, json.warnings);
            for (const listener of this.listeners) listener(json, work);
        } catch (error) {
            if (!(error instanceof RequestFailed)) return; // superseded by a later text
            clearTimeout(this.waiting);
            this.hasErrors = true;
            for (const listener of this.failed) listener(error.failure, error.failure.diagnostics ?? []);
        }
    }

    say(text: string, kind: "fact" | "warning" | "error" = "fact"): void {
        const message = byId("message");
        message.dataset["kind"] = kind;
        message.dataset["source"] = "";
        message.textContent = message.title = text;
        clearTimeout(this.saying);
        if (kind === "fact") this.saying = window.setTimeout(() => { message.textContent = ""; }, fact_seconds * 1000);
    }

    highlight(place: Place | null): void {
        for (const listener of this.marked) listener(place);
    }

    save(name: string, bytes: Uint8Array, type: string): void {
        const address = URL.createObjectURL(new Blob([bytes as BlobPart], { type }));
        const link = element("a", { href: address, download: name, hidden: true });
        document.body.append(link);
        link.click();
        link.remove();
        setTimeout(() => URL.revokeObjectURL(address), 60_000);
    }
}
