// Makes a link with a QR code, and inspects links before they are opened.
import { generate } from "lean-qr";
import type { Application } from "./application";
import { presentEntry } from "./back";
import { copyOrSelect } from "./clipboard";
import { messageOf, RequestFailed } from "./context";
import { openDialog, type Dialog } from "./dialog";
import { button, checkbox, element, field, labelled } from "./elements";
import { titleOfArrangement } from "./arrangements";
import { excerpt, readArrangement, readLocked, readPlace, unknownOptions } from "./link_contents";
import { count } from "./numbers_shown";
import { drawOptions, windowOnScreen } from "./on_screen";
import { openPattern } from "./opening";
import { withOption } from "./options";
import { titleOf } from "./pattern_text";
import type { Link, PatternRequest, ReadLink, Shared } from "./protocol";
import { frameFor, linkIn } from "./viewing";

const quiet_zone = 4; // modules of white around a code
const code_width = 280; // pixels, for whole pixels in each module
const most_text = 20_000; // characters of a link that are shown; short links can hold many megabytes
const most_value = 500; // characters
const most_rows = 100; // values

const isServed = () => /^https?:$/.test(location.protocol);

function shared(application: Application, withView: boolean): Shared {
    const { pattern, draw, play, place, panel, locked, arrangement } = application.store.work;
    const page: Record<string, string> = { panel };
    if (arrangement) page["arrangement"] = JSON.stringify(arrangement);
    if (withView && place) page["place"] = JSON.stringify(place);
    if (locked?.length) page["locked"] = JSON.stringify(locked);
    return { pattern, draw: withView ? drawOptions(application, true) : draw, play, page };
}

export function openShare(application: Application): void {
    const dialog = openDialog("Share");
    const address = element("textarea", { readonly: true, rows: 4, "aria-label": "Link", spellcheck: "false" });
    const facts = element("p", { role: "status" });
    const frame = element("textarea", { readonly: true, rows: 3, "aria-label": "Code of the frame", spellcheck: "false" });
    const copyFrame = button("Copy the code", () => copyOrSelect(application, "code", frame.value, () => frame.select()));
    const code = element("canvas", { class: "code", role: "img", "aria-label": "QR code of the link" });
    const hasView = windowOnScreen(application) !== null;
    const box = checkbox(() => void make(), { checked: hasView });
    const view = labelled(box, "Include the current view");
    view.hidden = !hasView;
    const copyLink = () => copyOrSelect(application, "link", address.value, () => address.select());
    const copy = button("Copy the link", copyLink, { kind: "primary" });

    const make = async () => {
        try {
            const { json } = await application.engine.request<Link>(
                { do: "link", shared: shared(application, box.checked) },
                { key: "link" },
            );
            const link = `${location.href.replace(/#.*$/s, "")}#${json.link}`;
            address.value = link;
            const { arrangement, pattern } = application.store.work;
            frame.value = frameFor(link, arrangement ? titleOfArrangement(arrangement) : titleOf(pattern));
            showCode(code, facts, isServed() ? link : `#${json.link}`);
        } catch (error) {
            facts.textContent = error instanceof RequestFailed ? error.message : String(error);
        }
    };
    dialog.body.append(
        element("p", {}, "The link contains the pattern, its values, the view and the options. Nothing is uploaded."),
        address,
        view,
        element(
            "div",
            { class: "code-row" },
            code,
            element(
                "div",
                { class: "code-facts" },
                facts,
                element("p", {}, "Commands accept it, too: ", element("code", {}, "sikku draw LINK -o print.svg")),
                ...(application.store.work.arrangement
                    ? [element("p", {}, "Commands read only the pattern of the link, not the arrangement: save that as MIDI in Play.")]
                    : []),
            ),
        ),
    );
    dialog.body.append(
        element(
            "details",
            { class: "group" },
            element("summary", {}, "Embed in a web page"),
            element(
                "p",
                {},
                isServed()
                    ? "The frame shows the picture, the model or the melody without the editor. It draws at once."
                    : "This page is a local file, which other pages cannot show: open the studio from a server for a frame that works.",
            ),
            frame,
            copyFrame,
        ),
    );
    dialog.footer.append(copy);
    copy.focus();
    void make();
}

function showCode(canvas: HTMLCanvasElement, facts: HTMLElement, text: string): void {
    const length = `${count(String(text.length))} characters`;
    try {
        generate(text).toCanvas(canvas, { on: [42, 33, 28, 255], off: [255, 255, 255, 255], pad: quiet_zone });
        canvas.hidden = false;
        canvas.style.width = `${canvas.width * Math.max(2, Math.floor(code_width / canvas.width))}px`;
        facts.textContent = isServed()
            ? `The link has ${length}.`
            : `This page is a local file, so the code contains only the work (${length}). Open > A link… opens it.`;
    } catch {
        canvas.hidden = true;
        facts.textContent = `The link has ${length}: too many for a QR code (at most 2,953).`;
    }
}

let inspected: Dialog | null = null; // a later link replaces it
let inspections = 0;

