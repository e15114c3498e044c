// The user's work and its history, stored in the browser so that a reload loses nothing.
import type { Store, Work } from "./context";
import { withOption } from "./options";
import { remember, work_key } from "./storage";
import { isAnother, renamed } from "./versions";

const most_steps = 100;
const merge_milliseconds = 1000;
const most_saved = 4_000_000; // characters; browsers keep about five million
const most_tried = 3 * most_saved; // characters of a single step

/// A state that undo returns to.
export interface Step {
    work: Work;
    label: string; // what changed
    time: number;
    picture?: string; // a thumbnail, as a data address
}

interface Saved {
    steps: Step[];
    at: number;
}

type Listener = (work: Work, before: Work) => void;

export class History implements Store {
    private steps: Step[];
    private at: number;
    private merging = "";
    private merged = 0; // time of the last change of `merging`
    private timer = 0;
    private readonly listeners = new Set<Listener>();
    private readonly watchers = new Set<() => void>();
    private isSaved = true; // as far as we know
    private warn = () => {};

    /// @param keeps  false: nothing is read from the browser's storage, nor written to it
    constructor(
        first: Work,
        private readonly keeps = true,
    ) {
        const saved = keeps ? read() : null;
        this.steps = saved?.steps ?? [{ work: first, label: "Start", time: Date.now() }];
        this.at = saved?.at ?? 0;
        this.wasSaved = saved !== null;
        addEventListener("pagehide", () => this.save());
        document.addEventListener("visibilitychange", () => {
            if (document.hidden) this.save();
        });
    }

    readonly wasSaved: boolean; // by an earlier visit

    get work(): Work {
        return this.steps[this.at]!.work;
    }
    get history(): readonly Step[] {
        return this.steps;
    }
    get position(): number {
        return this.at;
    }

    change(change: Partial<Work>, merge = ""): void {
        const before = this.work;
        const work = { ...before, ...change };
        if (work.pattern !== before.pattern) work.pattern = renamed(work.pattern, before.pattern);
        if (isSame(work, before)) return;
        if (!change.pattern && !change.draw && !change.play && change.arrangement === undefined) {
            // changes of the view are not steps of the history
            this.steps[this.at]!.work = work;
            this.tell(before);
            return;
        }
        const now = Date.now();
        const continues = merge !== "" && merge === this.merging && now - this.merged < merge_milliseconds;
        this.merging = merge;
        this.merged = now;
        if (continues && this.at === this.steps.length - 1 && this.at > 0) {
            this.steps[this.at] = { work, label: describe(before, work), time: now };
        } else {
            this.steps.splice(this.at + 1);
            this.steps.push({ work, label: describe(before, work), time: now });
            if (this.steps.length > most_steps + 1) this.steps.shift();
            this.at = this.steps.length - 1;
        }
        this.tell(before);
    }

    setting(name: string, value: string | null, merge?: string): void {
        const { pattern } = this.work;
        this.change({ pattern: { ...pattern, settings: withOption(pattern.settings, name, value) } }, merge);
    }

    undo(): void {
        this.go(this.at - 1);
    }
    redo(): void {
        this.go(this.at + 1);
    }

    /// Returns to a step of the history.
    go(position: number): void {
        if (position < 0 || position >= this.steps.length || position === this.at) return;
        const before = this.work;
        this.merging = "";
        this.at = position;
        const to = this.work;
        const place = isAnotherView(before, to) ? to.place : before.place;
        this.steps[position]!.work = { ...to, place, panel: before.panel };
        this.tell(before);
    }

    /// Sets the thumbnail of a step, once it is drawn.
    picture(work: Work, address: string): void {
        const step = this.steps.find((each) => each.work === work || each.work.pattern === work.pattern);
        if (!step) return;
        step.picture = address;
        for (const watcher of this.watchers) watcher();
        this.saveSoon();
    }

    subscribe(listener: Listener): () => void {
        this.listeners.add(listener);
        return () => this.listeners.delete(listener);
    }

    /// Called after every change of the history, including thumbnails.
    watch(watcher: () => void): () => void {
        this.watchers.add(watcher);
        return () => this.watchers.delete(watcher);
    }

    /// Called when the work does not fit the browser's storage; again only after it did fit.
    onUnsaved(warn: () => void): void {
        this.warn = warn;
    }

    private tell(before: Work): void {
        for (const listener of this.listeners) listener(this.work, before);
        for (const watcher of this.watchers) watcher();
        this.saveSoon();
    }

    private saveSoon(): void {
        // Further changes do not put it off.
        if (this.timer === 0) this.timer = window.setTimeout(() => this.save(), 400);
    }

