// The text editor: every edit changes the work; errors are shown where they occur.
import { autocompletion, closeBrackets, closeBracketsKeymap, completionKeymap } from "@codemirror/autocomplete";
import { defaultKeymap, toggleComment } from "@codemirror/commands";
import { bracketMatching, syntaxHighlighting } from "@codemirror/language";
import { lintGutter, lintKeymap, nextDiagnostic, setDiagnostics, type Diagnostic as Finding } from "@codemirror/lint";
import { highlightSelectionMatches, search, searchKeymap } from "@codemirror/search";
import {
    Annotation, EditorState, type Extension, type Range, StateEffect, type StateEffectType, StateField, type Text,
} from "@codemirror/state";
import {
    Decoration,
    type DecorationSet,
    drawSelection,
    EditorView,
    highlightActiveLine,
    highlightActiveLineGutter,
    keymap,
    lineNumbers,
    WidgetType,
} from "@codemirror/view";
import type { Application } from "./application";
import { colour_swatches } from "./colour_swatches";
import { correctedLine } from "./corrections";
import { button, byId, element } from "./elements";
import { completePattern, cursorHelp, hoverHelp } from "./help_in_text";
import { namesInText } from "./names_in_text";
import { counted } from "./numbers_shown";
import { pattern_colours, pattern_language } from "./pattern_language";
import type { Diagnostic, Failure, Place } from "./protocol";
import { isAnother } from "./versions";

const message_pause = 350; // milliseconds after the last key

const from_outside = Annotation.define<boolean>(); // marks text from an undo, a link or an opened pattern

// Columns of the libraries count code points.
function offset(text: Text, line: number, column: number): number {
    const { from, text: content } = text.line(Math.min(Math.max(line, 1), text.lines));
    let at = 0;
    for (const point of content) {
        if (--column <= 0) break;
        at += point.length;
    }
    return from + at;
}

// Decorations that an effect replaces.
function decorated<Value>(
    effect: StateEffectType<Value>,
    marks: (doc: Text, value: Value) => Range<Decoration>[],
): StateField<DecorationSet> {
    return StateField.define<DecorationSet>({
        create: () => Decoration.none,
        update(shown, { changes, effects, state }) {
            const last = effects.findLast((each) => each.is(effect));
            return last ? Decoration.set(marks(state.doc, last.value as Value), true) : shown.map(changes);
        },
        provide: (field) => EditorView.decorations.from(field),
    });
}

// Highlights the production being played, and the symbol in it.
const light = StateEffect.define<Place | null>();
const lit = decorated(light, (doc, place) => {
    if (!place || place.line < 1 || place.line > doc.lines) return [];
    const from = offset(doc, place.line, place.column);
    const to = offset(doc, place.line, place.column + place.length);
    const production = Decoration.line({ class: "lit-line" }).range(doc.line(place.line).from);
    return to > from ? [production, Decoration.mark({ class: "lit" }).range(from, to)] : [production];
});

// Messages below their lines, shown when typing pauses so that the text does not jump. A button makes the correction
// that the message names.
class Message extends WidgetType {
    constructor(
        private readonly text: string,
        private readonly isWarning: boolean,
        private readonly line: number,
    ) {
        super();
    }
    override eq(other: Message): boolean {
        return other.text === this.text && other.isWarning === this.isWarning && other.line === this.line;
    }
    toDOM(view: EditorView): HTMLElement {
        const shown = element("div", { class: `line-message ${this.isWarning ? "warning" : "error"}` }, this.text);
        const { line } = this;
        if (line <= view.state.doc.lines && correctedLine(view.state.doc.line(line).text, this.text) !== null) {
            shown.append(button("Correct it", () => correct(view, [{ line, message: this.text }]), { kind: "correction" }));
        }
        return shown;
    }
    override ignoreEvent(): boolean {
        return true; // the button acts on its own
    }
}

const correction = "input.correction";

