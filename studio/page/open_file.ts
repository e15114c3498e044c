// Files from outside: patterns, arrangements, collections of Fractint, files of cpfg, scales and key maps, and prints that contain
// their pattern.
import { isArrangement, openArrangement } from "./arrangements";
import { isPicture, readPhotograph } from "./bench/photograph";
import { messageOf, RequestFailed, type Studio } from "./context";
import { openDialog } from "./dialog";
import { button, byId, element } from "./elements";
import { bytes as sizeOf } from "./numbers_shown";
import { openPattern } from "./opening";
import type { Imported, PatternRequest, Shown } from "./protocol";
import { keepScale } from "./scales";
import { shellWords } from "./shell_words";

const largest_file = 64 * 1024 * 1024;

/// The losses of an import, and a remark if the pattern draws nothing.
function lossesOf(system: Imported["systems"][number]): string {
    return system.losses.join("; ") + (system.draws ? "" : ". Nothing is left that draws.");
}

/// Lets the user choose a file.
export function askForFile(studio: Studio): void {
    const input = element("input", { type: "file", hidden: true });
    input.addEventListener("change", () => {
        if (input.files?.[0]) void openFile(studio, input.files[0], [...input.files]);
    });
    document.body.append(input);
    input.click();
    input.remove();
}

async function openFile(studio: Studio, file: File, all: File[]): Promise<void> {
    if (file.size > largest_file) {
        studio.say(`${file.name} has ${sizeOf(file.size)}; the limit is ${sizeOf(largest_file)}.`, "error");
        return;
    }
    try {
        const bytes = new Uint8Array(await file.arrayBuffer());
        if (/\.(scl|kbm)$/i.test(file.name)) await openScale(studio, file.name, bytes);
        else if (/\.(l|frm|map)$/i.test(file.name)) await openCollection(studio, file.name, bytes, all);
        else if (/\.toml$/i.test(file.name)) openTable(studio, file.name, bytes);
        else if (/\.(lsys|txt)$/i.test(file.name)) openText(studio, file.name, bytes);
        else if (isPicture(file)) await openPicture(studio, file, bytes);
        else await openPrint(studio, file.name, bytes);
    } catch (error) {
        const message = messageOf(error);
        studio.say(message.startsWith(`${file.name}:`) ? message : `${file.name}: ${message}`, "error");
    }
}

function openText(studio: Studio, name: string, bytes: Uint8Array): void {
    const text = new TextDecoder("utf-8", { fatal: true }).decode(bytes);
    openPattern(studio, { name: name.replace(/\.txt$/i, ".lsys"), text, variant: "", settings: [] });
}

function openTable(studio: Studio, name: string, bytes: Uint8Array): void {
    const text = new TextDecoder("utf-8", { fatal: true }).decode(bytes);
    if (!isArrangement(text)) throw new Error("no arrangement; expected a [[track]] table for each part");
    openArrangement(studio, name, text);
}

async function openScale(studio: Studio, name: string, bytes: Uint8Array): Promise<void> {
    const isMap = /\.kbm$/i.test(name);
    await studio.engine.request({ do: "scale", name }, { bytes });
    keepScale(name, bytes);
    studio.store.setting(isMap ? "keyboard" : "scale", name);
    studio.store.change({ panel: "play" });
    studio.say(`The melody now uses the ${isMap ? "key map" : "scale"} ${name}.`);
}

async function openPrint(studio: Studio, name: string, bytes: Uint8Array): Promise<void> {
    const { json } = await studio.engine.request<Shown>({ do: "show", name }, { bytes });
    if (isArrangement(json.text)) return openArrangement(studio, name.replace(/\.\w+$/, ".toml"), json.text);
    openPattern(studio, { name: name.replace(/\.\w+$/, ".lsys"), text: json.text, ...valuesOf(json.made) });
}

/// Prints contain their pattern; other pictures are photographs.
async function openPicture(studio: Studio, file: File, bytes: Uint8Array): Promise<void> {
    try {
        await openPrint(studio, file.name, bytes);
    } catch (error) {
        if (!(error instanceof RequestFailed)) throw error;
        await readPhotograph(studio, file);
    }
}

