// The values of the pattern as sliders: n with its cost, defines, angle, stroke, colours, seed. Changed values are kept
// separately from the text, like `--set` and `-n` of the program.
import { angleAt, degreesOf, readAngle, type Angle } from "./angles";
import type { Application } from "./application";
import { makeColours } from "./colours";
import { button, byId, element } from "./elements";
import { whatIsN } from "./explain";
import { count, counted, rounded, span } from "./numbers_shown";
import { optionOf, withOption } from "./options";
import { valueInText, withSettings } from "./pattern_text";
import type { Opened } from "./protocol";
import { makeSeed } from "./seed";
import { makeSlider, type Slider } from "./slider";
import { joinedStroke, splitStroke } from "./stroke";

interface Row {
    slider: Slider;
    update(facts: Opened): void;
}

const further_keys = ["heading", "elasticity"]; // have a slider only if the text sets them
const deep_room = 8; // how far the slider of n goes beyond the largest derivable n, for patterns with windows

function spread(base: number): { least: number; most: number; step: number } {
    if (base === 0) return { least: -1, most: 1, step: 0.01 };
    const most = base > 0 ? base * 2 : 0;
    const step = 10 ** Math.floor(Math.log10(Math.abs(base) / 50));
    return { least: base > 0 ? 0 : base * 2, most, step };
}

export class Controls {
    private rows = new Map<string, Row>();
    private shape = ""; // identifies the set of rows
    private angleLabel = "angle"; // a define may have that name
    private readonly variant = element("select", { id: "variant" });
    private readonly variantField = element(
        "div",
        { class: "field row variant-field" },
        element("label", { for: "variant" }, "Variant"),
        this.variant,
    );
    private readonly list = element("div", { class: "value-rows" });
    private readonly cost = element("p", { class: "cost" });
    private readonly meaning = element("p", { class: "meaning-of-n" });
    private readonly seed;
    private readonly colours;
    private readonly actions;

    constructor(private readonly application: Application) {
        const { store } = application;
        this.seed = makeSeed(application);
        this.colours = makeColours(application);
        this.variant.addEventListener("change", () => {
            store.change({ pattern: { ...store.work.pattern, variant: this.variant.value } });
        });
        const write = button("Write into the text", () => {
            const { pattern } = store.work;
            store.change({ pattern: { ...pattern, text: withSettings(pattern), settings: [] } });
            application.say("The values were written into the text.");
        });
        const reset = button("Reset all", () => store.change({ pattern: { ...store.work.pattern, settings: [] } }), {
            kind: "quiet",
        });
        this.actions = element("div", { class: "toolbar value-actions" }, write, reset);
        byId("values").append(this.variantField, this.list, this.seed.element, this.colours.element, this.actions);
        byId("values").classList.add("unknown"); // until the libraries have started
        application.onOpened((facts) => this.show(facts));
        application.onChecked((error, diagnostics) => {
            byId("values").classList.remove("unknown");
            byId("values").classList.toggle("stale", error !== null);
            const wrong = diagnostics.filter((each) => !each.warning).map((each) => each.setting ?? "");
            for (const [name, row] of this.rows)
                row.slider.setInvalid(wrong.some((each) => each === name || each.startsWith(`${name} `)));
        });
        // Thumbs move at once, without waiting for the libraries.
        store.subscribe((work) => {
            this.actions.hidden = work.pattern.settings.length === 0;
            if (application.opened) for (const row of this.rows.values()) row.update(application.opened.facts);
        });
    }

    private show(facts: Opened): void {
        const { pattern } = this.application.store.work;
        this.variantField.hidden = facts.variants.length === 0;
        const variants = ["", ...facts.variants];
        if (
            this.variant.options.length !== variants.length ||
            variants.some((each, at) => this.variant.options[at]!.value !== each)
        ) {
            this.variant.replaceChildren(
                ...variants.map((each) => element("option", { value: each }, each || "as written")),
            );
        }
        this.variant.value = pattern.variant;
        // A slider that has left the fractions of a circle sets `angle increment` instead of the text's `angle factor`.
        const hasFactor =
            valueInText(pattern, "angle factor") !== null || facts.keys.some((key) => key.name === "angle factor");
        const angle = hasFactor ? "angle factor" : "angle increment";
        const more = further_keys.filter((name) => facts.keys.some((key) => key.name === name));
        this.angleLabel = facts.defines.some((each) => each.name === "angle") ? angle : "angle";
        const names = [
            "derivation length",
            ...facts.defines.map((each) => each.name),
            ...(facts.is_map ? [] : [angle]), // a map has no turtle
            ...more,
            "stroke",
        ];
        if (names.join("\n") !== this.shape) this.build(names);
        this.meaning.textContent = whatIsN(facts.is_map);
        this.showCost(facts);
        for (const row of this.rows.values()) row.update(facts);
        this.seed.update(facts);
        this.colours.update(facts);
        this.actions.hidden = pattern.settings.length === 0;
    }