// Makes corrections that messages name; the last first, because one line may become several.
function correct(view: EditorView, faults: { line: number; message: string }[]): void {
    const { doc } = view.state;
    const seen = new Set<number>();
    const changes = faults.flatMap(({ line, message }) => {
        if (line < 1 || line > doc.lines || seen.has(line)) return [];
        const { from, to, text } = doc.line(line);
        const insert = correctedLine(text, message);
        if (insert === null) return [];
        seen.add(line);
        return [{ from, to, insert }];
    });
    if (changes.length > 0) view.dispatch({ changes, userEvent: correction });
    view.focus();
}

const show_messages = StateEffect.define<Diagnostic[]>();
const messages = decorated(show_messages, (doc, diagnostics) =>
    diagnostics.filter(({ line }) => line >= 1 && line <= doc.lines).map(({ line, message, warning }) => {
        const widget = new Message(message, warning, line);
        return Decoration.widget({ widget, block: true, side: 1 }).range(doc.line(line).to);
    }),
);

const look = EditorView.theme({
    "&": { flex: "1", minHeight: "0", fontSize: "13px" },
    ".cm-scroller": { fontFamily: "var(--mono)", lineHeight: "1.6" },
    ".cm-content": { padding: "10px 0", caretColor: "var(--accent)" },
    ".cm-line": { padding: "0 12px 0 6px" },
    ".cm-gutters": { background: "transparent", border: "0", color: "var(--ink-faint)" },
    ".cm-activeLine, .cm-activeLineGutter": { background: "color-mix(in srgb, var(--earth-wash) 45%, transparent)" },
    ".cm-cursor": { borderLeftColor: "var(--accent)", borderLeftWidth: "2px" },
    "&.cm-focused": { outline: "none" },
    "&.cm-focused > .cm-scroller > .cm-selectionLayer .cm-selectionBackground, .cm-selectionBackground": {
        background: "var(--mark)",
    },
});

export class Editor {
    readonly view: EditorView;
    private diagnostics: Diagnostic[] = [];
    private timer = 0;
    private announced = "";
    private readonly strip = element("div", { class: "error-strip", hidden: true });

    constructor(private readonly application: Application) {
        this.view = new EditorView({
            state: EditorState.create({ doc: application.store.work.pattern.text, extensions: this.extensions() }),
            parent: byId("text"),
        });
        byId("text").append(this.strip);
        application.store.subscribe((work) => this.replace(work.pattern.text));
        application.onChecked((error, diagnostics) => this.check(error, diagnostics));
        application.onHighlight((place) => this.view.dispatch({ effects: light.of(place) }));
    }

    private extensions(): Extension[] {
        const { store } = this.application;
        const undo = () => (store.undo(), true);
        const redo = () => (store.redo(), true);
        return [
            lineNumbers(),
            highlightActiveLine(),
            highlightActiveLineGutter(),
            drawSelection(),
            bracketMatching(),
            closeBrackets(),
            lintGutter(),
            search({ top: true }),
            highlightSelectionMatches(),
            EditorView.lineWrapping,
            pattern_language,
            syntaxHighlighting(pattern_colours),
            look,
            lit,
            messages,
            colour_swatches,
            autocompletion({ override: [completePattern(() => this.application)], icons: false }),
            hoverHelp(() => this.application),
            cursorHelp(() => this.application),
            namesInText(() => this.application),
            EditorView.contentAttributes.of({ "aria-label": "Text of the pattern", spellcheck: "false" }),
            keymap.of([
                { key: "Mod-z", run: undo },
                { key: "Mod-y", mac: "Mod-Shift-z", run: redo },
                { key: "Mod-Shift-z", run: redo },
                { key: "Mod-/", run: toggleComment },
                { key: "F8", run: nextDiagnostic },
                ...closeBracketsKeymap,
                ...completionKeymap,
                ...searchKeymap,
                ...lintKeymap,
                ...defaultKeymap,
            ]),
            EditorView.updateListener.of((update) => {
                if (!update.docChanged || update.transactions.some((each) => each.annotation(from_outside))) return;
                const { pattern } = store.work;
                const edited = { ...pattern, text: update.state.doc.toString() };
                // Values belong to the pattern that they were set for.
                if (isAnother(edited, pattern)) Object.assign(edited, { variant: "", settings: [] });
                // A correction is undone alone.
                const isTyped = !update.transactions.some((each) => each.isUserEvent(correction));
                store.change({ pattern: edited }, isTyped ? "text" : "");
            }),
        ];
    }