// The values that a print was made with, as options of the program: "sikku 0.2.0, -n 3 --set 'stroke=0.5mm red'".
function valuesOf(made: string): Pick<PatternRequest, "variant" | "settings"> {
    const [line, frame] = made.split(/ # n = (?=\d+$)/); // one of several generations
    const words = shellWords(line!);
    const settings: [string, string][] = [];
    let variant = "";
    for (let at = 0; at + 1 < words.length; ++at) {
        const [option, value] = [words[at]!, words[at + 1]!];
        if (option === "-n") settings.push(["derivation length", value]);
        if (option === "--seed") settings.push(["seed", value]);
        if (option === "--variant") variant = value;
        if (option === "--set")
            settings.push([value.slice(0, value.indexOf("=")), value.slice(value.indexOf("=") + 1)]);
    }
    if (frame) settings.push(["derivation length", frame]);
    return { variant, settings };
}

async function openCollection(studio: Studio, name: string, bytes: Uint8Array, all: File[]): Promise<void> {
    const view = all.find((each) => /\.v$/i.test(each.name));
    const { json } = await studio.engine.request<Imported>(
        { do: "import", name, ...(view ? { view: await view.text() } : {}) },
        { bytes },
    );
    // A system with errors has no text: the work stays.
    const open = (system: Imported["systems"][number]) => {
        if (system.text === "") return studio.say(reasonOf(name, system, json), "error");
        openPattern(studio, { name: `${system.name}.lsys`, text: system.text, variant: "", settings: [] });
    };
    const [only] = json.systems;
    if (!only) {
        studio.say(`${name} contains no L-system. ${json.diagnostics[0]?.message ?? ""}`, "error");
        return;
    }
    if (json.systems.length === 1) {
        open(only);
        if (only.text !== "" && only.losses.length > 0) studio.say(`Left out: ${lossesOf(only)}`, "warning");
        return;
    }
    const dialog = openDialog(`${json.systems.length} patterns in ${name}`);
    const list = element("div", { class: "choices" });
    for (const system of json.systems) {
        const choose = () => {
            dialog.close();
            open(system);
        };
        const entry = button(system.name, choose, { kind: "quiet" });
        if (system.losses.length > 0) entry.title = `Left out: ${lossesOf(system)}`;
        list.append(entry);
    }
    dialog.body.append(list);
}

// Why a system of a collection cannot be opened: the importer's first message about it, with its place.
function reasonOf(name: string, system: Imported["systems"][number], { systems, diagnostics }: Imported): string {
    const end = Math.min(...systems.map(({ line }) => line).filter((line) => line > system.line));
    const errors = diagnostics.filter((each) => !each.warning);
    const first = errors.find((each) => each.line >= system.line && each.line < end) ?? errors[0] ?? diagnostics[0];
    if (!first) return `${name}: ${system.name} cannot be read.`;
    return first.line > 0
        ? `${name}, line ${first.line}, column ${first.column}: ${first.message}`
        : `${name}: ${first.message}`;
}

/// Lets the user drop files anywhere on the page.
export function acceptDrops(studio: Studio): void {
    const veil = element(
        "div",
        { class: "drop-veil", hidden: true, "aria-hidden": "true" },
        element("p", {}, "Drop a pattern, an arrangement, a Fractint or cpfg file, a scale, a print made by Sikku, or a photograph of a kolam"),
    );
    document.body.append(veil);
    const hasFiles = (event: DragEvent) => event.dataTransfer?.types.includes("Files") ?? false;
    addEventListener("dragover", (event) => {
        if (!hasFiles(event)) return;
        event.preventDefault();
        veil.hidden = false;
    });
    addEventListener("dragleave", (event) => {
        if (!event.relatedTarget) veil.hidden = true;
    });
    addEventListener(
        "drop",
        (event) => {
            if (!hasFiles(event)) return;
            event.preventDefault();
            event.stopPropagation();
            veil.hidden = true;
            const files = [...event.dataTransfer!.files];
            const first = files.find((file) => !/\.v$/i.test(file.name)) ?? files[0];
            if (first) void openFile(studio, first, files);
            byId("stage").focus();
        },
        { capture: true },
    );
}
