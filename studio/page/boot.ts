// The only script that is not compressed in the page: it shows the first picture and unpacks the others. The libraries are
// unpacked by a worker that runs this script, too.
import { dataOf, scriptAddress, unpackText } from "./embedded";
import { hasSavedWork } from "./storage";
import { troubleOf } from "./trouble";

declare global {
    /// The libraries, once they are unpacked.
    var sikkuLibraries: Promise<ArrayBuffer>; // `let` would not be global
}

const own_text = typeof document === "undefined" ? "" : document.currentScript!.textContent!;

type Unpacked = ArrayBuffer | { failed: string };

function serve(): void {
    const send = postMessage as (message: Unpacked, transfer?: Transferable[]) => void;
    onmessage = ({ data }: MessageEvent<string>) => {
        try {
            const { buffer } = unpackText(data);
            send(buffer, [buffer]);
        } catch (error) {
            send({ failed: String(error) });
        }
    };
}

function unpackLibraries(): Promise<ArrayBuffer> {
    return new Promise((resolve, reject) => {
        const address = URL.createObjectURL(new Blob([own_text], { type: "text/javascript" }));
        const worker = new Worker(address);
        const finish = () => {
            worker.terminate();
            URL.revokeObjectURL(address);
        };
        worker.onmessage = ({ data }: MessageEvent<Unpacked>) => {
            finish();
            if (data instanceof ArrayBuffer) resolve(data);
            else reject(new Error(`the libraries cannot be unpacked: ${data.failed}`));
        };
        worker.onerror = ({ message }) => {
            finish();
            reject(new Error(`the worker does not start: ${message ?? "it is blocked"}`));
        };
        worker.postMessage(dataOf("sikku-libraries"));
    });
}

// Shows the picture of the first pattern to visitors who come for the first time, until the libraries have drawn it.
function showDraft(): void {
    if (hasSavedWork() || location.hash.length > 1 || dataOf("sikku-patterns") !== "[]") return;
    const text = new TextDecoder().decode(unpackText(dataOf("sikku-draft")));
    const draft = document.createElement("div");
    draft.id = draft.className = "draft";
    draft.append(new DOMParser().parseFromString(text, "image/svg+xml").documentElement);
    document.getElementById("panels")!.replaceChildren(draft);
}

function fail(error: unknown): void {
    const { sentence } = troubleOf(error);
    const note = document.createElement("p");
    note.className = "empty";
    document.getElementById("message")!.textContent = note.textContent = sentence;
    document.getElementById("panels")!.replaceChildren(note);
}

function begin(): void {
    globalThis.sikkuLibraries = unpackLibraries();
    globalThis.sikkuLibraries.catch(() => {}); // the script reports it
    const script = document.createElement("script");
    script.src = scriptAddress("sikku-script");
    script.onerror = () => fail(new Error("the browser does not run the page's script"));
    document.body.append(script);
}

if (own_text === "") {
    serve();
} else {
    addEventListener("DOMContentLoaded", () => {
        try {
            begin();
        } catch (error) {
            fail(error);
        }
    });
    showDraft();
}
