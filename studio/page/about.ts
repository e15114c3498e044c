// About the studio: its version, and what it contains of others with their licences.
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
        element("p", {}, `Sikku ${application.help.version}. Sikku is Tamil for the knot of a kolam line.`),
        element(
            "p",
            {},
            "Everything happens in this page: it works without a network, and nothing leaves it. " +
                "Your work is kept in this browser only; links and files are how it travels.",
        ),
        element("p", {}, "MIT licence. The page contains:"),
        element("div", { class: "notices" }, ...rows),
    );
}
