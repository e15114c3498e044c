// Starts the studio: the libraries, the work of the last visit, and the panels.
import { Application } from "./application";
import { makeBenchPanel } from "./bench";
import type { Work } from "./context";
import { startEngine } from "./engine";
import { makeGalleryPanel } from "./gallery";
import { makeMapPanel } from "./map";
import { Panels } from "./panels";
import { makePlayPanel } from "./play";
import type { Help, Patterns } from "./protocol";
import { makeSpacePanel } from "./space";
import { History } from "./store";
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

async function main(): Promise<void> {
    const store = new History(first);
    const engine = await startEngine();
    const application = new Application(engine, store);
    const [patterns, help] = await Promise.all([
        engine.request<Patterns>({ do: "patterns" }), engine.request<Help>({ do: "help" }),
    ]);
    application.patterns = patterns.json.patterns;
    application.help = help.json;
    new Panels(application, [
        makeMapPanel, makeSpacePanel, makeVariationsPanel, makePlayPanel, makeBenchPanel, makeGalleryPanel,
    ]);
    void application.open();
}

void main();
