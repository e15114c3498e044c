// The controls beside the board.
import { button, element, icon } from "../elements";
import { gridText } from "./dot_grid";
import { counted } from "./gap_names";
import type { Kolam } from "./kolam";
import { hasSymmetry, symmetries, type Symmetry } from "./symmetry";

const shapes: [string, string[]][] = [
    ["Squares", ["3x3", "4x4", "5x5", "6x6", "7x7", "9x9", "11x11", "15x15"]],
    [
        "Diamonds",
        ["1-3-1", "1-3-5-3-1", "1-3-5-7-5-3-1", "1-3-5-7-9-7-5-3-1", "1-3-5-7-9-11-13-11-9-7-5-3-1", "2-4-6-6-4-2"],
    ],
    ["Octagons", ["3-5-5-5-3", "3-5-7-7-7-5-3", "5-7-9-11-11-11-11-11-9-7-5"]],
    ["Other shapes", ["1-3-5-7", "1-3-5-7-9-11", "3-3-9-9-9-3-3", "5-1-5", "7-5-3-1-3-5-7", "4x7", "2x9"]],
];

const symmetry_icons: Record<Symmetry, string> = {
    "none": "M4 4h8v8H4z",
    "mirror-x": "M8 2v12M5.5 5L2.5 8l3 3zM10.5 5l3 3-3 3z",
    "mirror-y": "M2 8h12M5 5.5l3-3 3 3zM5 10.5l3 3 3-3z",
    "mirrors": "M8 2v12M2 8h12",
    "C2": "M12.5 6A5 5 0 0 0 4 5M3.5 2.5V5H6M3.5 10a5 5 0 0 0 8.5 1M12.5 13.5V11H10",
    "C4": "M8 2.5h3.5V6M13.5 8v3.5H10M8 13.5H4.5V10M2.5 8V4.5H6",
    "D4": "M8 1.5v13M1.5 8h13M3.5 3.5l9 9M12.5 3.5l-9 9",
};
const dice_icon = "M3 3h10v10H3zM5.7 5.7h.01M10.3 5.7h.01M8 8h.01M5.7 10.3h.01M10.3 10.3h.01";
const keys_text =
    "Click a gap between two dots to cross the lines there or turn them back; drag to change several. "
    + "On the board, the arrow keys select a gap and the space key changes it.";

export interface Look {
    isColoured: boolean;
    isFilled: boolean;
    hasDots: boolean;
}
export interface Chances {
    density: number;
    seed: number;
}

export interface SideActs {
    resize(rows: number, columns: number): void;
    shape(text: string): void;
    symmetry(symmetry: Symmetry): void;
    single(): void;
    setAll(change: (state: number) => number): void;
    chances(chances: Chances): void;
    look(look: Look): void;
}

export class Side {
    readonly element = element("aside", { class: "bench-side", "aria-label": "Kolam" });
    readonly certificate = element("p", { class: "bench-certificate" });
    private readonly count = element("p", { class: "bench-count" });
    private readonly gridField = element("input", {
        type: "text",
        id: "bench-grid",
        spellcheck: "false",
        autocomplete: "off",
    });
    private readonly problem = element("p", { class: "note bench-problem", role: "alert", hidden: true });
    private readonly rows = element("output", { class: "number" });
    private readonly columns = element("output", { class: "number" });
    private readonly locks = new Map<Symmetry, HTMLButtonElement>();
    private readonly lockName = element("p", { class: "bench-lock-name" });
    private readonly density = element("input", { type: "range", id: "bench-density", min: 0, max: 100, step: 1 });
    private readonly densityText = element("output", { class: "number", for: "bench-density" });
    private readonly seed = element("input", { type: "text", id: "bench-seed", inputmode: "numeric", class: "number" });
    private readonly boxes = new Map<keyof Look, HTMLInputElement>();
    private kolam: Kolam | null = null;
    private counted: unknown = null; // the lines counted last
    private chances: Chances = { density: 0.7, seed: 1 };
    private look: Look = { isColoured: true, isFilled: false, hasDots: true };

    constructor(private readonly acts: SideActs) {
        this.element.append(
            element("div", { class: "bench-facts" }, this.count, this.certificate),
            this.section("Grid of dots", ...this.gridControls()),
            this.section("Symmetry", this.lockControls(), this.lockName),
            this.section("Gaps", ...this.gapControls()),
            this.section(
                "Look",
                this.toggle("Each line in its own colour", "isColoured"),
                this.toggle("Fill alternate fields", "isFilled"),
                this.toggle("Dots", "hasDots"),
            ),
            element("p", { class: "bench-keys", id: "bench-keys" }, keys_text),
        );
    }

    private section(title: string, ...children: HTMLElement[]): HTMLElement {
        return element("section", { class: "bench-section" }, element("h3", {}, title), ...children);
    }

