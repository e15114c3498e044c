// The controls beside the board.
import { button, checkbox, element, field, icon, labelled, slideTo } from "../elements";
import { capital, counted } from "../numbers_shown";
import type { RimName, SymmetryName } from "../protocol";
import type { DotGrid } from "./dot_grid";
import { crossed, joined, turned } from "./dot_grid";
import { statesTold } from "./gap_names";
import { type GroundName, ground_names, grounds } from "./grounds";
import type { Kolam } from "./kolam";
import { first_look, type Look, usual_rows, type Word, wordGrid } from "./kolam_text";
import type { Photograph, View } from "./photograph";
import { presets } from "./presets";
import { RadioGroup } from "./radio_group";
import { rim_labels, rim_names, rimIcon } from "./rims";
import { symmetry_labels } from "./symmetry";

const symmetry_order: SymmetryName[] = [
    ...(["none", "mirror-x", "mirror-y", "mirrors", "diagonal", "diagonals"] as const),
    ...(["C2", "C3", "C4", "C6", "D3", "D3-y", "D4", "D6"] as const),
];
const symmetry_icons: Record<SymmetryName, string> = {
    "none": "M4 4h8v8H4z",
    "mirror-x": "M8 2v12M5.5 5L2.5 8l3 3zM10.5 5l3 3-3 3z",
    "mirror-y": "M2 8h12M5 5.5l3-3 3 3zM5 10.5l3 3 3-3z",
    "mirrors": "M8 2v12M2 8h12",
    "diagonal": "M3 13L13 3M4 8V4h4zM12 8v4H8z",
    "diagonals": "M3 3l10 10M13 3L3 13",
    "C2": "M12.5 6A5 5 0 0 0 4 5M3.5 2.5V5H6M3.5 10a5 5 0 0 0 8.5 1M12.5 13.5V11H10",
    "C3": "M8 8V2.5h3M8 8l4.8 2.7-1.5 2.6M8 8l-4.8 2.7-1.5-2.6",
    "C4": "M8 2.5h3.5V6M13.5 8v3.5H10M8 13.5H4.5V10M2.5 8V4.5H6",
    "C6": "M8 8V2.5h2M8 8V13.5H6M8 8l4.8-2.7 1 1.7M8 8l4.8 2.7-1 1.7M8 8L3.2 10.7l-1-1.7M8 8L3.2 5.3l1-1.7",
    "D3": "M8 1.5v13M2.4 4.8l11.2 6.4M13.6 4.8L2.4 11.2M8 4l3.5 6h-7z",
    "D3-y": "M1.5 8h13M4.8 2.4l6.4 11.2M4.8 13.6l6.4-11.2M12 8l-6 3.5v-7z",
    "D4": "M8 1.5v13M1.5 8h13M3.5 3.5l9 9M12.5 3.5l-9 9",
    "D6": "M8 1.5v13M1.5 8h13M4.8 2.4l6.4 11.2M4.8 13.6l6.4-11.2M2.4 4.8l11.2 6.4M13.6 4.8L2.4 11.2",
};
const dice_icon = "M3 3h10v10H3zM5.7 5.7h.01M10.3 5.7h.01M8 8h.01M5.7 10.3h.01M10.3 10.3h.01";
const keys_text =
    "Click a gap between two dots: its lines cross, turn back, run past joined, and cross again; Shift goes backwards. "
    + "Drag to change several gaps. On the board the arrow keys select a gap, the space key changes it, and C, T and J "
    + "cross, turn back and join.";

export interface Chances {
    density: number; // of crossed gaps
    joined: number; // of the others
    composed: boolean; // connects all dots; on interlaced grids, forms petals and stars
    seed: number;
}
export const first_chances: Chances = { density: 0.7, joined: 0, composed: true, seed: 1 };

export interface SideActs {
    resize(rows: number, columns: number): void;
    shape(text: string): void;
    check(text: string): void; // while it is typed
    symmetry(symmetry: SymmetryName): void;
    single(): void;
    setAll(change: (state: number) => number): void;
    chances(chances: Chances): void;
    look(look: Look): void;
    word(word: Word): void; // to write in dots
    photograph(file: File): void; // to read
    nextKolam(): void; // of the photograph
    view(view: View): void;
    forget(): void; // the photograph
    nextDoubt(): void; // selects it
    settle(all: boolean): void; // the selected doubtful gap is right, or all are
}

