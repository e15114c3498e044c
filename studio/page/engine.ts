// The libraries in a pool of workers. Requests wait in two lanes. Of the requests with the same key, one runs at a time
// and only the last one waits, so that a moving slider gets its pictures in order and without a queue.
import type { Answer, Engine, RequestOptions } from "./context";
import { RequestFailed } from "./context";
import { scriptAddress, unpack } from "./embedded";
import type { Failure, Request } from "./protocol";

export type ToWorker = { module: WebAssembly.Module } | { id: number; json: string; bytes?: Uint8Array };
export type FromWorker =
    | { ready: true }
    | { failed: string } // the module failed to start
    | { id: number; json: unknown; bytes: Uint8Array }
    | { id: number; broken: string };

const patience = 150; // milliseconds that a replaced request may keep running: starting a new worker takes as long
const most_workers = 4;

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
}

function aborted(): DOMException {
    return new DOMException("replaced by a later request", "AbortError");
}

function stopped(seconds: number): RequestFailed {
    return new RequestFailed({ kind: "stopped", message: `stopped after ${seconds} seconds` });
}

export class Pool implements Engine {
    private readonly seats: Seat[] = [];
    private readonly waiting: { front: Job[]; back: Job[] } = { front: [], back: [] };
    private readonly scales = new Map<string, { json: string; bytes: Uint8Array }>(); // files for every worker
    private last = 0;

    constructor(
        private readonly module: WebAssembly.Module,
        private readonly address: string,
        readonly workers: number,
    ) {
        for (let index = 0; index < workers; ++index) this.seats.push(this.seat());
    }

    request<T>(request: Request, options: RequestOptions = {}): Promise<Answer<T>> {
        if (options.signal?.aborted) return Promise.reject(aborted());
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
            if (request.do === "scale" && options.bytes) this.share(request.name, job.json, options.bytes);
            const lane = this.waiting[options.lane ?? "front"];
            if (options.key !== undefined) this.replace(options.key);
            lane.push(job);
            this.next();
        });
    }

    // A later request with this key has arrived.
    private replace(key: string): void {
        for (const lane of [this.waiting.front, this.waiting.back]) {
            for (let index = lane.length; index-- > 0;) {
                if (lane[index]!.options.key === key) lane.splice(index, 1)[0]!.reject(aborted());
            }
        }
        for (const seat of this.seats) if (seat.job?.options.key === key) this.hurry(seat);
    }

    private abort(job: Job): void {
        for (const lane of [this.waiting.front, this.waiting.back]) {
            const index = lane.indexOf(job);
            if (index >= 0) {
                lane.splice(index, 1);
                job.reject(aborted());
            }
        }
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
        seat.worker.terminate();
        const job = seat.job;
        this.seats[this.seats.indexOf(seat)] = this.seat();
        job?.reject(error);
        this.next();
    }

    // Idle seats for this lane: the front prefers the first, which has cached its pattern; the back leaves one free.
    private idle(lane: "front" | "back"): Seat | undefined {
        const free = this.seats.filter((seat) => !seat.job);
        if (lane === "front") return free.find((seat) => seat.isReady) ?? free[0];
        const busy = this.seats.filter((seat) => seat.job?.options.lane === "back").length;
        return busy < this.workers - 1 && free.length > 0 ? free[free.length - 1] : undefined;
    }

    private next(): void {
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
        const seat: Seat = { worker, job: null, timer: 0, isReady: false };
        worker.onmessage = (event: MessageEvent<FromWorker>) => this.receive(seat, event.data);
        worker.onerror = (event) => {
            event.preventDefault();
            if (seat.job) this.stop(seat, new RequestFailed({ kind: "other", message: event.message }));
        };
        worker.postMessage({ module: this.module } satisfies ToWorker);
        for (const { json, bytes } of this.scales.values()) {
            worker.postMessage({ id: 0, json, bytes } satisfies ToWorker);
        }
        return seat;
    }

    private share(name: string, json: string, bytes: Uint8Array): void {
        this.scales.set(name, { json, bytes });
        for (const seat of this.seats) seat.worker.postMessage({ id: 0, json, bytes } satisfies ToWorker);
    }

    private receive(seat: Seat, message: FromWorker): void {
        if ("ready" in message) {
            seat.isReady = true;
            return;
        }
        if ("failed" in message) {
            if (seat.job) this.stop(seat, new RequestFailed({ kind: "other", message: message.failed }));
            return;
        }
        const job = seat.job;
        if (!job || job.id !== message.id) return;
        if ("broken" in message) {
            this.stop(seat, new RequestFailed({ kind: "other", message: message.broken }));
            return;
        }
        clearTimeout(seat.timer);
        seat.job = null;
        if (!job.isUnwanted) {
            const failure = message.json as Partial<Failure>;
            if (failure.error) job.reject(new RequestFailed(failure.error));
            else job.resolve({ json: message.json, bytes: message.bytes });
        }
        this.next();
    }
}

/// Starts the libraries in the page.
export async function startEngine(): Promise<Engine> {
    const [module, address] = await Promise.all([
        unpack("sikku-libraries").then((bytes) => WebAssembly.compile(bytes)),
        scriptAddress("sikku-worker"),
    ]);
    const workers = Math.max(2, Math.min(navigator.hardwareConcurrency || 2, most_workers));
    return new Pool(module, address, workers);
}
