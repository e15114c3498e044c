// Exports the work in every format, or shows the command that makes the same file.
import type { Application } from "./application";
import { copyOrSelect } from "./clipboard";
import { commandSource } from "./command_source";
import { RequestFailed } from "./context";
import { openDialog, type Dialog } from "./dialog";
import { button, checkbox, element, labelled } from "./elements";
import { openFilm, type FilmKind } from "./film";
import { bytes as sizeOf, capital } from "./numbers_shown";
import { drawOptions, windowOnScreen } from "./on_screen";
import { optionGroups, showFit } from "./option_fields";
import { offered } from "./option_scopes";
import { optionOf, withOption } from "./options";
import { drawInto, isAbort } from "./pictures";
import type { Command, FormatHelp, Made, Options, Request, Unfit } from "./protocol";
import { Refusal } from "./refusal";
import { ReliefView } from "./relief_view";

type Interpreter = "draw" | "play";
type CommandRequest = Extract<Request, { do: "command" }>;
interface Choice {
    interpreter: Interpreter;
    format: FormatHelp;
    group: string;
}

interface Group {
    name: string;
    interpreter: Interpreter;
    formats: RegExp;
    opens: RegExp; // groups of options that are open at first
}

const groups: Group[] = [
    { name: "Print", interpreter: "draw", formats: /^(svg|pdf|eps)$/, opens: /^Page/ },
    { name: "Plotter", interpreter: "draw", formats: /^(hpgl|plt|gcode|nc|ngc|dxf)$/, opens: /^(Page|Plotter)/ },
    { name: "Picture", interpreter: "draw", formats: /^(png|tiff?|jpe?g|exr|gif)$/, opens: /^(Page|Picture)/ },
    { name: "Model", interpreter: "draw", formats: /^(obj|glb|gltf|stl)$/, opens: /^(Page|Reliefs)/ },
    { name: "Score", interpreter: "play", formats: /./, opens: /^Passage/ },
    { name: "Other", interpreter: "draw", formats: /./, opens: /^$/ },
];
// Pictures other than PNG, animations and sound files need libraries that the page does without.
const by_the_program = new Set(["tif", "jpg", "exr", "gif", "wav", "flac", "score.pdf"]);
const pattern_format: FormatHelp = { extension: "lsys", label: "Pattern", alias: "", is_several: false, is_text: true };
const types: Record<string, string> = {
    svg: "image/svg+xml",
    pdf: "application/pdf",
    eps: "application/postscript",
    png: "image/png",
    gif: "image/gif",
    mid: "audio/midi",
    musicxml: "application/vnd.recordare.musicxml+xml",
    html: "text/html",
    glb: "model/gltf-binary",
    stl: "model/stl",
    wav: "audio/wav",
    obj: "model/obj",
    flac: "audio/flac",
};
const preview_size = 440; // pixels
const pause = 200; // milliseconds after a change before the file is made again

let chosen = "draw svg"; // kept while the page is open
let relief: ReliefView | null = null; // one for the page: browsers allow few WebGL contexts

function choicesOf(application: Application): Choice[] {
    const facts = application.opened?.facts;
    const { draw, play } = application.help;
    const playable = facts?.is_melody === false && facts.is_spatial ? [] : play.formats;
    const of = (interpreter: Interpreter, formats: FormatHelp[]): Choice[] =>
        formats.map((format) => {
            const fits = (each: Group) => each.interpreter === interpreter && each.formats.test(format.extension);
            return { interpreter, format, group: groups.find(fits)!.name };
        });
    const rows = [...of("draw", draw.formats), ...of("play", playable)];
    return [
        // STL is for reliefs, which are made only of drawings in the plane.
        ...groups.flatMap(({ name }) => rows.filter(({ group, format }) =>
            group === name && !(format.extension === "stl" && facts?.is_spatial))),
        { interpreter: "draw", format: pattern_format, group: "Pattern" },
    ];
}

// Capitalises "compressed MusicXML", but not "glTF". Two formats are "sound", and are named by their extensions.
function nameOf({ label, extension }: FormatHelp): string {
    if (label === "sound" || label === "") return extension.toUpperCase();
    return /^[a-z]+( |$)/.test(label) ? capital(label) : label;
}

class Export {
    private choices: Choice[];
    private formats = element("div");
    private choice: Choice;
    private timer = 0;
    private generation = 0; // of the choice and its options: answers for an earlier one are dropped
    private made: { names: string[]; parts: Uint8Array[] } | null = null;
    private isWindow: boolean;