export interface Shown {
    kolam: Kolam;
    chances: Chances;
    look: Look;
    word: Word | null;
    photograph: Photograph | null;
}

type Toggle = "isColoured" | "isFilled" | "hasDots" | "hasCentredDots";

export class Side {
    readonly element = element("aside", { class: "bench-side", "aria-label": "Kolam" });
    readonly certificate = element("p", { class: "bench-certificate" });
    private readonly states = element("p", { class: "bench-states" });
    private readonly count = element("p", { class: "bench-count" });
    private readonly gridField = element("input", {
        type: "text",
        id: "bench-grid",
        spellcheck: "false",
        autocomplete: "off",
    });
    private readonly problem = element("p", { class: "note bench-problem", role: "alert", hidden: true });
    private readonly gridFacts = element("p", { class: "bench-grid-facts", role: "status" });
    private readonly steppers: HTMLButtonElement[] = [];
    private readonly rows = element("output", { class: "number" });
    private readonly columns = element("output", { class: "number" });
    private readonly locks: RadioGroup<SymmetryName>;
    private readonly lockName = element("p", { class: "bench-lock-name" });
    private readonly density = shareSlider("density");
    private readonly joined = shareSlider("joined");
    private readonly composed = checkbox((composed) => this.acts.chances({ ...this.chances, composed }));
    private readonly seed = element("input", { type: "text", id: "bench-seed", inputmode: "numeric", class: "number" });
    private readonly boxes = new Map<Toggle, HTMLInputElement>();
    private readonly letters = element("input", {
        type: "text",
        id: "bench-word",
        spellcheck: "false",
        autocomplete: "off",
        placeholder: "MEERA, மீரா",
    });
    private readonly letterRows = element("input", { type: "number", id: "bench-word-rows", class: "number", min: 5, max: 200, step: 1 });
    private readonly rims: RadioGroup<RimName>;
    private readonly rimName = element("p", { class: "bench-lock-name" });
    private readonly grounds: RadioGroup<GroundName>;
    private readonly groundName = element("p", { class: "bench-lock-name" });
    private readonly hand = shareSlider("hand");
    private readonly doubts = element("p", { class: "bench-doubts", role: "status" });
    private readonly doubtControls: HTMLElement;
    private readonly photographName = element("p", { class: "bench-lock-name" });
    private readonly photographControls: HTMLElement;
    private views: RadioGroup<View> | null = null;
    private readonly nextKolam = button("", () => this.acts.nextKolam());
    private counted: unknown = null; // the lines counted last
    private chances = first_chances;
    private look: Look = first_look;