    // The text was changed elsewhere: only the difference is replaced, so that the cursor stays.
    private replace(text: string): void {
        const now = this.view.state.doc.toString();
        if (now === text) return;
        let from = 0;
        while (from < now.length && from < text.length && now[from] === text[from]) ++from;
        let end = 0;
        while (
            end < now.length - from &&
            end < text.length - from &&
            now[now.length - 1 - end] === text[text.length - 1 - end]
        )
            ++end;
        this.view.dispatch({
            changes: { from, to: now.length - end, insert: text.slice(from, text.length - end) },
            annotations: from_outside.of(true),
        });
    }

    private check(error: Failure["error"] | null, diagnostics: Diagnostic[]): void {
        this.diagnostics = diagnostics;
        const { doc } = this.view.state;
        const findings = diagnostics
            .filter((each) => each.line > 0 && each.line <= doc.lines)
            .map((each): Finding => {
                const from = offset(doc, each.line, each.column);
                const rest = doc.sliceString(from, doc.lineAt(from).to);
                const length = /^(\p{L}[\p{L}\d]*|\S)/u.exec(rest)?.[0].length ?? 0;
                return { from, to: from + length, severity: each.warning ? "warning" : "error", message: each.message };
            });
        const errors = Math.max(diagnostics.filter((each) => !each.warning).length, error ? 1 : 0);
        const warnings = diagnostics.filter((each) => each.warning).length;
        byId("facts").textContent = [
            errors === 0 ? "No errors" : counted(String(errors), "error"),
            ...(warnings > 0 ? [counted(String(warnings), "warning")] : []),
        ].join(", ");
        this.view.dispatch(setDiagnostics(this.view.state, findings));
        clearTimeout(this.timer);
        if (findings.length === 0) this.showMessages([]);
        const line = this.showStrip(error, diagnostics);
        this.timer = window.setTimeout(() => {
            if (findings.length > 0) this.showMessages(this.diagnostics);
            this.announce(line);
        }, message_pause);
    }

    private showMessages(diagnostics: Diagnostic[]): void {
        this.view.dispatch({ effects: show_messages.of(diagnostics) });
    }

    // The strip below the text: the number of errors, the first one, and errors without a place.
    private showStrip(error: Failure["error"] | null, diagnostics: Diagnostic[]): string {
        const errors = diagnostics.filter((each) => !each.warning); // of the word, too, if the pattern could be read
        this.strip.hidden = error === null && errors.length === 0;
        this.strip.replaceChildren();
        if (this.strip.hidden) return "";
        const first = errors.find((each) => each.line > 0);
        const message = errors[0]?.message ?? error?.message ?? "";
        const where = first ? `Line ${first.line}: ` : errors[0]?.setting ? `${errors[0].setting}: ` : "";
        const more = errors.length > 1 ? ` (and ${errors.length - 1} more)` : "";
        this.strip.append(element("span", {}, where + message + more));
        const { doc } = this.view.state;
        const correctable = errors.filter(
            (each) => each.line > 0 && each.line <= doc.lines && correctedLine(doc.line(each.line).text, each.message) !== null,
        );
        if (correctable.length > 0) {
            const label = correctable.length === 1 ? "Correct it" : `Correct all ${correctable.length}`;
            this.strip.append(button(label, () => correct(this.view, correctable), { kind: "quiet" }));
        }
        if (first) this.strip.append(button("Go to it", () => this.goTo(first), { kind: "quiet" }));
        return where + message + more;
    }

    // Announced once, when typing pauses: the status bar repeats the strip for screen readers.
    private announce(line: string): void {
        if (line === this.announced) return;
        this.announced = line;
        this.application.say(line || "No errors.", line ? "error" : "fact");
        byId("message").dataset["source"] = "text";
    }

    goTo(place: { line: number; column: number }): void {
        const at = offset(this.view.state.doc, place.line, place.column);
        this.view.dispatch({ selection: { anchor: at }, scrollIntoView: true });
        this.view.focus();
    }
}
