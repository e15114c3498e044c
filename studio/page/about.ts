// About the studio: its version, and the third-party software that it contains, with licences.
import notices from "notices";
import type { Application } from "./application";
import { openDialog } from "./dialog";
import { element } from "./elements";

export function openAbout(application: Application): void {
    const dialog = openDialog("About the studio");
    const rows = notices.map(({ name, what, version, licence, text }) => {
        const title = [`${name} ${version}`.trim(), what, licence].filter(Boolean).join(" · ");
        return text
            ? element("details", {}, element("summary", {}, title), element("pre", {}, text))
            : element("p", {}, title);
    });
    dialog.body.append(
        element("p", {}, `Sikku ${application.help.version}. Sikku is the Tamil word for the knot of a kolam line.`),
        element(
            "p",
            {},
            "The page works without a network and sends no data. " +
                "Your work is saved only in this browser; use links and files to share it.",
        ),
        element("p", {}, "MIT licence. The page contains:"),
        element("div", { class: "notices" }, ...rows),
    );
}
