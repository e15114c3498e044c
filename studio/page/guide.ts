// The way in: what the page is for, five steps that are done in the page itself, and three things to make.
import type { Application } from "./application";
import type { Work } from "./context";
import { button, byId, element } from "./elements";
import { openExport } from "./export";
import { showKind } from "./gallery";
import { openPattern } from "./opening";
import { optionOf } from "./options";
import { remember, remembered } from "./storage";
import { isAnother } from "./versions";

const storage_key = "sikku-studio-guide";
const close_icon = "M3.5 3.5l9 9m0-9l-9 9";

interface Step {
    title: string;
    text: (string | Node)[];
    task: string;
    panel: string;
    side: "values" | "text"; // on a narrow screen
    target: string; // selector of what the step is about
    isDone(application: Application, before: Work): boolean;
    show(application: Application): void; // does the task
}

const code = (text: string) => element("code", {}, text);
const settingOf = (work: Work, name: string) => optionOf(work.pattern.settings, name);

// The steps are about the pattern that the page begins with.
const steps: Step[] = [
    {
        title: "Letters are replaced",
        text: [
            "The ", code("axiom"), " is the first word. Each step replaces every ", code("X"), " by what stands behind ",
            code("-->"), ". n says how many times.",
        ],
        task: "Move the slider n to 1, then up again.",
        panel: "map",
        side: "values",
        target: "#row-of-n",
        isDone: ({ store }, before) =>
            settingOf(store.work, "derivation length") !== settingOf(before, "derivation length"),
        show: ({ store }) => store.setting("derivation length", "2"),
    },
    {
        title: "Letters move a pen",
        text: [code("f"), " moves the pen by a step; ", code("+"), " and ", code("-"), " turn it to the left and right by the angle."],
        task: "Turn the angle slowly and watch the line unfold.",
        panel: "map",
        side: "values",
        target: "#row-of-angle",
        isDone: ({ store }, before) =>
            ["angle factor", "angle increment"].some((key) => settingOf(store.work, key) !== settingOf(before, key)),
        show: ({ store }) => store.setting("angle increment", "84"),
    },
    {
        title: "A rule of your own",
        text: ["The picture follows the text. Errors are explained below the line, and Undo brings everything back."],
        task: "Delete a + or a - in the line that begins with X.",
        panel: "map",
        side: "text",
        target: "#text .cm-editor",
        isDone: ({ store, hasErrors }, before) => !hasErrors && store.work.pattern.text !== before.pattern.text,
        show({ store }) {
            const { pattern } = store.work;
            const text = pattern.text.replace(/^X --> .*$/m, "X --> Xf-f-f+Xf+f+f-f-f+X");
            store.change({ pattern: { ...pattern, text, settings: [] } });
        },
    },
    {
        title: "The same word is a melody",
        text: ["Play reads the line as notes: its height is the pitch, and its length the duration."],
        task: "Open Play and press the round button.",
        panel: "",
        side: "text",
        target: "#tab-play",
        isDone: ({ store }) => store.work.panel === "play",
        show: ({ store }) => store.change({ panel: "play" }),
    },
    {
        title: "Keep it, or begin with another",
        text: ["Export saves prints, films, scores and models. Share makes a link. Gallery has hundreds of patterns to change."],
        task: "What would you like to make?",
        panel: "",
        side: "values",
        target: "#tools .primary",
        isDone: () => false,
        show: () => {},
    },
];

interface Aim {
    label: string;
    panels: string[]; // in which the guide is shown
    begin(application: Application): void;
    text: string;
    acts: (application: Application) => [label: string, act: () => void][];
}

/// Opens Export with the format that fits the aim.
const saving = (application: Application, format: string): [label: string, act: () => void] => [
    "Save it…",
    () => openExport(application, format),
];

function clickIn(selector: string, label: string): void {
    const found = [...document.querySelectorAll<HTMLElement>(`${selector} button`)];
    found.find((each) => each.textContent === label)?.click();
}

const aims: Aim[] = [
    {
        label: "A kolam for the door",
        panels: ["bench", "map"],
        begin: ({ store }) => store.change({ panel: "bench" }),
        text: "Click between two dots to cross the lines or turn them back; the other sides follow. Choose a grid beside or below the board.",
        acts: (application) => [
            ["Surprise me", () => clickIn("#panel-bench", "Random kolam")],
            saving(application, "draw pdf"),
        ],
    },
    {
        label: "A poster",
        panels: ["gallery", "map", "variations"],
        begin: ({ store }) => store.change({ panel: "gallery" }),
        text: "Click a picture you like. Then change its colours and n under Values, or choose among Variations, and save it as a PDF of any size.",
        acts: (application) => [
            ["Variations", () => application.store.change({ panel: "variations" })],
            saving(application, "draw pdf"),
        ],
    },
    {
        label: "A melody",
        panels: ["play", "gallery"],
        begin(application) {
            const entry = application.patterns.find(({ name }) => name === "hilbert-todi");
            if (entry) openPattern(application, { name: `${entry.name}.lsys`, text: entry.text }, "play");
        },
        text: "Press play. Scale and instrument are listed beside or below the curve; Gallery has more melodies, and arrangements for several instruments.",
        acts: (application) => [
            ["More melodies", () => {
                application.store.change({ panel: "gallery" });
                showKind("melodies");
            }],
            saving(application, "play mid"),
        ],
    },
];

