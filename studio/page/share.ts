// Makes a link with a QR code, and inspects links before they are opened.
import { generate } from "lean-qr";
import type { Application } from "./application";
import { RequestFailed, type Work } from "./context";
import { openDialog } from "./dialog";
import { button, element } from "./elements";
import { count } from "./numbers_shown";
import { drawOptions, windowOnScreen } from "./on_screen";
import { openPattern } from "./opening";
import { titleOf } from "./pattern_text";
import type { Link, PatternRequest, ReadLink, Shared } from "./protocol";

const quiet_zone = 4; // white modules around a code
const code_width = 280; // pixels, reduced to whole pixels per module

const isServed = () => /^https?:$/.test(location.protocol);

function shared(application: Application, withView: boolean): Shared {
    const { pattern, draw, play, place, panel, locked } = application.store.work;
    const page: Record<string, string> = { panel };
    if (withView && place) page["place"] = JSON.stringify(place);
    if (locked?.length) page["locked"] = JSON.stringify(locked);
    return { pattern, draw: withView ? drawOptions(application, true) : draw, play, page };
}

export function openShare(application: Application): void {
    const dialog = openDialog("Share");
    const address = element("textarea", { readonly: true, rows: 4, "aria-label": "Link", spellcheck: "false" });
    const facts = element("p", { role: "status" });
    const code = element("canvas", { class: "code", role: "img", "aria-label": "QR code of the link" });
    const hasView = windowOnScreen(application) !== null;
    const box = element("input", { type: "checkbox" });
    box.checked = hasView;
    const view = element("label", { class: "switch" }, box, "Include the current view");
    view.hidden = !hasView;
    const copy = button("Copy the link", () => void copyText(application, address), { kind: "primary" });

    const make = async () => {
        try {
            const { json } = await application.engine.request<Link>(
                { do: "link", shared: shared(application, box.checked) },
                { key: "link" },
            );
            const link = `${location.href.replace(/#.*$/s, "")}#${json.link}`;
            address.value = link;
            showCode(code, facts, isServed() ? link : `#${json.link}`);
        } catch (error) {
            facts.textContent = error instanceof RequestFailed ? error.failure.message : String(error);
        }
    };
    box.addEventListener("change", () => void make());
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
            ),
        ),
    );
    dialog.footer.append(copy);
    copy.focus();
    void make();
}

async function copyText(application: Application, field: HTMLTextAreaElement): Promise<void> {
    try {
        await navigator.clipboard.writeText(field.value);
    } catch {
        // pages from files may have no access to the clipboard
        field.select();
        document.execCommand("copy");
    }
    application.say("The link was copied.");
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

function readPlace(text: string | undefined): Work["place"] {
    try {
        const place = JSON.parse(text ?? "null") as Work["place"];
        return place && typeof place.x === "string" && typeof place.y === "string" && place.scale > 0 ? place : null;
    } catch {
        return null;
    }
}

/// Shows the contents of a link. Nothing is derived or drawn before the user opens it.
export async function inspectLink(application: Application, link: string): Promise<void> {
    let contents: Shared;
    try {
        contents = (await application.engine.request<ReadLink>({ do: "read_link", link: link.replace(/^.*#/s, "") }))
            .json.shared;
    } catch (error) {
        application.say(
            `The link cannot be read: ${error instanceof RequestFailed ? error.failure.message : String(error)}`,
            "error",
        );
        forget();
        return;
    }
    const { pattern } = contents;
    const dialog = openDialog("This link contains a pattern", { closed: forget });
    dialog.body.append(
        element(
            "p",
            {},
            element("strong", {}, titleOf(pattern)),
            ". Nothing has been derived yet. A pattern is only data: it can draw and play, nothing else.",
        ),
        element("pre", { class: "link-text", tabindex: 0, "aria-label": "Text of the pattern" }, pattern.text),
        ...values(contents, pattern),
    );
    const open = button(
        "Open",
        () => {
            dialog.close();
            const { draw = [], play = [], page = {} } = contents;
            openPattern(application, { variant: "", settings: [], ...pattern }, page["panel"] ?? "map", {
                draw: draw.filter(([name]) => name !== "window"),
                play,
                place: readPlace(page["place"]),
            });
        },
        { kind: "primary" },
    );
    dialog.footer.append(
        button("Discard", () => dialog.close()),
        open,
    );
    open.focus();
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
            { class: "link-values" },
            ...rows.map(([name, value]) => element("li", {}, element("code", {}, `${name}: ${value}`))),
        ),
    ];
}

// Removes the link from the address, so that a reload does not show it again.
function forget(): void {
    if (location.hash) history.replaceState(null, "", location.href.replace(/#.*$/s, ""));
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
    const field = element("textarea", { rows: 4, id: "link-to-open", placeholder: "https://…#…" });
    dialog.body.append(
        element(
            "div",
            { class: "field" },
            element("label", { for: field.id }, "A link, or the text of a QR code"),
            field,
        ),
    );
    dialog.footer.append(
        button(
            "Show its contents",
            () => {
                dialog.close();
                void inspectLink(application, field.value.trim());
            },
            { kind: "primary" },
        ),
    );
    field.focus();
}