    constructor(private readonly acts: SideActs) {
        const makeLock = (name: SymmetryName) =>
            element("button", { type: "button", class: "bench-lock", "aria-label": symmetry_labels[name], hidden: true },
                icon(symmetry_icons[name]));
        const makeRim = (name: RimName) =>
            element("button", { type: "button", class: "bench-lock bench-rim", "aria-label": rim_labels[name], title: rim_labels[name] },
                icon(rimIcon(name)));
        const chooseRim = (rim: RimName) => acts.look({ ...this.look, rim });
        this.rims = new RadioGroup({ class: "bench-locks", "aria-label": "Rim" }, rim_names, makeRim, chooseRim);
        const makeGround = (name: GroundName) => {
            const { label, colour } = grounds[name];
            const made = element("button", { type: "button", class: "bench-lock bench-ground", "aria-label": label, title: label });
            made.style.setProperty("--ground", colour);
            return made;
        };
        const chooseGround = (ground: GroundName) => acts.look({ ...this.look, ground });
        this.grounds = new RadioGroup({ class: "bench-locks", "aria-label": "Ground" }, ground_names, makeGround, chooseGround);
        this.doubtControls = this.section("Doubtful gaps", this.doubts, element("div", { class: "toolbar" },
            button("Next gap", () => acts.nextDoubt(), { kind: "primary" }),
            button("It is right", () => acts.settle(false)),
            button("All are right", () => acts.settle(true)),
        ));
        this.photographControls = this.makePhotographControls();
        const locks = { class: "bench-locks", "aria-label": "Symmetry" };
        this.locks = new RadioGroup(locks, symmetry_order, makeLock, (name) => acts.symmetry(name));
        this.element.append(
            element("div", { class: "bench-facts" }, this.count, this.states, this.certificate),
            this.doubtControls,
            this.section("Grid of dots", ...this.gridControls()),
            this.section("Photograph", ...this.photographSection()),
            this.section("Symmetry", this.locks.element, this.lockName),
            this.section("Rim", this.rims.element, this.rimName),
            this.section("Gaps", ...this.gapControls()),
            this.section(
                "Look",
                this.toggle("Coloured lines", "isColoured"),
                this.toggle("Fill alternate fields", "isFilled"),
                this.toggle("Dots", "hasDots"),
                this.toggle("Dots between four crossings", "hasCentredDots"),
            ),
            this.section("Ground and hand", this.grounds.element, this.groundName, ...this.handControls()),
            element("p", { class: "bench-keys", id: "bench-keys" }, keys_text),
        );
    }

    private section(title: string, ...children: HTMLElement[]): HTMLElement {
        return element("section", { class: "bench-section" }, element("h3", {}, title), ...children);
    }

    private gridControls(): HTMLElement[] {
        const { acts } = this;
        const step = (label: string, act: () => void, path: string): HTMLElement => {
            const made = button(label, act, { icon: path });
            this.steppers.push(made);
            return made;
        };
        const stepper = (label: string, output: HTMLElement, act: (by: number) => void): HTMLElement =>
            element(
                "div",
                { class: "bench-stepper" },
                element("span", { class: "label" }, label),
                step(`Fewer ${label.toLowerCase()}`, () => act(-1), "M4 8h8"),
                output,
                step(`More ${label.toLowerCase()}`, () => act(1), "M4 8h8M8 4v8"),
            );
        const groups = presets.map(([label, texts]) => {
            const options = texts.map((each) => {
                const [name, value] = typeof each === "string" ? [each, each] : each;
                return element("option", { value }, name.replaceAll(/(?<=\d)x(?=\d)/g, " × "));
            });
            return element("optgroup", { label }, ...options);
        });
        const title = element("option", { value: "" }, "Grids…");
        const select = element("select", { "aria-label": "Grids" }, title, ...groups);
        select.addEventListener("change", () => {
            if (select.value) acts.shape(select.value);
            select.value = "";
        });
        this.gridField.addEventListener("change", () => acts.shape(this.gridField.value));
        this.gridField.addEventListener("paste", (event) => {
            const text = event.clipboardData?.getData("text/plain") ?? "";
            if (!/\n./.test(text)) return;
            // The rows of a drawn shape: a field has no line feeds.
            event.preventDefault();
            this.gridField.value = text.replace(/\s+$/, "").replaceAll(/\r?\n/g, "/");
            acts.check(this.gridField.value);
        });
        this.gridField.addEventListener("input", () => acts.check(this.gridField.value));
        return [
            element("div", { class: "bench-pair" }, field("Name, or dots in each row", this.gridField), select),
            this.problem,
            this.gridFacts,
            element(
                "div",
                { class: "bench-steppers" },
                stepper("Rows", this.rows, (by) => acts.resize(by, 0)),
                stepper("Columns", this.columns, (by) => acts.resize(0, by)),
            ),
            this.wordControls(),
        ];
    }

    private wordControls(): HTMLElement {
        const write = () => this.acts.word({ letters: this.letters.value.trim(), rows: this.letterRows.valueAsNumber || usual_rows });
        this.letters.addEventListener("change", write);
        this.letterRows.addEventListener("change", write);
        this.letterRows.value = String(usual_rows);
        return element("div", { class: "bench-pair" }, field("Word in dots", this.letters), field("Rows of dots", this.letterRows));
    }

