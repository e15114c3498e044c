// A worker: one instance of the C++ libraries, which answers requests one after the other.
import start, { type Bridge } from "sikku-bridge";
import type { FromWorker, ToWorker } from "./engine";
import { makeZlib } from "./zlib";

let bridge: Promise<Bridge> | null = null;

function load(module: WebAssembly.Module): Promise<Bridge> {
    return start({
        zlib: makeZlib(),
        instantiateWasm(imports, done) {
            void WebAssembly.instantiate(module, imports).then((instance) => done(instance, module));
            return {};
        },
        print: () => {},
        printErr: () => {},
    });
}

function send(message: FromWorker, transfer: Transferable[] = []): void {
    (postMessage as (message: FromWorker, transfer: Transferable[]) => void)(message, transfer);
}

async function answer(message: ToWorker): Promise<void> {
    if ("module" in message) {
        bridge = load(message.module);
        await bridge;
        send({ ready: true });
        return;
    }
    try {
        const made = (await bridge!).request(message.json, message.bytes ?? new Uint8Array());
        const bytes = made.bytes.slice(); // out of the module's memory
        send({ id: message.id, json: JSON.parse(made.json), bytes }, [bytes.buffer]);
    } catch (error) {
        send({ id: message.id, broken: String(error) }); // out of memory, or a fault: the instance is not used again
    }
}

onmessage = (event: MessageEvent<ToWorker>) => void answer(event.data);