    // The storage is small: if all does not fit, the newest steps are kept, and steps rather than their thumbnails.
    private save(): void {
        clearTimeout(this.timer);
        this.timer = 0;
        if (!this.keeps) return;
        const isSaved = this.attempts().some(store);
        if (!isSaved && this.isSaved) this.warn();
        this.isSaved = isSaved;
    }

    private attempts(): Saved[] {
        const { steps, at } = this;
        const newest = (count: number): Saved => {
            const from = Math.max(0, Math.min(at, steps.length - count));
            return { steps: steps.slice(from, from + count), at: Math.min(at - from, count - 1) };
        };
        let room = most_saved;
        let kept = 0;
        while (kept < steps.length && (room -= sizeOf(steps[steps.length - 1 - kept]!)) >= 0) ++kept;
        const all = newest(Math.max(1, kept));
        const attempts = [withPictures(all, most_saved), withPictures(all, 0)];
        for (kept >>= 1; kept > 0; kept >>= 1) attempts.push(withPictures(newest(kept), 0));
        return attempts;
    }
}

function store(saved: Saved): boolean {
    return (saved.steps.length > 1 || sizeOf(saved.steps[0]!) <= most_tried) && remember(work_key, saved);
}

function sizeOf(step: Step): number {
    return step.work.pattern.text.length + (step.work.arrangement?.text.length ?? 0) + 1000;
}

// The thumbnails that fit beside the steps, those of the newest first.
function withPictures({ steps, at }: Saved, most: number): Saved {
    let room = most;
    for (const step of steps) room -= sizeOf(step);
    const kept = steps.toReversed().map((step): Step => {
        room -= step.picture?.length ?? 0;
        if (room >= 0) return step;
        const { picture: _, ...rest } = step;
        return rest;
    });
    return { steps: kept.reverse(), at };
}

// Between versions of a pattern one looks at the same place; another pattern has its own, and so has a step that moved
// the view and did nothing else.
function isAnotherView(one: Work, other: Work): boolean {
    return isAnother(one.pattern, other.pattern) || isSame({ ...one, place: other.place, panel: other.panel }, other);
}

// Compares long texts directly, without JSON.
function isSame(one: Work, other: Work): boolean {
    const [a, b] = [one.pattern, other.pattern];
    const rest = (work: Work) =>
        JSON.stringify([
            work.pattern.settings, work.draw, work.play, work.place, work.panel, work.locked, work.arrangement?.text,
        ]);
    return a.text === b.text && a.name === b.name && a.variant === b.variant && rest(one) === rest(other);
}

function isWork(work: Work): boolean {
    const { name, text, variant, settings } = work.pattern;
    const played = work.arrangement ? [work.arrangement.name, work.arrangement.text] : [];
    const texts = [name, text, variant, work.panel, ...played].every((each) => typeof each === "string");
    return texts && [settings, work.draw, work.play].every(Array.isArray);
}

/// Sets the saved work aside, for a page that cannot start with it.
export function putAside(): void {
    try {
        const saved = localStorage.getItem(work_key) ?? "";
        localStorage.removeItem(work_key);
        localStorage.setItem(`${work_key}-aside`, saved);
    } catch {
        // a copy is good to have, a page that starts is better; a browser may have no storage at all
    }
}

function read(): Saved | null {
    try {
        const saved = JSON.parse(localStorage.getItem(work_key) ?? "null") as Saved | null;
        return saved?.steps[saved.at] && saved.steps.every((step) => isWork(step.work)) ? saved : null;
    } catch {
        return null;
    }
}

// Describes the difference between two states in a few words.
function describe(before: Work, after: Work): string {
    if (after.arrangement && before.arrangement?.text !== after.arrangement.text) {
        return after.arrangement.name.replace(/\.toml$/i, "");
    }
    if (before.pattern.name !== after.pattern.name && isAnother(before.pattern, after.pattern)) {
        return after.pattern.name.replace(/\.lsys$/, "");
    }
    if (before.pattern.text !== after.pattern.text) return "Text";
    if (before.pattern.variant !== after.pattern.variant) return `Variant ${after.pattern.variant || "none"}`;
    const old = new Map(before.pattern.settings);
    const now = new Map(after.pattern.settings);
    const changed = [...new Set([...old.keys(), ...now.keys()])].filter((name) => old.get(name) !== now.get(name));
    if (changed.length === 1) {
        const name = changed[0]!;
        return `${name === "derivation length" ? "n" : name} ${now.get(name) ?? "reset"}`;
    }
    if (changed.length > 1) return `${changed.length} values`;
    return JSON.stringify(before.draw) !== JSON.stringify(after.draw) ? "Print options" : "Score options";
}