    private readonly dialog: Dialog;
    private readonly preview = element("canvas", {
        class: "export-preview",
        width: preview_size,
        height: preview_size,
        role: "img",
        "aria-label": "The page",
    });
    private readonly options = element("div", { class: "export-options" });
    private readonly remarks = element("ul", { class: "remarks", "aria-live": "polite" });
    private readonly refusal: Refusal;
    private readonly command = element("code", { class: "command", tabindex: 0 });
    private readonly needed = element(
        "div",
        { class: "command-needs", hidden: true },
        "The command reads the file of the pattern. ",
        button("Save the pattern", () => this.savePattern(), { kind: "quiet" }),
    );
    private readonly save = button("Save", () => this.saveFiles(), { kind: "primary" });

    constructor(private readonly application: Application) {
        this.refusal = new Refusal(application, element("li", { class: "note warning" }));
        this.choices = choicesOf(application);
        this.choice = this.choices.find((each) => this.nameOf(each) === chosen) ?? this.choices[0]!;
        this.isWindow = windowOnScreen(application) !== null;
        const unsubscribe = application.store.subscribe(() => this.refreshSoon());
        const unlisten = application.onOpened(() => this.showFormats());
        this.dialog = openDialog("Export", {
            wide: true,
            closed: () => {
                unsubscribe();
                unlisten();
                ++this.generation;
                clearTimeout(this.timer);
            },
        });
        this.dialog.body.classList.add("export");
        const select = () => getSelection()?.selectAllChildren(this.command);
        const copyCommand = () => copyOrSelect(application, "command", this.command.textContent ?? "", select);
        const copy = button("Copy", copyCommand, { kind: "quiet" });
        this.dialog.body.append(
            this.formats,
            this.options,
            element("div", { class: "export-page" }, this.preview, this.windowSwitch(), this.remarks),
        );
        const label = element("span", { class: "label" }, "As a command");
        const row = element("div", { class: "command-row" }, label, this.command, copy);
        this.dialog.footer.append(row, this.needed, this.save);
        this.showFormats();
        this.choose(this.choice);
        this.dialog.body.querySelector<HTMLElement>("input:checked")?.focus();
    }

    // The formats depend on the pattern: those of the previous one cannot be chosen while a text is being read.
    private showFormats(): void {
        const { opened, store } = this.application;
        this.choices = choicesOf(this.application);
        const name = this.nameOf(this.choice);
        const choice = this.choices.find((each) => this.nameOf(each) === name);
        const isOther = choice === undefined;
        this.choice = choice ?? this.choices[0]!;
        const made = this.makeFormats();
        made.inert = opened?.work.pattern !== store.work.pattern;
        this.formats.replaceWith(made);
        this.formats = made;
        if (isOther) this.choose(this.choice);
    }

    private nameOf(choice: Choice): string {
        return `${choice.interpreter} ${choice.format.extension}`;
    }

    private makeFormats(): HTMLDivElement {
        const fields = [...new Set(this.choices.map((each) => each.group))].map((group) => {
            const labels = this.choices
                .filter((each) => each.group === group)
                .map((each) => {
                    const radio = element("input", { type: "radio", name: "format", class: "unseen" });
                    radio.checked = each === this.choice;
                    radio.addEventListener("change", () => this.choose(each));
                    const isByProgram = by_the_program.has(each.format.extension);
                    return element(
                        "label",
                        { class: isByProgram ? "format by-program" : "format", title: each.format.label },
                        radio,
                        element("span", {}, nameOf(each.format)),
                        element("small", {}, isByProgram ? "program only" : `.${each.format.extension}`),
                    );
                });
            return element("fieldset", {}, element("legend", {}, group), ...labels);
        });
        const film = button("Film, GIF or WAV…", () => this.openFilm("line"));
        return element("div", { class: "formats" }, film, ...fields);
    }

    private openFilm(kind: FilmKind): void {
        this.dialog.close();
        openFilm(this.application, kind);
    }

    private windowSwitch(): HTMLElement {
        const box = checkbox((isChecked) => {
            this.isWindow = isChecked;
            this.refreshSoon();
        }, { checked: this.isWindow });
        const label = labelled(box, "Only the part in view");
        label.hidden = !this.isWindow;
        return label;
    }

    private choose(choice: Choice): void {
        this.choice = choice;
        chosen = this.nameOf(choice);
        this.showOptions();
        this.refresh();
    }

