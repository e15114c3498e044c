// Why a drawing was not made, in a note, with a button that sets the largest derivation length that can be drawn.
import { messageOf, RequestFailed, type Studio, type Work } from "./context";
import { button, element } from "./elements";
import { counted, sentence } from "./numbers_shown";
import type { Affordable } from "./protocol";

const search_seconds = 5; // for the derivation length

/// The reason for an error about a pattern.
export function reasonOf(studio: Studio, error: unknown, pattern: Work["pattern"]): string {
    if (!(error instanceof RequestFailed)) return messageOf(error);
    if (error.failure.kind !== "stopped") return sentence(error.message);
    const { opened } = studio;
    const facts = opened?.work.pattern === pattern ? opened.facts : null;
    const { segments = "", symbols = "" } = facts?.cost ?? {};
    const size =
        segments !== "" && segments !== "0"
            ? `has ${counted(segments, "segment")}`
            : symbols !== ""
              ? `has a word of ${counted(symbols, "symbol")}`
              : "takes longer than that";
    const what = facts ? `: this drawing ${size} at n = ${facts.n}` : "";
    return sentence(`${error.message}${what}`);
}

/// A note that explains errors about drawings.
export class Refusal {
    private static count = 0;
    private readonly key = `affordable-${++Refusal.count}`;
    private shown = 0; // number of the error
    private readonly remedy = element("div", { class: "toolbar" });

    /// @param note  is shown and hidden
    constructor(private readonly studio: Studio, readonly note: HTMLElement) {}

    clear(): void {
        ++this.shown;
        this.note.hidden = true;
        this.note.replaceChildren();
    }

    /// Shows a reason, and later the remedy if there is one.
    show(error: unknown, pattern: Work["pattern"]): void {
        const number = ++this.shown;
        this.remedy.replaceChildren();
        this.note.replaceChildren(element("p", {}, reasonOf(this.studio, error, pattern)), this.remedy);
        this.note.hidden = false;
        if (!(error instanceof RequestFailed) || !["stopped", "budget"].includes(error.failure.kind)) return;
        void this.lookFor(pattern, error.failure.message).then((n) => {
            if (number !== this.shown || n === "") return;
            this.remedy.replaceChildren(
                element("span", {}, "The largest n that can be drawn:"),
                button(`Set n = ${n}`, () => this.studio.store.setting("derivation length", n)),
            );
        });
    }

    private async lookFor(pattern: Work["pattern"], message: string): Promise<string> {
        const told = /the largest derivation length that fits is (\d+)/.exec(message)?.[1];
        if (told !== undefined) return told;
        try {
            const { json } = await this.studio.engine.request<Affordable>(
                { do: "affordable", seconds: search_seconds, pattern },
                { key: this.key },
            );
            return json.n;
        } catch {
            return ""; // there is only the reason
        }
    }
}
