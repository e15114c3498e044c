// Help in the editor: tooltips for keys and symbols, and completion. All help texts come from the libraries.
import type { Completion, CompletionContext, CompletionResult, CompletionSource } from "@codemirror/autocomplete";
import { type Extension, StateEffect, StateField } from "@codemirror/state";
import { EditorView, hoverTooltip, keymap, showTooltip, type Tooltip } from "@codemirror/view";
import type { Application } from "./application";
import { element } from "./elements";
import { capital } from "./numbers_shown";
import { kindOf } from "./pattern_language";
import type { KeyHelp } from "./protocol";

type Where = () => Application;

/// The help of a key: what it does, its values, and its default.
export function keyCard(key: KeyHelp): HTMLElement {
    const card = element("div", { class: "help-card" }, element("strong", {}, key.name), element("p", {}, key.help));
    const facts = element("dl");
    if (key.values) facts.append(element("dt", {}, "Values"), element("dd", {}, key.values));
    if (key.if_absent) facts.append(element("dt", {}, "If absent"), element("dd", {}, key.if_absent));
    card.append(facts);
    return card;
}

// Values such as `right, left`: only names are offered, not prose.
function choices(key: KeyHelp): string[] {
    if (/\b(a|an|the|such|or|with)\b|;/.test(key.values)) return [];
    return key.values
        .split(",")
        .map((each) => each.trim())
        .filter((each) => /^[\p{L}\d/ ]+$/u.test(each));
}

/// Completes keys at the beginning of a line, and values after a key.
export function completePattern(where: Where): CompletionSource {
    return (context: CompletionContext): CompletionResult | null => {
        const { help } = where();
        if (!help) return null;
        const line = context.state.doc.lineAt(context.pos);
        const before = line.text.slice(0, context.pos - line.from);
        const value = /^\s*([\p{L} ]+?)\s*:\s*([\p{L}\d/ ]*)$/u.exec(before);
        if (value) {
            const key = help.keys.find((each) => each.name === value[1]);
            const options = key ? choices(key) : [];
            return options.length === 0
                ? null
                : { from: context.pos - value[2]!.length, options: options.map((label) => ({ label })) };
        }
        const name = /^\s*([\p{L} ]*)$/u.exec(before);
        if (!name || (name[1] === "" && !context.explicit)) return null;
        const set = new Set(
            context.state.doc
                .toString()
                .split("\n")
                .map((each) => /^\s*([\p{L} ]+?)\s*:/u.exec(each)?.[1]),
        );
        const options = help.keys
            .filter((key) => !set.has(key.name))
            .map((key): Completion => ({
                label: key.name,
                apply: `${key.name}: `,
                detail: key.values.length < 28 ? key.values : "",
                info: () => keyCard(key),
                type: "property",
            }));
        return { from: context.pos - name[1]!.length, options, validFor: /^[\p{L} ]*$/u };
    };
}

// The help for a column of a line, and the columns that it covers.
function explain(
    application: Application,
    line: string,
    column: number,
): { from: number; to: number; dom: HTMLElement } | null {
    const { help } = application;
    const name = /^(\s*)([\p{L} ]+?)\s*:/u.exec(line);
    if (name && !line.includes("-->") && column <= name[0].length) {
        const key = help.keys.find((each) => each.name === name[2]);
        return key ? { from: name[1]!.length, to: name[1]!.length + name[2]!.length, dom: keyCard(key) } : null;
    }
    const identifiers = [...line.matchAll(/[\p{L}_][\p{L}\d_]*/gu)];
    const identifier = identifiers.find((each) => each.index <= column && column < each.index + each[0].length);
    const define = application.opened?.facts.defines.find((each) => each.name === identifier?.[0]);
    if (identifier && define) {
        const dom = element(
            "div",
            { class: "help-card" },
            element("strong", {}, `${define.name} = ${define.value}`),
            element("p", {}, `Defined on line ${define.line}.`),
        );
        return { from: identifier.index, to: identifier.index + identifier[0].length, dom };
    }
    const hasSymbols = ["production", "word", "other"].includes(kindOf(line));
    if (!hasSymbols || line.indexOf("-->") === column || line.slice(column - 2, column + 3).includes("-->"))
        return null;
    if (name && column < name[0].length) return null;
    const start = line[column - 1] === "@" ? column - 1 : column;
    const symbol =
        line[start] === "@" ? line.slice(start, start + 2) : String.fromCodePoint(line.codePointAt(column) ?? 32);
    return explainSymbol(application, symbol, start);
}

function explainSymbol(application: Application, symbol: string, start: number) {
    const row = application.help.symbols.find(
        (each) => each.symbol === symbol || each.symbol.split(/[\s,]+/).includes(symbol),
    );
    const productions =
        application.opened?.facts.productions.filter((each) => each.predecessor.startsWith(symbol)) ?? [];
    if (!row && productions.length === 0) return null;
    const dom = element("div", { class: "help-card" }, element("strong", { class: "mono" }, symbol));
    if (row) dom.append(element("p", {}, capital(row.help)));
    for (const each of productions.slice(0, 4)) {
        const successor = each.successor.length > 60 ? `${each.successor.slice(0, 60)}…` : each.successor;
        dom.append(element("p", { class: "mono" }, `${each.predecessor} --> ${successor}  (line ${each.line})`));
    }
    return { from: start, to: start + symbol.length, dom };
}

function tooltipAt(application: Application, view: EditorView, position: number): Tooltip | null {
    if (!application.help) return null; // the libraries have not started yet
    const line = view.state.doc.lineAt(position);
    const found = explain(application, line.text, position - line.from);
    return (
        found && {
            pos: line.from + found.from,
            end: line.from + found.to,
            above: true,
            create: () => ({ dom: found.dom }),
        }
    );
}

/// Shows help for keys, symbols and defines under the pointer.
export function hoverHelp(where: Where): Extension {
    return hoverTooltip((view, position) => tooltipAt(where(), view, position), { hoverTime: 350 });
}

const show_help = StateEffect.define<Tooltip | null>();
const shown_help = StateField.define<Tooltip | null>({
    create: () => null,
    update(tooltip, transaction) {
        for (const effect of transaction.effects) if (effect.is(show_help)) return effect.value;
        return transaction.docChanged || transaction.selection ? null : tooltip;
    },
    provide: (field) => showTooltip.from(field),
});

/// F1 shows and announces help for the text at the cursor; Escape closes it.
export function cursorHelp(where: Where): Extension {
    return [
        shown_help,
        keymap.of([
            {
                key: "F1",
                run(view) {
                    const tooltip = tooltipAt(where(), view, view.state.selection.main.head);
                    view.dispatch({ effects: show_help.of(tooltip) });
                    const parts = tooltip?.create(view).dom.querySelectorAll("strong, p, dt, dd") ?? [];
                    where().say(
                        [...parts].map((part) => part.textContent).join(" ") || "There is no help for this text.",
                    );
                    return true;
                },
            },
            {
                key: "Escape",
                run(view) {
                    if (!view.state.field(shown_help)) return false;
                    view.dispatch({ effects: show_help.of(null) });
                    return true;
                },
            },
        ]),
    ];
}
