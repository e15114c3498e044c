// A swatch before each colour in the text. A click opens the browser's colour picker and writes the chosen colour.
import { type Extension } from "@codemirror/state";
import {
    Decoration,
    type DecorationSet,
    EditorView,
    MatchDecorator,
    ViewPlugin,
    type ViewUpdate,
    WidgetType,
} from "@codemirror/view";
import { element } from "./elements";

class Swatch extends WidgetType {
    constructor(private readonly colour: string) {
        super();
    }
    override eq(other: Swatch): boolean {
        return other.colour === this.colour;
    }

    toDOM(view: EditorView): HTMLElement {
        const digits = this.colour.slice(1);
        const plain =
            digits.length < 6
                ? `#${[...digits.slice(0, 3)].map((digit) => digit + digit).join("")}`
                : `#${digits.slice(0, 6)}`;
        // Hidden from screen readers: the swatch only repeats the text for the pointer.
        const input = element("input", {
            type: "color",
            class: "swatch",
            value: plain,
            tabindex: -1,
            "aria-hidden": "true",
        });
        input.addEventListener("input", () => {
            const from = view.posAtDOM(input);
            const old = /^#[\da-fA-F]{3,8}/.exec(view.state.doc.sliceString(from, from + 9))?.[0];
            if (old) view.dispatch({ changes: { from, to: from + old.length, insert: input.value } });
        });
        return input;
    }

    override updateDOM(dom: HTMLElement): boolean {
        // The colour picker stays open while the text changes.
        if (document.activeElement !== dom || this.colour.length !== 7) return false;
        (dom as HTMLInputElement).value = this.colour;
        return true;
    }

    override ignoreEvent(): boolean {
        return true;
    }
}

const matcher = new MatchDecorator({
    regexp: /#(?:[\da-fA-F]{8}|[\da-fA-F]{6}|[\da-fA-F]{3,4})\b/g,
    decorate: (add, from, _to, match) => add(from, from, Decoration.widget({ widget: new Swatch(match[0]), side: -1 })),
});

export const colour_swatches: Extension = ViewPlugin.fromClass(
    class {
        marks: DecorationSet;
        constructor(view: EditorView) {
            this.marks = matcher.createDeco(view);
        }
        update(update: ViewUpdate): void {
            this.marks = matcher.updateDeco(update, this.marks);
        }
    },
    { decorations: (plugin) => plugin.marks },
);
