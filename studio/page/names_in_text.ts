// Names in the editor: going to their definitions, and renaming them wherever they occur.
import type { Extension } from "@codemirror/state";
import { EditorView, keymap, showDialog } from "@codemirror/view";
import type { Application } from "./application";
import { messageOf, type Work } from "./context";
import { askAt, rangeOf } from "./editor_requests";
import type { TextEdit } from "./protocol";
import { isMac } from "./shortcuts";

type Where = () => Application;

async function goToDefinition(application: Application, view: EditorView, position: number): Promise<void> {
    const { doc } = view.state;
    const places = await askAt(application, view.state, "definition", position).catch(() => null);
    if (view.state.doc !== doc) return;
    if (!places?.length) {
        application.say("This text has no definition.");
        return;
    }
    // From a definition to the next one: several productions can have the same predecessor.
    const ranges = places.map(({ range }) => rangeOf(doc, range));
    const here = ranges.findIndex(({ from, to }) => from <= position && position <= to);
    const { from, to } = ranges[(here + 1) % ranges.length]!;
    view.dispatch({ selection: { anchor: from, head: to }, scrollIntoView: true });
    view.focus();
}

// The work after edits of its text that rename `old`: values that were set for a constant stay with it.
function withName({ pattern, locked = [] }: Work, view: EditorView, edits: TextEdit[], old: string, name: string): Partial<Work> {
    const { doc } = view.state;
    const changes = edits.map(({ range, newText }) => ({ ...rangeOf(doc, range), insert: newText }));
    const text = view.state.update({ changes }).newDoc.toString();
    const starts = changes.map(({ from }) => doc.sliceString(doc.lineAt(from).from, from).trim());
    const isVariant = starts.includes("variant") && pattern.variant === old;
    const changed = starts.includes("define") ? (key: string) => (key === old ? name : key) : (key: string) => key;
    return {
        pattern: {
            ...pattern,
            text,
            variant: isVariant ? name : pattern.variant,
            settings: pattern.settings.map(([key, value]) => [changed(key), value]),
        },
        locked: locked.map(changed),
    };
}

async function renameAt(application: Application, view: EditorView, position: number): Promise<void> {
    const { state } = view;
    try {
        const { placeholder, range } = await askAt(application, state, "prepareRename", position);
        if (view.state.doc !== state.doc) return;
        const input = { type: "text", value: placeholder, autocomplete: "off", spellcheck: "false" };
        const label = `New name of ${placeholder}`;
        const form = await showDialog(view, { label, input, submitLabel: "Rename", focus: "input", top: true, class: "rename" })
            .result;
        view.focus();
        const name = form?.querySelector("input")?.value.trim() ?? "";
        if (name === "" || name === placeholder || view.state.doc !== state.doc) return;
        const { from } = rangeOf(state.doc, range);
        const { changes } = await askAt(application, state, "rename", from, { newName: name });
        if (view.state.doc !== state.doc) return;
        const edits = Object.values(changes)[0] ?? [];
        application.store.change(withName(application.store.work, view, edits, placeholder, name));
    } catch (error) {
        application.say(messageOf(error), "warning");
    }
}

/// F12, or a click with Ctrl (on a Mac, ⌘), go to the definition of a name; F2 renames it.
export function namesInText(where: Where): Extension {
    const atCursor = (act: (application: Application, view: EditorView, position: number) => Promise<void>) =>
        (view: EditorView) => (void act(where(), view, view.state.selection.main.head), true);
    return [
        keymap.of([
            { key: "F12", run: atCursor(goToDefinition) },
            { key: "F2", run: atCursor(renameAt) },
        ]),
        EditorView.domEventHandlers({
            mousedown(event, view) {
                const position = (isMac ? event.metaKey : event.ctrlKey) ? view.posAtCoords(event) : null;
                if (position === null || event.button !== 0) return false;
                event.preventDefault();
                void goToDefinition(where(), view, position);
                return true;
            },
        }),
    ];
}
