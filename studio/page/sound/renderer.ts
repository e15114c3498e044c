// Renders notes to audio buffers in a worker, before they are played.
import source from "worker:./render_worker.ts";
import { Recent } from "../recent";
import type { Rendered, RenderRequest } from "./render_worker";
import type { Timbre } from "./timbres";
import { renderedKey } from "./timbres";

export interface Voiced {
    buffer: AudioBuffer;
    frequency: number;
    loops: boolean;
    bytes: number;
    close(): void;
}

const most_bytes = 48 * 1024 * 1024;

export class Renderer {
    private readonly worker: Worker;
    private readonly ready = new Recent<Voiced>(most_bytes);
    private readonly waiting = new Map<string, (() => void)[]>();

    constructor(private readonly context: BaseAudioContext) {
        this.worker = new Worker(URL.createObjectURL(new Blob([source], { type: "text/javascript" })));
        this.worker.onmessage = (event: MessageEvent<Rendered>) => this.receive(event.data);
    }

    private name(timbre: string, key: number): string {
        return `${timbre} ${key}`;
    }

    /// The buffer for a key, if it is ready; otherwise requests it.
    find(timbre: Timbre, key: number): Voiced | null {
        const found = this.ready.get(this.name(timbre.name, renderedKey(timbre, key)));
        if (found) return found;
        this.ask(timbre, key);
        return this.nearest(timbre, key);
    }

    /// A substitute until the buffer is ready.
    private nearest(timbre: Timbre, key: number): Voiced | null {
        const whole = renderedKey(timbre, key);
        if (timbre.everyKey) return null;
        for (let away = 1; away <= 12; ++away) {
            const found =
                this.ready.get(this.name(timbre.name, whole + away))
                ?? this.ready.get(this.name(timbre.name, whole - away));
            if (found) return found;
        }
        return null;
    }

    private ask(timbre: Timbre, key: number, done?: () => void): void {
        const whole = renderedKey(timbre, key);
        const name = this.name(timbre.name, whole);
        const listeners = this.waiting.get(name);
        if (listeners) {
            if (done) listeners.push(done);
            return;
        }
        this.waiting.set(name, done ? [done] : []);
        const { sampleRate: rate } = this.context;
        this.worker.postMessage({ timbre: timbre.name, key: whole, rate } satisfies RenderRequest);
    }

    /// Renders all of these, each once.
    prepare(wanted: Iterable<readonly [Timbre, number]>): Promise<void> {
        const seen = new Set<string>();
        const all: Promise<void>[] = [];
        for (const [timbre, key] of wanted) {
            const name = this.name(timbre.name, renderedKey(timbre, key));
            if (seen.has(name) || this.ready.has(name)) continue;
            seen.add(name);
            all.push(new Promise((done) => this.ask(timbre, key, done)));
        }
        return Promise.all(all).then(() => {});
    }

    private receive(made: Rendered): void {
        const name = this.name(made.timbre, made.key);
        const buffer = this.context.createBuffer(1, Math.max(1, made.data.length), made.rate);
        buffer.copyToChannel(made.data, 0);
        const { frequency, loops } = made;
        this.ready.add(name, { buffer, frequency, loops, bytes: 4 * made.data.length, close: () => {} });
        const listeners = this.waiting.get(name) ?? [];
        this.waiting.delete(name);
        for (const done of listeners) done();
    }

    close(): void {
        this.worker.terminate();
    }
}