    // Opens the groups that matter for the format.
    private showOptions(): void {
        const { interpreter, format, group } = this.choice;
        const { store, help } = this.application;
        this.options.hidden = format === pattern_format;
        const act = (name: string, value: string | null) => {
            store.change({ [interpreter]: withOption(store.work[interpreter], name, value) });
        };
        const isSpatial = this.application.opened?.facts.is_spatial ?? false;
        const made = optionGroups(
            offered(help, help[interpreter].options).filter((option) => isSpatial || option.name !== "view"),
            store.work[interpreter],
            act,
            interpreter === "draw" ? "Page" : "Passage",
        );
        const opens = groups.find(({ name }) => name === group)?.opens;
        for (const each of made) if (opens?.test(each.dataset["group"]!)) each.setAttribute("open", "");
        this.options.replaceChildren(...made);
        void this.hideUnfit();
    }

    // Hides the options that the format, the drawing or other options exclude, unless they are set.
    private async hideUnfit(): Promise<void> {
        const { choice, application } = this;
        const { interpreter, format } = choice;
        if (interpreter !== "draw" || format === pattern_format) return;
        const { draw: options, pattern } = application.store.work;
        try {
            const asked = { do: "unfit", format: format.extension, options, pattern } as const;
            const { json } = await application.engine.request<Unfit>(asked, { key: "export-unfit" });
            if (choice === this.choice) showFit(this.options, new Set(json.options), application.store.work.draw);
        } catch {
            // an invalid value: its message says what is wrong, and all options stay
        }
    }

    private refreshSoon(): void {
        clearTimeout(this.timer);
        ++this.generation;
        this.save.disabled = true;
        this.preview.classList.add("stale");
        relief?.canvas.classList.add("stale");
        this.timer = window.setTimeout(() => this.refresh(), pause);
    }

    private refresh(): void {
        clearTimeout(this.timer);
        ++this.generation;
        this.save.disabled = true;
        this.save.textContent = "Making…";
        this.made = null;
        if (this.choice.format === pattern_format) this.offerPattern();
        else void this.make();
        void this.hideUnfit();
        void this.showPreview();
    }

    private optionsNow(): Options {
        return this.choice.interpreter === "draw"
            ? drawOptions(this.application, this.isWindow)
            : this.application.store.work.play;
    }

    private async make(): Promise<void> {
        const { interpreter, format } = this.choice;
        const { engine, store } = this.application;
        const { generation } = this;
        const { pattern } = store.work;
        const request = { interpreter, format: format.extension, options: this.optionsNow(), pattern };
        void this.showCommand(request);
        if (by_the_program.has(format.extension)) {
            this.save.textContent = "Save";
            const here = { gif: "line", wav: "play" }[format.extension] as FilmKind | undefined;
            const text = here
                ? "The program writes this format; copy the command below. The page makes a simpler one:"
                : "Only the program can write this format; copy the command below.";
            const needs = "A GIF is an animation: set the option “Generations”, such as 0:4, or “Divide”.";
            const moves = request.options.some(([name]) => name === "generations" || name === "divide");
            const isStill = format.extension === "gif" && !moves;
            this.showRemarks([{ is_warning: false, text }, ...(isStill ? [{ is_warning: true, text: needs }] : [])]);
            if (here) {
                const make = button(`Make a ${format.extension.toUpperCase()} here…`, () => this.openFilm(here));
                this.remarks.append(element("li", {}, make));
            }
            return;
        }
        try {
            const once = { key: "export", seconds: 60 };
            const { json, bytes } = await engine.request<Made>({ do: "make", ...request }, once);
            if (generation !== this.generation) return;
            let from = 0;
            const parts = json.outputs.map(({ size }) => bytes.subarray(from, (from += size)));
            this.offer(json.outputs.map(({ name }) => name), parts);
            this.showRemarks(json.remarks);
        } catch (error) {
            if (generation !== this.generation || !(error instanceof RequestFailed)) return;
            this.save.textContent = "Save";
            this.remarks.replaceChildren(this.refusal.note);
            this.refusal.show(error, request.pattern);
        }
    }

    private offer(names: string[], parts: Uint8Array[]): void {
        this.made = { names, parts };
        const size = sizeOf(parts.reduce((sum, part) => sum + part.length, 0));
        this.save.textContent =
            names.length === 1 ? `Save ${names[0]} (${size})` : `Save ${names.length} files (${size})`;
        this.save.disabled = names.length === 0;
    }

