// The libraries in a pool of workers. Requests wait in two lanes. Of the requests with the same key, one runs at a time
// and only the last one waits, so that a moving slider gets its pictures in order and without a queue.
import type { Answer, Engine, RequestOptions } from "./context";
import { messageOf, RequestFailed } from "./context";
import { scriptAddress } from "./embedded";
import type { Failure, Request } from "./protocol";

export type ToWorker = { module: WebAssembly.Module } | { id: number; json: string; bytes?: Uint8Array };
export type FromWorker =
    | { ready: true }
    | { failed: string } // the module did not start
    | { id: number; json: unknown; bytes: Uint8Array; memory: number }
    | { id: number; broken: string };

const patience = 150; // milliseconds that a replaced request may keep running: starting a new worker takes as long
const most_workers = 4;
const most_starts = 2; // failures in a row, after which no further worker is started
const most_memory = 64 * 1024 * 1024; // bytes of a worker that is kept for further requests

interface Job {
    id: number;
    json: string;
    options: RequestOptions;
    seconds: number;
    started: number;
    isUnwanted: boolean; // aborted or replaced: its answer is not used
    resolve(answer: Answer<unknown>): void;
    reject(error: Error): void;
}

interface Seat {
    worker: Worker;
    job: Job | null;
    timer: number;
    isReady: boolean;
    isDead: boolean; // did not start, and is not started again
}

function aborted(): DOMException {
    return new DOMException("replaced by a later request", "AbortError");
}

function stopped(seconds: number): RequestFailed {
    return new RequestFailed({ kind: "stopped", message: `stopped after ${seconds} seconds` });
}

function isOutOfMemory({ error }: Partial<Failure>): boolean {
    return error?.kind === "other" && error.message === "not enough memory";
}

export class Pool implements Engine {
    private readonly seats: Seat[] = [];
    private readonly waiting: { front: Job[]; back: Job[] } = { front: [], back: [] };
    private readonly scales = new Map<string, { json: string; bytes: Uint8Array }>(); // files for every worker
    private last = 0;
    private failures = 0; // of starts, in a row
    private broken: RequestFailed | null = null; // why no worker starts
    private module: WebAssembly.Module | null = null; // requests wait until it is there

    constructor(
        private readonly address: string,
        readonly workers: number,
    ) {
        for (let index = 0; index < workers; ++index) this.seats.push(this.seat());
    }

    /// Passes the libraries to the workers, and begins the requests that wait.
    start(module: WebAssembly.Module): void {
        this.module = module;
        for (const seat of this.seats) this.begin(seat.worker, module);
        this.next();
    }

    /// The libraries cannot be started: all requests fail with this cause.
    fail(error: unknown): void {
        this.broken = new RequestFailed({ kind: "other", message: `the libraries do not start: ${messageOf(error)}` });
        this.drop(this.broken, () => true);
    }

    request<T>(request: Request, options: RequestOptions = {}): Promise<Answer<T>> {
        if (options.signal?.aborted) return Promise.reject(aborted());
        if (this.broken) return Promise.reject(this.broken);
        return new Promise<Answer<T>>((resolve, reject) => {
            const job: Job = {
                id: ++this.last,
                json: JSON.stringify(request),
                options,
                seconds: options.seconds ?? 20,
                started: 0,
                isUnwanted: false,
                resolve: resolve as (answer: Answer<unknown>) => void,
                reject,
            };
            options.signal?.addEventListener("abort", () => this.abort(job), { once: true });
            if (request.do === "scale" && options.bytes) this.share(request.name, job, options.bytes);
            const lane = this.waiting[options.lane ?? "front"];
            if (options.key !== undefined) this.replace(options.key);
            lane.push(job);
            this.next();
        });
    }

    // Rejects waiting requests.
    private drop(error: Error, isDropped: (job: Job) => boolean): void {
        for (const lane of [this.waiting.front, this.waiting.back]) {
            for (let index = lane.length; index-- > 0;) {
                if (isDropped(lane[index]!)) lane.splice(index, 1)[0]!.reject(error);
            }
        }
    }

    // A later request with this key has arrived.
    private replace(key: string): void {
        this.drop(aborted(), (job) => job.options.key === key);
        for (const seat of this.seats) if (seat.job?.options.key === key) this.hurry(seat);
    }

    private abort(job: Job): void {
        this.drop(aborted(), (each) => each === job);
        const seat = this.seats.find((each) => each.job === job);
        if (!seat) return;
        job.isUnwanted = true;
        job.reject(aborted());
        this.hurry(seat);
    }

    // Lets the request of the seat run for a moment, then replaces its worker.
    private hurry(seat: Seat): void {
        clearTimeout(seat.timer);
        const left = Math.max(0, patience - (performance.now() - seat.job!.started));
        seat.timer = window.setTimeout(() => this.stop(seat, aborted()), left);
    }

    private stop(seat: Seat, error: Error): void {
        clearTimeout(seat.timer);
        this.renew(seat);
        seat.job?.reject(error);
        this.next();
    }

