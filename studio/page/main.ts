// Starts the studio: the libraries, the work of the last visit, and the panels.
import { Application } from "./application";
import { makeBenchPanel } from "./bench";
import type { Work } from "./context";
import { Controls } from "./controls";
import { Editor } from "./editor";
import { byId } from "./elements";
import { startEngine } from "./engine";
import { makeGalleryPanel } from "./gallery";
import { applyTheme, makeLayout } from "./layout";
import { makeMapPanel } from "./map";
import { acceptDrops } from "./open_file";
import { openPattern } from "./opening";
import { Panels } from "./panels";
import { makePlayPanel } from "./play";
import type { Help, Options, PatternRequest, Patterns } from "./protocol";
import { restoreScales } from "./scales";
import { watchLinks } from "./share";
import { makeSpacePanel } from "./space";
import { History } from "./store";
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
    draw: [], play: [], place: null, panel: "map",
};

// Patterns that the program wrote into the page: `sikku studio PATTERN…`. Those of links have values and options.
function embedded(): Pick<Work, "pattern" | "draw" | "play">[] {
    type Entry = PatternRequest & { draw?: Options; play?: Options };
    const list = JSON.parse(byId("sikku-patterns").textContent ?? "[]") as Entry[];
    return list.map(({ name, text, variant = "", settings = [], draw = [], play = [] }) =>
        ({ pattern: { name, text, variant, settings }, draw: draw.filter(([option]) => option !== "window"), play }));
}

async function main(): Promise<void> {
    applyTheme();
    makeLayout();
    const store = new History(first);
    const engine = await startEngine();
    const application = new Application(engine, store);
    restoreScales(engine);
    new Editor(application);
    new Controls(application);
    for (const { pattern, draw, play } of embedded()) {
        if (pattern.text !== store.work.pattern.text) openPattern(application, pattern, "map", { draw, play });
    }
    const opening = application.open();
    const [patterns, help] = await Promise.all([
        engine.request<Patterns>({ do: "patterns" }), engine.request<Help>({ do: "help" }),
    ]);
    application.patterns = patterns.json.patterns;
    application.help = help.json;
    new Panels(application, [
        makeMapPanel, makeSpacePanel, makeVariationsPanel, makePlayPanel, makeBenchPanel, makeGalleryPanel,
    ]);
    makeTools(application);
    acceptDrops(application);
    await opening;
    if (byId("message").textContent === "Starting…") application.say("");
    watchLinks(application);
}

main().catch((error: unknown) => {
    byId("message").dataset["kind"] = "error";
    byId("message").textContent = `The studio could not start: ${String(error)}`;
});
