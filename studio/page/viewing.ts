// Links that end in `&view=only` show a picture, a model or a melody without the editor, for a frame in another page.
import type { Application } from "./application";
import { titleOfArrangement } from "./arrangements";
import { element } from "./elements";
import { readArrangement, readPlace, unknownOptions } from "./link_contents";
import { withOption } from "./options";
import { titleOf } from "./pattern_text";
import type { Help, ReadLink } from "./protocol";

const view_only = /&view=only(?=&|$)/;
const shown = ["map", "space", "play", "steps"]; // views that make sense alone

/// The link of a page that only shows; null for the whole studio.
export function viewedLink(hash: string): string | null {
    return view_only.test(hash) ? linkIn(hash) : null;
}

/// The link in an address or a fragment, without `#` and what follows an `&`.
export function linkIn(address: string): string {
    return address.replace(/^.*#/s, "").replace(/&.*$/s, "");
}

/// The code that shows a link in another page.
export function frameFor(link: string, title: string): string {
    const escaped = title.replaceAll("&", "&amp;").replaceAll('"', "&quot;").replaceAll("<", "&lt;");
    return `<iframe src="${link}&amp;view=only" title="${escaped}" width="640" height="480" loading="lazy"></iframe>`;
}

/// Makes the contents of the link the work. The page draws at once, because a pattern is only data; commands for
/// plotters have no effect here. @throws Error if the link cannot be read
export async function view(application: Application, link: string, help: Help): Promise<void> {
    document.documentElement.dataset["view"] = "only";
    addEventListener("hashchange", () => location.reload());
    const { json } = await application.engine.request<ReadLink>({ do: "read_link", link });
    const { pattern, draw = [], play = [], page = {} } = json.shared;
    if (unknownOptions(json.shared, help).length > 0) throw new Error("the link is of a later version");
    const panel = shown.includes(page["panel"] ?? "") ? page["panel"]! : "map";
    const arrangement = readArrangement(page["arrangement"]);
    application.store.change({
        arrangement,
        pattern: { variant: "", settings: [], ...pattern },
        draw: withOption(draw, "window", null),
        play,
        place: readPlace(page["place"]),
        panel,
    });
    const title = panel === "play" && arrangement ? titleOfArrangement(arrangement) : titleOf(pattern);
    document.title = title;
    const whole = location.href.replace(view_only, "");
    const there = { class: "view-link", href: whole, target: "_blank", rel: "noopener", title: "Open in the studio" };
    document.body.append(element("footer", {}, element("a", there, element("span", {}, title), " · Sikku")));
}