    // WebAssembly never gives memory back: a new worker takes the place of one that a large request has filled.
    private renew(seat: Seat): void {
        seat.worker.terminate();
        this.seats[this.seats.indexOf(seat)] = this.seat();
    }

    // A worker did not start: its job learns why. Another takes its place, unless the one before failed, too.
    private bury(seat: Seat, cause: string): void {
        const message = `the libraries do not start: ${cause}`;
        if (++this.failures < most_starts) return this.stop(seat, new RequestFailed({ kind: "other", message }));
        clearTimeout(seat.timer);
        seat.worker.terminate();
        seat.isDead = true;
        const error = new RequestFailed({ kind: "other", message });
        seat.job?.reject(error);
        seat.job = null;
        if (this.seats.some((each) => !each.isDead)) return this.next();
        this.broken = error;
        this.drop(error, () => true);
    }

    // Idle seats for this lane: the front prefers the first, which has its pattern at hand; the back leaves one free.
    private idle(lane: "front" | "back"): Seat | undefined {
        const free = this.seats.filter((seat) => !seat.job && !seat.isDead);
        if (lane === "front") return free.find((seat) => seat.isReady) ?? free[0];
        const busy = this.seats.filter((seat) => seat.job?.options.lane === "back").length;
        return busy < this.workers - 1 && free.length > 0 ? free[free.length - 1] : undefined;
    }

    private next(): void {
        if (!this.module) return;
        for (const name of ["front", "back"] as const) {
            const lane = this.waiting[name];
            for (let index = 0; index < lane.length;) {
                const job = lane[index]!;
                const key = job.options.key;
                if (key !== undefined && this.seats.some((seat) => seat.job?.options.key === key)) {
                    ++index; // skip the running one
                    continue;
                }
                const seat = this.idle(name);
                if (!seat) break;
                lane.splice(index, 1);
                this.run(seat, job);
            }
        }
    }

    private run(seat: Seat, job: Job): void {
        seat.job = job;
        job.started = performance.now();
        seat.timer = window.setTimeout(() => this.stop(seat, stopped(job.seconds)), job.seconds * 1000);
        seat.worker.postMessage({ id: job.id, json: job.json, bytes: job.options.bytes } satisfies ToWorker);
    }

    private seat(): Seat {
        const worker = new Worker(this.address);
        const seat: Seat = { worker, job: null, timer: 0, isReady: false, isDead: false };
        worker.onmessage = (event: MessageEvent<FromWorker>) => this.receive(seat, event.data);
        worker.onerror = (event) => {
            event.preventDefault();
            if (!this.isSeated(seat)) return;
            if (!seat.isReady) this.bury(seat, event.message);
            else if (seat.job) this.stop(seat, new RequestFailed({ kind: "other", message: event.message }));
        };
        if (this.module) this.begin(worker, this.module);
        return seat;
    }

    private begin(worker: Worker, module: WebAssembly.Module): void {
        worker.postMessage({ module } satisfies ToWorker);
        for (const { json, bytes } of this.scales.values()) {
            worker.postMessage({ id: 0, json, bytes } satisfies ToWorker);
        }
    }

    // False for a worker that has been replaced.
    private isSeated(seat: Seat): boolean {
        return this.seats.includes(seat) && !seat.isDead;
    }

    // New workers learn the file, too, unless it has errors.
    private share(name: string, job: Job, bytes: Uint8Array): void {
        const { json, reject } = job;
        const before = this.scales.get(name);
        this.scales.set(name, { json, bytes });
        job.reject = (error) => {
            if (before) this.scales.set(name, before);
            else this.scales.delete(name);
            reject(error);
        };
        const message: ToWorker = { id: 0, json, bytes };
        if (!this.module) return; // they get it when they start
        for (const seat of this.seats) if (!seat.isDead) seat.worker.postMessage(message);
    }

    private receive(seat: Seat, message: FromWorker): void {
        if (!this.isSeated(seat)) return;
        if ("ready" in message) {
            seat.isReady = true;
            this.failures = 0;
            return;
        }
        if ("failed" in message) return this.bury(seat, message.failed);
        const job = seat.job;
        if (!job || job.id !== message.id) return;
        if ("broken" in message) {
            this.stop(seat, new RequestFailed({ kind: "other", message: message.broken }));
            return;
        }
        clearTimeout(seat.timer);
        seat.job = null;
        const failure = message.json as Partial<Failure>;
        if (message.memory > most_memory || isOutOfMemory(failure)) this.renew(seat);
        if (!job.isUnwanted) {
            if (failure.error) job.reject(new RequestFailed(failure.error));
            else job.resolve({ json: message.json, bytes: message.bytes });
        }
        this.next();
    }
}

/// Starts the workers of the page. They get the libraries from Pool.start().
export function startWorkers(): Pool {
    const workers = Math.max(2, Math.min(navigator.hardwareConcurrency || 2, most_workers));
    return new Pool(scriptAddress("sikku-worker"), workers);
}
