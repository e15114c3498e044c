// Help in the editor: tooltips and completion, as the libraries answer them.
import type { Completion, CompletionContext, CompletionResult, CompletionSource } from "@codemirror/autocomplete";
import { type Extension, StateEffect, StateField } from "@codemirror/state";
import { EditorView, hoverTooltip, keymap, showTooltip, type Tooltip } from "@codemirror/view";
import type { Application } from "./application";
import { askAt, rangeOf } from "./editor_requests";
import { element } from "./elements";
import { fromMarkdown } from "./markdown";
import type { CompletionItem } from "./protocol";

type Where = () => Application;

const key_kind = 10; // CompletionItemKind.Property of the protocol

function card(markdown: string): HTMLElement {
    return element("div", { class: "help-card" }, ...fromMarkdown(markdown));
}

function completionOf({ label, kind, detail, documentation, textEdit }: CompletionItem): Completion {
    const completion: Completion = { label, apply: textEdit.newText, type: kind === key_kind ? "property" : "text" };
    if (detail) completion.detail = detail;
    if (documentation) completion.info = () => card(documentation.value);
    return completion;
}

/// Completes keys at the beginning of a line, values after a key, and tables in a schedule.
export function completePattern(where: Where): CompletionSource {
    return async ({ state, pos, explicit }: CompletionContext): Promise<CompletionResult | null> => {
        const line = state.doc.lineAt(pos);
        if (!explicit && line.text.slice(0, pos - line.from).trim() === "") return null;
        // Only the completions for the last key stroke are wanted.
        const found = await askAt(where(), state, "completion", pos, {}, { key: "completion" }).catch(() => null);
        const first = found?.items[0];
        if (!first) return null;
        return {
            from: rangeOf(state.doc, first.textEdit.range).from,
            options: found.items.map(completionOf),
            validFor: first.kind === key_kind ? /^[\p{L} ]*$/u : /^[\p{L}\d/#-]*$/u,
        };
    };
}

async function tooltipAt(application: Application, view: EditorView, position: number): Promise<Tooltip | null> {
    if (!application.help) return null; // the libraries have not started yet
    const { state } = view;
    const found = await askAt(application, state, "hover", position).catch(() => null);
    if (!found || view.state.doc !== state.doc) return null;
    const { from, to } = rangeOf(state.doc, found.range);
    return { pos: from, end: to, above: true, create: () => ({ dom: card(found.contents.value) }) };
}

/// Shows help for names under the pointer.
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

async function showHelp(application: Application, view: EditorView): Promise<void> {
    const { head } = view.state.selection.main;
    const tooltip = await tooltipAt(application, view, head);
    if (view.state.selection.main.head !== head) return;
    view.dispatch({ effects: show_help.of(tooltip) });
    const parts = tooltip?.create(view).dom.querySelectorAll("p") ?? [];
    application.say([...parts].map((part) => part.textContent).join(" ") || "There is no help for this text.");
}

/// F1 shows and announces help for the text at the cursor; Escape closes it.
export function cursorHelp(where: Where): Extension {
    return [
        shown_help,
        keymap.of([
            { key: "F1", run: (view) => (void showHelp(where(), view), true) },
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
