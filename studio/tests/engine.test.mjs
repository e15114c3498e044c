// Tests of the pool of workers, with stand-ins for workers.
import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";
import { load } from "./load.mjs";

globalThis.window = globalThis;
let workers = [];
let onStart = () => {};
globalThis.Worker = class {
    sent = [];
    isTerminated = false;
    constructor() {
        workers.push(this);
        onStart(this);
    }
    postMessage(message) {
        this.sent.push(message);
    }
    terminate() {
        this.isTerminated = true;
    }
    tell(data) {
        this.onmessage({ data });
    }
    get request() {
        return this.sent.findLast((message) => message.id);
    }
    answer(json, memory = 1000) {
        this.tell({ id: this.request.id, json, bytes: new Uint8Array(0), memory });
    }
};
const { Pool } = await load("engine");
const turn = () => new Promise((done) => setTimeout(done, 0));
const ask = { do: "patterns" };
function started(count) {
    const pool = new Pool("", count);
    pool.start({});
    return pool;
}

beforeEach(() => {
    workers = [];
    onStart = () => {};
});

test("requests and files wait until the libraries are there", async () => {
    const pool = new Pool("", 1);
    const scale = pool.request({ do: "scale", name: "x.scl" }, { bytes: new Uint8Array(1) });
    assert.deepEqual(workers[0].sent, []);
    const module = {};
    pool.start(module);
    assert.deepEqual(workers[0].sent[0], { module });
    assert.equal(workers[0].sent[1].id, 0);
    workers[0].answer({});
    assert.deepEqual((await scale).json, {});
});

test("if the libraries cannot be started, requests fail with the cause", async () => {
    const pool = new Pool("", 2);
    const waiting = pool.request(ask);
    pool.fail(new Error("damaged"));
    await assert.rejects(waiting, /do not start: damaged/);
    await assert.rejects(pool.request(ask), /do not start: damaged/);
});

test("a worker that does not start is replaced, and its request fails with the cause", async () => {
    const pool = started(2);
    const [first, second] = workers;
    const request = pool.request(ask);
    first.tell({ failed: "no memory for it" });
    await assert.rejects(request, /do not start: no memory for it/);
    assert.ok(first.isTerminated);
    assert.equal(workers.length, 3);
    second.tell({ ready: true });
    workers[2].tell({ ready: true });
    first.tell({ failed: "again" });
    assert.equal(workers.length, 3, "what a former worker says counts no more");
    const later = pool.request(ask);
    workers.find((each) => each.request && !each.isTerminated).answer({ patterns: [] });
    assert.deepEqual((await later).json, { patterns: [] });
});

test("if no worker starts, requests fail at once", async () => {
    onStart = (worker) => setTimeout(() => worker.tell({ failed: "no WebAssembly" }));
    const pool = started(3);
    const results = await Promise.allSettled(Array.from({ length: 8 }, () => pool.request(ask)));
    assert.ok(results.every(({ reason }) => /no WebAssembly/.test(reason.failure.message)));
    const count = workers.length;
    assert.ok(count <= 4, `${count} workers`);
    await assert.rejects(pool.request(ask), /no WebAssembly/);
    await assert.rejects(pool.request({ do: "scale", name: "x.scl" }, { bytes: new Uint8Array(1) }), /no WebAssembly/);
    assert.equal(workers.length, count);
});

test("an error before the start counts as a failed start", async () => {
    onStart = (worker) => setTimeout(() => worker.onerror({ message: "blocked", preventDefault() {} }));
    const pool = started(2);
    await assert.rejects(pool.request(ask), /blocked/);
    await turn();
    await turn();
    await assert.rejects(pool.request(ask), /blocked/);
});

test("workers that started go on without one that does not", async () => {
    const pool = started(2);
    const [one, two] = workers;
    two.tell({ failed: "first" });
    workers[2].tell({ failed: "second" });
    assert.equal(workers.length, 3);
    one.tell({ ready: true });
    const requests = [pool.request(ask), pool.request(ask, { lane: "back" })];
    one.answer({ at: 1 });
    one.answer({ at: 2 });
    assert.deepEqual((await Promise.all(requests)).map((each) => each.json.at), [1, 2]);
});

test("a worker without memory is renewed", async () => {
    const pool = started(1);
    const [worker] = workers;
    worker.tell({ ready: true });
    const request = pool.request(ask);
    worker.answer({ error: { kind: "other", message: "not enough memory" } });
    await assert.rejects(request, /not enough memory/);
    assert.ok(worker.isTerminated);
    assert.equal(workers.length, 2);
    const failing = pool.request(ask);
    workers[1].answer({ error: { kind: "other", message: "something else" } });
    await assert.rejects(failing, /something else/);
    assert.equal(workers.length, 2);
    const large = pool.request(ask);
    workers[1].answer({ patterns: [] }, 1e9);
    await large;
    assert.equal(workers.length, 3);
});

test("new workers know the scales, but not those with errors", async () => {
    const pool = started(1);
    const bytes = new Uint8Array(3);
    const good = pool.request({ do: "scale", name: "good.scl" }, { bytes });
    workers[0].answer({ name: "good.scl" });
    await good;
    const bad = pool.request({ do: "scale", name: "bad.scl" }, { bytes });
    workers[0].answer({ error: { kind: "pattern", message: "bad.scl:1:1" } }, 1e9);
    await assert.rejects(bad);
    await pool.request({ do: "scale", name: "x" }, { bytes, signal: AbortSignal.abort() }).catch(() => {});
    const request = pool.request(ask);
    workers[1].answer({ error: { kind: "other", message: "not enough memory" } });
    await assert.rejects(request);
    assert.deepEqual(workers[2].sent.filter(({ json }) => json).map(({ json }) => JSON.parse(json).name), ["good.scl"]);
});