    private handControls(): HTMLElement[] {
        const { input } = this.hand;
        input.addEventListener("input", () => this.acts.look({ ...this.look, hand: input.valueAsNumber / 100 }));
        return [
            element("div", { class: "bench-random" }, shareRow("By hand", this.hand)),
            element("p", { class: "bench-lock-name" }, "Picture and prints show the texture of the floor and lines strewn by hand."),
        ];
    }

    private photographSection(): HTMLElement[] {
        const { acts } = this;
        const input = element("input", { type: "file", accept: "image/*", hidden: true, id: "bench-photograph" });
        input.addEventListener("change", () => {
            if (input.files?.[0]) acts.photograph(input.files[0]);
            input.value = "";
        });
        return [
            element("div", { class: "toolbar" }, button("Read a photograph…", () => input.click()), this.nextKolam, input),
            this.photographName,
            this.photographControls,
        ];
    }

    private makePhotographControls(): HTMLElement {
        const { acts } = this;
        const views = [["photograph", "Photograph"], ["both", "Both"], ["kolam", "Kolam"]] as const;
        const group = new RadioGroup<View>(
            { class: "bench-views", "aria-label": "Shown on the board" },
            views.map(([view]) => view),
            (view) => element("button", { type: "button", class: "bench-view" }, views.find(([each]) => each === view)![1]),
            (view) => acts.view(view),
        );
        this.views = group;
        return element("div", { class: "toolbar" }, group.element, button("Remove", () => acts.forget(), { kind: "quiet" }));
    }

    private gapControls(): HTMLElement[] {
        const { acts } = this;
        for (const name of ["density", "joined"] as const) {
            const { input } = this[name];
            input.addEventListener("input", () => acts.chances({ ...this.chances, [name]: input.valueAsNumber / 100 }));
        }
        this.seed.addEventListener("change", () => {
            const seed = Number(this.seed.value);
            acts.chances({ ...this.chances, seed: Number.isSafeInteger(seed) && seed >= 0 ? seed : this.chances.seed });
        });
        const dice = button("Random kolam", () => acts.chances({ ...this.chances, seed: this.chances.seed + 1 }), {
            icon: dice_icon,
            shows: true,
        });
        const seedLabel = element("label", { for: "bench-seed" }, "Seed");
        return [
            element(
                "div",
                { class: "toolbar" },
                button("Make a single line", () => acts.single(), { kind: "primary" }),
                button("Cross all", () => acts.setAll(() => crossed)),
                button("Turn all back", () => acts.setAll(() => turned)),
                button("Join all", () => acts.setAll(() => joined)),
                button("Swap", () =>
                    acts.setAll((state) => (state === crossed ? turned : state === turned ? crossed : state)),
                ),
            ),
            element(
                "div",
                { class: "bench-random" },
                shareRow("Crossed", this.density),
                shareRow("Joined", this.joined),
                labelled(this.composed, "Compose"),
                element("div", { class: "bench-dice" }, seedLabel, this.seed, dice),
            ),
        ];
    }

    private toggle(label: string, name: Toggle): HTMLElement {
        const box = checkbox((isChecked) => this.acts.look({ ...this.look, [name]: isChecked }));
        this.boxes.set(name, box);
        return labelled(box, label);
    }

    /// Shows why a grid is invalid.
    refuse(message: string): void {
        this.problem.textContent = message;
        this.problem.hidden = false;
        this.gridFacts.textContent = "";
        this.gridField.setAttribute("aria-invalid", "true");
    }

    /// Shows what the grid in the field would be, or is.
    describe(grid: DotGrid): void {
        const dots = counted(grid.dots.length, "dot");
        const rows = grid.rows.length === 1 ? "one row" : `${grid.rows.length} rows`;
        this.gridFacts.textContent = grid.dots.length === 0 ? "" : `${dots} in ${rows}, ${grid.isTriangular ? "interlaced (idukku)" : "straight (ner)"}`;
        this.gridField.removeAttribute("aria-invalid");
        this.problem.hidden = true;
    }