/// Shows the contents of a link. Nothing is derived or drawn before the user opens it.
export async function inspectLink(application: Application, link: string): Promise<void> {
    const inspection = ++inspections;
    const { hash } = location;
    const forget = () => forgetHash(hash);
    let contents: Shared;
    let withheld: ReadLink["withheld"];
    try {
        ({ shared: contents, withheld } = (
            await application.engine.request<ReadLink>({ do: "read_link", link: linkIn(link) })
        ).json);
        if (inspection !== inspections) return;
        const unknown = unknownOptions(contents, application.help);
        if (unknown.length > 0) {
            const names = excerpt(unknown.join(", "), 200).text;
            throw new Error(`it sets options that this studio does not know: ${names}`);
        }
    } catch (error) {
        if (inspection !== inspections) return;
        application.say(`The link cannot be read: ${messageOf(error)}`, "error");
        forget();
        return;
    }
    const open = () => openContents(application, contents);
    if (isBundled(application, contents)) {
        forget();
        return open();
    }
    const { pattern } = contents;
    const arrangement = readArrangement(contents.page?.["arrangement"]);
    const whole = arrangement ? `${arrangement.text.trimEnd()}\n\n# The pattern beside it:\n${pattern.text}` : pattern.text;
    const shown = excerpt(whole, most_text);
    inspected?.close();
    const dialog = openDialog(`This link contains ${arrangement ? "an arrangement" : "a pattern"}`, {
        closed: () => {
            if (inspected === dialog) inspected = null;
            forget();
        },
    });
    inspected = dialog;
    dialog.body.classList.add("link-contents");
    const label = `Text of the ${arrangement ? "arrangement" : "pattern"}`;
    const text = element("pre", { class: "link-text", tabindex: 0, "aria-label": label }, shown.text);
    const title = arrangement ? titleOfArrangement(arrangement) : titleOf(pattern);
    dialog.body.append(
        element(
            "p",
            {},
            element("strong", {}, excerpt(title, most_value).text),
            ". It has not been run. It is only data: it can draw and play, nothing else.",
        ),
        text,
        ...(shown.rest > 0
            ? [element("p", { class: "note warning" }, `${count(String(shown.rest))} more characters are not shown.`)]
            : []),
        ...values(contents, pattern),
        ...leftOut(withheld),
    );
    const openIt = button(
        "Open",
        () => {
            dialog.close();
            open();
        },
        { kind: "primary" },
    );
    dialog.footer.append(
        button("Discard", () => dialog.close()),
        openIt,
    );
    text.focus(); // not Open: whoever presses Enter has read nothing yet
}

function openContents(application: Application, { pattern, draw = [], play = [], page = {} }: Shared): void {
    openPattern(application, { variant: "", settings: [], ...pattern }, page["panel"] ?? "map", {
        draw: withOption(draw, "window", null),
        play,
        place: readPlace(page["place"]),
        locked: readLocked(page["locked"]),
        arrangement: readArrangement(page["arrangement"]),
    });
}

/// True for bundled patterns and arrangements as they are, such as those of the links of the site: they need no questions.
function isBundled({ patterns, arrangements }: Application, { pattern, draw = [], play = [], page = {} }: Shared): boolean {
    if ((pattern.settings ?? []).length + draw.length + play.length > 0) return false;
    const played = readArrangement(page["arrangement"]);
    const isKnown = patterns.some(({ text }) => text === pattern.text);
    return isKnown && (played === null || arrangements.some(({ text }) => text === played.text));
}

/// Commands for a plotter that the link wants to set. They are shown, and not used.
function leftOut(withheld: ReadLink["withheld"]): HTMLElement[] {
    if (withheld.length === 0) return [];
    const names = withheld.map(([name, value]) => `${name}: ${value}`).join("; ");
    return [
        element(
            "p",
            { class: "note warning" },
            "Left out, because a link cannot set commands for a plotter: ",
            element("code", {}, excerpt(names, most_value).text),
        ),
    ];
}

function values(contents: Shared, pattern: PatternRequest): HTMLElement[] {
    const rows = [
        ...(pattern.variant ? [["variant", pattern.variant]] : []),
        ...(pattern.settings ?? []),
        ...(contents.draw ?? []),
        ...(contents.play ?? []),
    ];
    if (rows.length === 0) return [];
    return [
        element("h3", {}, "Values and options"),
        element(
            "ul",
            { class: "link-values", tabindex: 0, "aria-label": "Values and options" },
            ...rows
                .slice(0, most_rows)
                .map(([name, value]) =>
                    element("li", {}, element("code", {}, excerpt(`${name}: ${value}`, most_value).text)),
                ),
        ),
        ...(rows.length > most_rows
            ? [element("p", { class: "note warning" }, `${rows.length - most_rows} more are not shown.`)]
            : []),
    ];
}

// The link has been answered: a reload does not ask again. A link that came in the meantime stays.
function forgetHash(hash: string): void {
    if (hash && location.hash === hash) history.replaceState(presentEntry(), "", location.href.replace(/#.*$/s, ""));
}

export function watchLinks(application: Application): void {
    const inspect = () => {
        if (location.hash.length > 1) void inspectLink(application, location.hash);
    };
    addEventListener("hashchange", inspect);
    inspect();
}

/// Opens a dialog with a field for a link or the text of a QR code.
export function askForLink(application: Application): void {
    const dialog = openDialog("Open a link");
    const link = element("textarea", { rows: 4, id: "link-to-open", placeholder: "https://…#…" });
    dialog.body.append(field("A link, or the text of a QR code", link));
    dialog.footer.append(
        button(
            "Show its contents",
            () => {
                dialog.close();
                void inspectLink(application, link.value.trim());
            },
            { kind: "primary" },
        ),
    );
    link.focus();
}
