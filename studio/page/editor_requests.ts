// The editor's requests to the libraries about the text: those of the language server protocol, answered by the code of
// `sikku lsp`.
import type { EditorState, Text } from "@codemirror/state";
import type { Application } from "./application";
import type { RequestOptions } from "./context";
import type { EditorMethods, TextPlace, TextRange } from "./protocol";

export interface FoundRange { from: number; to: number }

export function placeOf(doc: Text, position: number): TextPlace {
    const line = doc.lineAt(position);
    return { line: line.number - 1, character: position - line.from };
}

function positionOf(doc: Text, { line, character }: TextPlace): number {
    const { from, to } = doc.line(Math.min(line + 1, doc.lines));
    return Math.min(from + character, to);
}

export function rangeOf(doc: Text, { start, end }: TextRange): FoundRange {
    return { from: positionOf(doc, start), to: positionOf(doc, end) };
}

/// The answer for a position in the text. Throws as Engine.request().
export async function askAt<Method extends keyof EditorMethods>(
    { engine, store }: Application,
    state: EditorState,
    method: Method,
    position: number,
    more: { newName?: string } = {},
    options: RequestOptions = {},
): Promise<EditorMethods[Method]> {
    const textDocument = { uri: store.work.pattern.name, text: state.doc.toString() };
    const parameters = { textDocument, position: placeOf(state.doc, position), ...more };
    const { json } = await engine.request<{ result: EditorMethods[Method] }>(
        { do: "editor", method: `textDocument/${method}`, parameters },
        options,
    );
    return json.result;
}