    update({ kolam, chances, look, word, photograph }: Shown): void {
        Object.assign(this, { chances, look });
        const { grid, count } = kolam;
        if (kolam.lines !== this.counted) {
            this.counted = kolam.lines;
            this.count.textContent = counted(count, "line");
            this.count.classList.toggle("single", count === 1);
            // Shown until the libraries have examined the kolam.
            this.certificate.textContent = `${counted(count, "closed line")} around ${counted(grid.dots.length, "dot")}.`;
            this.states.textContent = `${capital(statesTold(kolam))}.`;
        }
        this.rows.textContent = String(grid.rows.length);
        this.columns.textContent = String(Math.max(0, ...grid.rows));
        for (const stepper of this.steppers) stepper.disabled = !grid.isSolid;
        this.gridField.value = word ? wordGrid(word) : grid.text;
        // Not while they are typed.
        if (document.activeElement !== this.letters) this.letters.value = word?.letters ?? "";
        if (word && document.activeElement !== this.letterRows) this.letterRows.value = String(word.rows);
        this.describe(grid);
        for (const [name, lock] of this.locks.buttons) {
            const found = kolam.symmetryNamed(name);
            const obstacle = kolam.isJoined ? found?.obstacleIfJoined : found?.obstacle;
            lock.hidden = !found;
            lock.title = obstacle ? `${symmetry_labels[name]} (${obstacle})` : symmetry_labels[name];
        }
        this.locks.update(kolam.symmetry.name);
        this.lockName.textContent = symmetry_labels[kolam.symmetry.name];
        showShare(this.density, chances.density, "of the gaps");
        showShare(this.joined, chances.joined, "of the other gaps");
        this.composed.checked = chances.composed;
        this.seed.value = String(chances.seed);
        for (const [name, box] of this.boxes) box.checked = look[name];
        // Interlaced dots have no fields between four dots.
        this.boxes.get("hasCentredDots")!.disabled = !look.hasDots || grid.isTriangular;
        this.rims.update(look.rim);
        this.rimName.textContent = rimText(kolam, look.rim);
        this.grounds.update(look.ground);
        this.groundName.textContent = grounds[look.ground].label;
        showShare(this.hand, look.hand, "by hand");
        this.showDoubts(kolam.doubts.size);
        this.showPhotograph(photograph);
    }

    private showDoubts(count: number): void {
        this.doubtControls.hidden = count === 0;
        this.doubts.textContent = count === 0 ? "" : `${counted(count, "gap")} of the photograph ${count === 1 ? "is" : "are"} doubtful: see the dashed rings on the board. A click corrects a gap; N selects the next one, R accepts it.`;
    }

    private showPhotograph(photograph: Photograph | null): void {
        const readable = photograph?.found.readable ?? 1;
        this.nextKolam.hidden = readable < 2;
        this.nextKolam.textContent = `Next of ${readable} kolams`;
        this.photographName.textContent = photograph?.file.name
            ?? "Reads the kolam of a picture. You can also drop the picture on the page.";
        this.photographControls.hidden = !photograph;
        if (photograph) this.views!.update(photograph.view);
    }
}

/// `Horns on 8 loops`
function rimText({ shaped }: Kolam, rim: RimName): string {
    if (rim === "round") return rim_labels.round;
    return shaped > 0 ? `${rim_labels[rim]}, on ${counted(shaped, "loop")}` : `${rim_labels[rim]}: no loop at the rim has room`;
}

interface ShareSlider {
    input: HTMLInputElement;
    output: HTMLOutputElement;
}

function shareSlider(name: string): ShareSlider {
    const id = `bench-${name}`;
    return {
        input: element("input", { type: "range", id, min: 0, max: 100, step: 1 }),
        output: element("output", { class: "number", for: id }),
    };
}

function shareRow(label: string, { input, output }: ShareSlider): HTMLElement {
    return element("div", { class: "slider bench-density" }, element("label", { for: input.id }, label), input, output);
}

function showShare({ input, output }: ShareSlider, share: number, whole: string): void {
    const percent = Math.round(share * 100);
    slideTo(input, percent, `${percent} percent ${whole}`);
    output.textContent = `${percent} %`;
}