export class Guide {
    private readonly place = byId("guide");
    private at = -1; // step
    private before: Work | null = null;
    private isDone = false;
    private target: Element | null = null;
    private aim: Aim | null = null;
    private greeted: Work | null = null; // the work of a visitor whom the greeting still waits for

    constructor(private readonly application: Application) {
        this.place.setAttribute("aria-label", "Guide");
        application.store.subscribe(() => this.check());
        application.onChecked(() => this.check());
    }

    /// Greets visitors who come for the first time.
    welcome(): void {
        if (remembered(storage_key, "") !== "") return;
        const greeting = element("div", { class: "guide-text" });
        greeting.append(
            element("h2", {}, "Draw, print and play with a few letters"),
            element(
                "p",
                {},
                "An L-system: rules replace the letters of a word again and again, and a pen follows the result. " +
                    "Change anything, and watch.",
            ),
        );
        const tour = button("Show me in five steps", () => this.start(), { kind: "primary" });
        this.show(greeting, [tour, ...this.aimButtons()]);
        this.greeted = this.application.store.work;
    }

    private aimButtons(): HTMLButtonElement[] {
        return aims.map((aim) => button(aim.label, () => this.follow(aim)));
    }

    private follow(aim: Aim): void {
        this.leave();
        aim.begin(this.application);
        this.aim = aim;
        const text = element("div", { class: "guide-text", role: "status" });
        text.append(element("h2", {}, aim.label), element("p", {}, aim.text));
        this.show(text, aim.acts(this.application).map(([label, act], at) => button(label, act, { kind: at > 0 ? "primary" : "" })));
        this.place.querySelector("button")?.focus({ preventScroll: true });
    }

    /// Begins the five steps with the pattern that they are about.
    start(): void {
        const entry = this.application.patterns.find(({ name }) => name === "snake-kolam");
        const { pattern } = this.application.store.work;
        const isOpen = /^X --> Xf-f-f\+Xf\+f\+Xf-f-f\+X$/m.test(pattern.text) && pattern.settings.length === 0;
        if (entry && !isOpen) openPattern(this.application, { name: `${entry.name}.lsys`, text: entry.text });
        this.go(0);
    }

    private go(at: number): void {
        this.leave();
        this.at = at;
        this.isDone = false;
        const step = steps[at]!;
        const { store } = this.application;
        if (step.panel) store.change({ panel: step.panel });
        this.before = store.work;
        clickIn("#side-tabs", step.side === "text" ? "Text" : "Values");
        this.target = document.querySelector(step.target);
        this.target?.classList.add("guide-target");
        this.draw();
        this.place.querySelector<HTMLElement>("h2")?.focus({ preventScroll: true });
    }

    private draw(): void {
        const step = steps[this.at]!;
        const isLast = this.at === steps.length - 1;
        const text = element("div", { class: "guide-text" });
        const heading = element("h2", { tabindex: -1 }, element("span", { class: "guide-count" }, `${this.at + 1} of ${steps.length}`), " ", step.title);
        const done = this.isDone ? "Done. " : "";
        text.append(
            heading,
            element("p", {}, ...step.text, " "),
            element("p", { class: "guide-task", role: "status" }, element("strong", {}, done), step.task),
        );
        const back = button("Back", () => this.go(this.at - 1), { kind: "quiet" });
        back.disabled = this.at === 0;
        const show = button("Do it for me", () => step.show(this.application));
        const next = button("Next", () => this.go(this.at + 1), { kind: this.isDone ? "primary" : "" });
        this.show(text, isLast ? [back, ...this.aimButtons()] : [back, show, next]);
    }

    private check(): void {
        this.checkGreeting();
        if (this.aim && !this.aim.panels.includes(this.application.store.work.panel)) {
            this.leave();
            this.place.hidden = true;
        }
        const step = steps[this.at];
        if (!step || this.isDone || !this.before || !step.isDone(this.application, this.before)) return;
        this.isDone = true;
        const focused = document.activeElement;
        const label = focused && this.place.contains(focused) ? focused.textContent : null;
        this.draw();
        // The buttons are new ones; who has used one goes on.
        if (label !== null) this.button("Next")?.focus();
    }

    // Whoever opens another view or pattern has found a way alone.
    private checkGreeting(): void {
        const { greeted } = this;
        const { panel, pattern } = this.application.store.work;
        if (!greeted || (panel === greeted.panel && !isAnother(pattern, greeted.pattern))) return;
        this.greeted = null;
        this.place.hidden = true;
    }

    private button(label: string): HTMLButtonElement | undefined {
        return [...this.place.querySelectorAll("button")].find((each) => each.textContent === label);
    }

    private show(text: HTMLElement, acts: HTMLButtonElement[]): void {
        const close = button("Close the guide", () => this.close(), { kind: "quiet", icon: close_icon });
        this.place.replaceChildren(text, element("div", { class: "toolbar guide-acts" }, ...acts), close);
        this.place.hidden = false;
    }

    private leave(): void {
        this.target?.classList.remove("guide-target");
        this.target = null;
        this.at = -1;
        this.aim = null;
        this.before = this.greeted = null;
    }

    private close(): void {
        this.leave();
        remember(storage_key, "closed");
        this.place.hidden = true;
        byId("stage").focus();
        this.application.say("“Guided start” in the menu More shows the guide again.");
    }
}