    private build(names: string[]): void {
        this.shape = names.join("\n");
        this.rows = new Map(
            names.map((name) => {
                if (name === "derivation length") return [name, this.lengthRow()];
                if (name === "angle factor") return [name, this.factorRow()];
                if (name === "stroke") return [name, this.strokeRow()];
                if (name === "angle increment") return [name, this.numberRow(name, this.angleLabel, "90")];
                return [name, this.numberRow(name, name, null)];
            }),
        );
        const focused = document.activeElement instanceof HTMLElement ? document.activeElement.id : "";
        const [length, ...others] = [...this.rows.values()].map((row) => row.slider.element);
        this.list.replaceChildren(length!, this.meaning, this.cost, ...others);
        if (focused) document.getElementById(focused)?.focus();
    }

    // The present value of a setting: changed, or as in the text.
    private value(name: string, absent: string): { now: string; base: string; isChanged: boolean } {
        const { pattern } = this.application.store.work;
        const base = valueInText(pattern, name) ?? absent;
        const chosen = optionOf(pattern.settings, name);
        return { now: chosen ?? base, base, isChanged: chosen !== undefined };
    }

    private change(name: string, value: string | null): void {
        if (value === "") value = null;
        this.application.store.setting(name, value, value === null ? undefined : `setting ${name}`);
    }

    private acts(name: string, text: (number: number) => string) {
        return {
            slide: (number: number) => this.change(name, text(number)),
            type: (value: string) => this.change(name, value),
            reset: () => this.change(name, null),
            explain: () => this.explain(name),
        };
    }

    private explain(name: string): string {
        const define = this.application.opened?.facts.defines.find((each) => each.name === name);
        return define
            ? `${name}, defined on line ${define.line}`
            : (this.application.help?.keys.find((key) => key.name === name)?.help ?? "");
    }

    private lengthRow(): Row {
        const slider = makeSlider("n", this.acts("derivation length", String));
        slider.element.id = "row-of-n";
        return {
            slider,
            update: (facts) => {
                const { now, isChanged } = this.value("derivation length", facts.n);
                const number = Number(now);
                const most = Number(facts.cost.most);
                const limit =
                    Number.isFinite(most) && facts.cost.most !== "" ? Math.min(most, 1000) : Math.max(number * 2, 10);
                slider.set({
                    value: now,
                    number,
                    least: 0,
                    most: Math.max(limit + (facts.has_view && facts.cost.most !== "" ? deep_room : 0), number, 1),
                    step: 1,
                    isChanged,
                    description: `${now}, ${this.cost.textContent}`,
                });
            },
        };
    }

    // Turns continuously: fractions of a circle stay an exact `angle factor`, other angles are an `angle increment`.
    private factorRow(): Row {
        const base = () => Number(this.value("angle factor", "4").base);
        const set = (angle: Angle | null, merges: boolean) => {
            const { store } = this.application;
            const { pattern } = store.work;
            const isBase = angle?.key === "angle factor" && Number(angle.value) === base();
            let settings = withOption(withOption(pattern.settings, "angle factor", null), "angle increment", null);
            if (angle && !isBase) settings = withOption(settings, angle.key, angle.value);
            store.change({ pattern: { ...pattern, settings } }, merges ? "setting angle" : undefined);
        };
        const slider = makeSlider(this.angleLabel, {
            slide: (number) => set(angleAt(number, base()), true),
            type: (value) => {
                const angle = value === "" ? null : readAngle(value);
                // The libraries say what is wrong with other texts.
                set(value === "" || angle ? angle : { key: "angle factor", value }, false);
            },
            reset: () => set(null, false),
            explain: () => this.explain("angle factor"),
        });
        slider.element.id = "row-of-angle";
        return {
            slider,
            update: () => {
                const { settings } = this.application.store.work.pattern;
                const free = optionOf(settings, "angle increment");
                const { now, isChanged } = this.value("angle factor", "4");
                const angle: Angle = free === undefined ? { key: "angle factor", value: now } : { key: "angle increment", value: free };
                const degrees = degreesOf(angle);
                slider.set({
                    value: free === undefined ? `360/${now}` : `${free}°`,
                    number: degrees,
                    least: 0,
                    most: Math.max(180, degrees),
                    step: 1,
                    isChanged: isChanged || free !== undefined,
                    description: `${rounded(degrees, 0.01)} degrees`,
                });
            },
        };
    }

