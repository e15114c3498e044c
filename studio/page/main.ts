// Starts the studio: the libraries, the work of the last visit, and the panels.
import { Application } from "./application";
import { makeBenchPanel } from "./bench";
import type { Work } from "./context";
import { Controls } from "./controls";
import { Editor } from "./editor";
import { button, byId, element } from "./elements";
import { startEngine } from "./engine";
import { makeGalleryPanel } from "./gallery";
import { givenEntries, openGiven } from "./given";
import { applyTheme, makeLayout } from "./layout";
import { makeMapPanel } from "./map";
import { acceptDrops } from "./open_file";
import panelStyles from "panel-styles";
import { Panels } from "./panels";
import { makePlayPanel } from "./play";
import type { Arrangements, Help, Patterns } from "./protocol";
import { restoreScales } from "./scales";
import { watchLinks } from "./share";
import { makeSpacePanel } from "./space";
import { makeStepsPanel } from "./steps";
import { History, putAside } from "./store";
import { makeTools } from "./tools";
import { makeVariationsPanel } from "./variations";

const first_text = `title: Snake kolam
source: Prusinkiewicz & Hanan 1989, figure 6.2

derivation length: 4
angle factor: 4
axiom: f+Xf+f+Xf
X --> Xf-f-f+Xf+f+Xf-f-f+X

ground: #8c3b2a
stroke: 0.22 step #fffaf0
line: spline
`;

const first: Work = {
    pattern: { name: "snake-kolam.lsys", text: first_text, variant: "", settings: [] },
    draw: [],
    play: [],
    place: null,
    panel: "map",
};

async function main(): Promise<void> {
    document.head.append(element("style", {}, panelStyles));
    applyTheme();
    makeLayout();
    const store = new History(first);
    const engine = await startEngine();
    const application = new Application(engine, store);
    store.onUnsaved(() =>
        application.say(
            "The browser has no room to keep this work: a reload would lose it. Export the pattern to keep it.",
            "warning",
        ),
    );
    restoreScales(engine);
    new Editor(application);
    new Controls(application);
    const given = givenEntries();
    if (given[0] && !store.history.some(({ work }) => work.pattern.text === given[0]!.text)) {
        openGiven(application, given[0].name);
    }
    const opening = application.open();
    const [patterns, arrangements, help] = await Promise.all([
        engine.request<Patterns>({ do: "patterns" }),
        engine.request<Arrangements>({ do: "arrangements" }),
        engine.request<Help>({ do: "help" }),
    ]);
    application.patterns = [...given, ...patterns.json.patterns];
    application.arrangements = arrangements.json.arrangements;
    application.help = help.json;
    new Panels(application, [
        makeMapPanel,
        makeGalleryPanel,
        makeBenchPanel,
        makePlayPanel,
        makeVariationsPanel,
        makeStepsPanel,
        makeSpacePanel,
        makeVariationsPanel,
        makePlayPanel,
        makeBenchPanel,
        makeGalleryPanel,
    ]);
    makeTools(application);
    acceptDrops(application);
    await opening;
    if (byId("message").textContent === "Starting…") {
        application.say(store.wasSaved ? "" : "Edit the text or the values. Press ? for keyboard shortcuts.");
    }
    watchLinks(application);
}

main().catch((error: unknown) => {
    byId("message").dataset["kind"] = "error";
    byId("message").textContent = `The studio could not start: ${String(error)}`;
    const anew = button("Start without the saved work", () => {
        putAside();
        location.reload();
    });
    byId("panels").replaceChildren(element("div", { class: "empty" }, anew));
});
