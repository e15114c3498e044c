// A worker: one instance of the C++ libraries, which answers requests one after the other.
import makeModule from "sikku-bridge";
import { type Bridge, hooksOf, startBridge } from "../npm/bridge";
import type { FromWorker, ToWorker } from "./engine";

let bridge: Promise<Bridge> | null = null;

function start(module: WebAssembly.Module): Promise<Bridge> {
    return startBridge(makeModule, hooksOf(module, (error) => send({ failed: String(error) })));
}

function send(message: FromWorker, transfer: Transferable[] = []): void {
    (postMessage as (message: FromWorker, transfer: Transferable[]) => void)(message, transfer);
}

async function answer(message: ToWorker): Promise<void> {
    if ("module" in message) {
        bridge = start(message.module);
        try {
            await bridge;
            send({ ready: true });
        } catch (error) {
            send({ failed: String(error) });
        }
        return;
    }
    try {
        const made = (await bridge!)(message.json, message.bytes);
        const { bytes, memory } = made;
        send({ id: message.id, json: JSON.parse(made.json), bytes, memory }, [bytes.buffer as ArrayBuffer]);
    } catch (error) {
        send({ id: message.id, broken: String(error) }); // out of memory, or a crash: the instance is not used again
    }
}

onmessageerror = () => send({ failed: "this browser cannot send a WebAssembly module to a worker" });
onmessage = (event: MessageEvent<ToWorker>) => void answer(event.data);