    private numberRow(name: string, label: string, absent: string | null): Row {
        let step = 0.01;
        const slider = makeSlider(
            label,
            this.acts(name, (number) => rounded(number, step)),
        );
        return {
            slider,
            update: (facts) => {
                const fact = facts.defines.find((each) => each.name === name)?.value;
                const { now, base, isChanged } = this.value(name, absent ?? fact ?? "0");
                const start = readNumber(base) ?? 0;
                const range = name === "angle increment" ? { least: 0, most: 180, step: 0.1 } : spread(start);
                const number = readNumber(now) ?? readNumber(fact ?? "") ?? start;
                step = range.step;
                slider.set({
                    value: now,
                    number,
                    least: Math.min(range.least, number),
                    most: Math.max(range.most, number),
                    step,
                    isChanged,
                });
            },
        };
    }

    // The width of the stroke; the unit and colour do not change.
    private strokeRow(): Row {
        const parse = () => {
            const { now, base, isChanged } = this.value("stroke", "0.4mm");
            return { now: splitStroke(now), base: splitStroke(base), isChanged };
        };
        const write = (width: string) => {
            const { now } = parse();
            this.change("stroke", joinedStroke(width, now.unit, now.rest === "none" ? "" : now.rest));
        };
        const slider = makeSlider("stroke", {
            ...this.acts("stroke", String),
            slide: (number) => write(rounded(number, 0.01)),
            type: (value) =>
                /^[\d.]+$/.test(value)
                    ? write(value)
                    : this.change("stroke", value && withColour(value, parse().now.rest)),
        });
        return {
            slider,
            update: () => {
                const { now, base, isChanged } = parse();
                const most = Math.max(Number(base.width || 0.4) * 4, Number(now.width || 0));
                slider.set({
                    value: now.width === "" ? now.rest : `${now.width} ${now.unit}`,
                    number: Number(now.width || 0),
                    least: 0.01,
                    most,
                    step: 0.01,
                    isChanged,
                });
            },
        };
    }

    private showCost(facts: Opened): void {
        const { cost, extent } = facts;
        const parts: string[] = [];
        if (cost.symbols) parts.push(counted(cost.symbols, "symbol"));
        if (cost.cells) parts.push(counted(cost.cells, "cell"), counted(cost.edges, "edge"));
        if (cost.segments && cost.segments !== "0") parts.push(counted(cost.segments, "segment"));
        if (extent) parts.push(`${span(extent[0], extent[2])} × ${span(extent[1], extent[3])} steps`);
        const unknown = facts.is_map ? "This map has too many cells to be counted at once." : "The cost is unknown until the word is derived.";
        this.cost.replaceChildren(element("span", {}, parts.join(" · ") || unknown));
        this.cost.classList.toggle("deep", !cost.is_derivable);
        if (cost.is_derivable) return;
        this.cost.append(
            element(
                "span",
                { class: "note" },
                facts.has_view
                    ? "Too long to derive: the picture derives only what the view shows."
                    : `Too long to derive: the largest n within the budget is ${count(cost.most)}.`,
            ),
        );
    }
}

// Reads numbers and fractions; a slider cannot show other expressions.
function readNumber(text: string): number | null {
    const fraction = /^\s*(-?[\d.]+)\s*\/\s*([\d.]+)\s*$/.exec(text);
    const number = fraction ? Number(fraction[1]) / Number(fraction[2]) : Number(text);
    return text.trim() !== "" && Number.isFinite(number) ? number : null;
}

function withColour(value: string, colour: string): string {
    return splitStroke(value).rest === "" ? `${value} ${colour}`.trim() : value;
}