    private offerPattern(): void {
        const { pattern } = this.application.store.work;
        this.command.parentElement!.hidden = true;
        this.needed.hidden = true;
        const text = "The file does not contain changed values; “Write into the text” adds them.";
        this.showRemarks(pattern.settings.length > 0 ? [{ is_warning: false, text }] : []);
        this.offer([pattern.name], [new TextEncoder().encode(pattern.text)]);
    }

    private async showCommand(request: Omit<CommandRequest, "do">): Promise<void> {
        const { generation } = this;
        try {
            const { engine, patterns } = this.application;
            const source = await commandSource(engine, patterns, request.pattern);
            const asked: CommandRequest = { do: "command", ...request, source };
            const { json } = await engine.request<Command>(asked, { key: "export-command" });
            if (generation !== this.generation) return;
            this.command.textContent = json.command;
            this.command.parentElement!.hidden = false;
            this.needed.hidden = source !== request.pattern.name;
        } catch {
            if (generation === this.generation) this.command.parentElement!.hidden = this.needed.hidden = true;
        }
    }

    private savePattern(): void {
        const { name, text } = this.application.store.work.pattern;
        this.application.save(name, new TextEncoder().encode(text), "text/plain");
        this.application.say(`Saved ${name}.`);
    }

    private showRemarks(remarks: Made["remarks"]): void {
        this.remarks.replaceChildren(
            ...remarks.map(({ is_warning, text }) =>
                element("li", { class: is_warning ? "note warning" : "note" }, text),
            ),
        );
    }

    // Dimmed while it shows an earlier work or other options; empty if these cannot be drawn.
    private async showPreview(): Promise<void> {
        this.preview.classList.add("stale");
        relief?.canvas.classList.add("stale");
        const isDrawn = this.choice.interpreter === "draw" && this.choice.format !== pattern_format;
        const { generation } = this;
        const isRelief = isDrawn && this.isRelief() && (await this.showRelief());
        if (generation !== this.generation) return;
        if (relief) relief.canvas.hidden = !isRelief;
        this.preview.hidden = !isDrawn || isRelief;
        if (this.preview.hidden) return;
        try {
            const { engine, store } = this.application;
            const { pattern } = store.work;
            await drawInto(this.preview, preview_size, engine, pattern, this.optionsNow(), "export-preview");
        } catch (error) {
            if (generation !== this.generation || isAbort(error)) return;
            this.preview.width = this.preview.height = preview_size; // the remarks give the reason
        }
        if (generation === this.generation) this.preview.classList.remove("stale");
    }

    private isRelief(): boolean {
        if (this.choice.group !== "Model" || this.application.opened?.facts.is_spatial) return false;
        return this.choice.format.extension === "stl" || optionOf(this.optionsNow(), "relief") !== undefined;
    }

    // False if there is no relief or the browser cannot show it.
    private async showRelief(): Promise<boolean> {
        relief ??= ReliefView.make(preview_size);
        if (!relief) return false;
        if (relief.canvas.parentElement !== this.preview.parentElement) {
            relief.canvas.hidden = true; // until there is something to show
            this.preview.before(relief.canvas);
        }
        const options = withOption(this.optionsNow(), "relief", optionOf(this.optionsNow(), "relief") ?? "");
        const { generation } = this;
        try {
            const { engine, store } = this.application;
            const { pattern } = store.work;
            const { bytes } = await engine.request<Made>(
                { do: "make", interpreter: "draw", format: "glb", options, pattern },
                { lane: "back", key: "export-relief", seconds: 30 },
            );
            if (generation === this.generation) {
                relief.show(bytes);
                relief.canvas.classList.remove("stale");
            }
            return true;
        } catch (error) {
            // The remarks give the reason for a request that failed; a later choice drops this one.
            if (generation === this.generation && !(error instanceof RequestFailed)) console.error(error);
            return false;
        }
    }

    private saveFiles(): void {
        const { made } = this;
        if (!made) return;
        made.names.forEach((name, at) => {
            const other = this.choice.format.is_text ? "text/plain" : "application/octet-stream";
            this.application.save(name, made.parts[at]!, types[name.slice(name.lastIndexOf(".") + 1)] ?? other);
        });
        this.application.say(`Saved ${made.names.join(", ")}.`);
    }
}

/// @param format  is chosen: `draw pdf`, `play mid`; absent: the last one
export function openExport(application: Application, format = chosen): void {
    chosen = format;
    new Export(application);
}