    private gridControls(): HTMLElement[] {
        const { acts } = this;
        const stepper = (label: string, output: HTMLElement, act: (by: number) => void): HTMLElement =>
            element(
                "div",
                { class: "bench-stepper" },
                element("span", { class: "label" }, label),
                button(`Fewer ${label.toLowerCase()}`, () => act(-1), { icon: "M4 8h8" }),
                output,
                button(`More ${label.toLowerCase()}`, () => act(1), { icon: "M4 8h8M8 4v8" }),
            );
        const groups = shapes.map(([label, texts]) => {
            const options = texts.map((text) => element("option", { value: text }, text.replace("x", " × ")));
            return element("optgroup", { label }, ...options);
        });
        const title = element("option", { value: "" }, "Shapes…");
        const select = element("select", { "aria-label": "Shapes" }, title, ...groups);
        select.addEventListener("change", () => {
            if (select.value) acts.shape(select.value);
            select.value = "";
        });
        this.gridField.addEventListener("change", () => acts.shape(this.gridField.value));
        const label = element("label", { for: "bench-grid" }, "Dots in each row");
        return [
            element(
                "div",
                { class: "bench-steppers" },
                stepper("Rows", this.rows, (by) => acts.resize(by, 0)),
                stepper("Columns", this.columns, (by) => acts.resize(0, by)),
            ),
            element("div", { class: "bench-pair" }, element("div", { class: "field" }, label, this.gridField), select),
            this.problem,
        ];
    }

    private lockControls(): HTMLElement {
        const locks = symmetries.map(({ name, label }) => {
            const made = element(
                "button",
                { type: "button", class: "bench-lock", role: "radio", "aria-label": label, title: label },
                icon(symmetry_icons[name]),
            );
            made.addEventListener("click", () => this.acts.symmetry(name));
            made.addEventListener("keydown", (event) => this.moveLock(event, name));
            this.locks.set(name, made);
            return made;
        });
        return element("div", { class: "bench-locks", role: "radiogroup", "aria-label": "Symmetry" }, ...locks);
    }

    private moveLock(event: KeyboardEvent, name: Symmetry): void {
        const by = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
        const { kolam } = this;
        if (by === undefined || !kolam) return;
        event.preventDefault();
        const offered = symmetries.map((each) => each.name).filter((each) => hasSymmetry(kolam.grid, each));
        const next = offered[(offered.indexOf(name) + by + offered.length) % offered.length];
        this.acts.symmetry(next);
        this.locks.get(next)!.focus();
    }

    private gapControls(): HTMLElement[] {
        const { acts } = this;
        this.density.addEventListener("input", () => {
            acts.chances({ ...this.chances, density: this.density.valueAsNumber / 100 });
        });
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
                button("Cross all", () => acts.setAll(() => 1)),
                button("Turn all back", () => acts.setAll(() => 0)),
                button("Swap all", () => acts.setAll((state) => 1 - state)),
            ),
            element(
                "div",
                { class: "bench-random" },
                element(
                    "div",
                    { class: "slider bench-density" },
                    element("label", { for: "bench-density" }, "Crossed"),
                    this.density,
                    this.densityText,
                ),
                element("div", { class: "bench-dice" }, seedLabel, this.seed, dice),
            ),
        ];
    }

    private toggle(label: string, name: keyof Look): HTMLElement {
        const box = element("input", { type: "checkbox" });
        box.addEventListener("change", () => this.acts.look({ ...this.look, [name]: box.checked }));
        this.boxes.set(name, box);
        return element("label", { class: "switch" }, box, label);
    }

    /// Shows why a grid is invalid.
    refuse(message: string): void {
        this.problem.textContent = message;
        this.problem.hidden = false;
        this.gridField.setAttribute("aria-invalid", "true");
    }

    update(kolam: Kolam, chances: Chances, look: Look): void {
        Object.assign(this, { kolam, chances, look });
        const { grid, count } = kolam;
        if (kolam.lines !== this.counted) {
            this.counted = kolam.lines;
            this.count.textContent = counted(count, "line");
            this.count.classList.toggle("single", count === 1);
            // Shown until the libraries have examined the kolam.
            const gaps = `${kolam.crossings} of ${counted(grid.gaps.length, "gap")} crossed`;
            this.certificate.textContent = `${counted(grid.dots.length, "dot")}, ${gaps}.`;
        }
        this.rows.textContent = String(grid.rows.length);
        this.columns.textContent = String(Math.max(...grid.rows));
        this.gridField.value = gridText(grid);
        this.gridField.removeAttribute("aria-invalid");
        this.problem.hidden = true;
        for (const [name, lock] of this.locks) {
            lock.disabled = !hasSymmetry(grid, name);
            lock.setAttribute("aria-checked", String(name === kolam.symmetry));
            lock.tabIndex = name === kolam.symmetry ? 0 : -1;
        }
        this.lockName.textContent = symmetries.find(({ name }) => name === kolam.symmetry)!.label;
        const percent = Math.round(chances.density * 100);
        this.density.valueAsNumber = percent;
        this.density.style.setProperty("--at", `${percent}%`);
        this.density.setAttribute("aria-valuetext", `${percent} percent of the gaps`);
        this.densityText.textContent = `${percent} %`;
        this.seed.value = String(chances.seed);
        for (const [name, box] of this.boxes) box.checked = look[name];
    }
}
