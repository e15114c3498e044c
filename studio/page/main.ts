// Starts the studio: the libraries, the work of the last visit, and the panels.
import { Application } from "./application";
import { watchBack } from "./back";
import { makeBenchPanel } from "./bench";
import { messageOf, type Engine, type Work } from "./context";
import { Controls } from "./controls";
import { Editor } from "./editor";
import { button, byId, element } from "./elements";
import { startWorkers } from "./engine";
import { makeExplanation } from "./explain";
import firstText from "./first.lsys";
import { makeGalleryPanel } from "./gallery";
import { givenEntries, openGiven } from "./given";
import { Guide } from "./guide";
import { applyTheme, makeLayout } from "./layout";
import libraryFacts from "library-facts";
import { makeMapPanel } from "./map";
import { acceptDrops } from "./open_file";
import panelStyles from "panel-styles";
import { Panels } from "./panels";
import { makePlayPanel } from "./play";
import { restoreScales } from "./scales";
import { watchLinks } from "./share";
import { makeSpacePanel } from "./space";
import { makeStepsPanel } from "./steps";
import { History, putAside } from "./store";
import { makeTools } from "./tools";
import { troubleOf } from "./trouble";
import { makeVariationsPanel } from "./variations";
import { view, viewedLink } from "./viewing";

const first: Work = {
    pattern: { name: "snake-kolam.lsys", text: firstText, variant: "", settings: [] },
    draw: [],
    play: [],
    place: null,
    panel: "map",
};

async function textsOfPatterns(engine: Engine): Promise<string[]> {
    const { bytes } = await engine.request({ do: "texts" });
    return new TextDecoder().decode(bytes).split("\0");
}

async function main(): Promise<void> {
    document.head.append(element("style", {}, panelStyles));
    applyTheme();
    makeLayout();
    const viewed = viewedLink(location.hash);
    const store = new History(first, viewed === null);
    const engine = startWorkers();
    const libraries = globalThis.sikkuLibraries.then((bytes) => WebAssembly.compile(bytes)).then((module) => engine.start(module));
    libraries.catch((error) => engine.fail(error));
    const application = new Application(engine, store);
    store.onUnsaved(() =>
        application.say(
            "The browser has no room to keep this work: a reload would lose it. Export the pattern to keep it.",
            "warning",
        ),
    );
    restoreScales(engine);
    application.help = libraryFacts.help;
    new Editor(application);
    new Controls(application);
    const panels = new Panels(application);
    if (viewed !== null) {
        await libraries;
        return showOnly(application, panels, viewed);
    }
    const given = givenEntries();
    if (given[0] && !store.history.some(({ work }) => work.pattern.text === given[0]!.text)) {
        openGiven(application, given[0].name);
    }
    // The picture does not wait for the texts of the patterns, which the other views need.
    const isMapFirst = store.work.panel === "map";
    if (isMapFirst) panels.build([makeMapPanel]);
    const opening = application.open();
    const [texts] = await Promise.all([textsOfPatterns(engine), libraries]);
    application.patterns = [...given, ...libraryFacts.patterns.map((entry, at) => ({ ...entry, text: texts[at]! }))];
    application.arrangements = libraryFacts.arrangements;
    panels.build([
        ...(isMapFirst ? [] : [makeMapPanel]),
        makeGalleryPanel,
        makeBenchPanel,
        makePlayPanel,
        makeVariationsPanel,
        makeStepsPanel,
        makeSpacePanel,
    ]);
    const guide = new Guide(application);
    byId("text").append(makeExplanation(() => guide.start()));
    makeTools(application, () => guide.start());
    acceptDrops(application);
    watchBack(application);
    if (!store.wasSaved && !given[0] && location.hash.length < 2) guide.welcome();
    await opening;
    if (byId("message").textContent === "Starting…") {
        const keys = matchMedia("(pointer: coarse)").matches ? "" : " Press ? for keyboard shortcuts.";
        application.say(store.wasSaved ? "" : `Edit the text or the values.${keys}`);
    }
    watchLinks(application);
}

// A page that only shows the work of a link.
async function showOnly(application: Application, panels: Panels, link: string): Promise<void> {
    try {
        await view(application, link, libraryFacts.help);
    } catch (error) {
        throw new Error(`the link cannot be read: ${messageOf(error)}`);
    }
    panels.build([makeMapPanel, makePlayPanel, makeStepsPanel, makeSpacePanel]);
    await application.open();
    if (application.hasErrors) byId("panels").append(element("p", { class: "note error" }, "The text of this pattern has errors."));
}

main().catch((error: unknown) => {
    const { sentence, isAboutWork } = troubleOf(error);
    byId("message").dataset["kind"] = "error";
    byId("message").textContent = sentence;
    const anew = button("Start without the saved work", () => {
        putAside();
        location.reload();
    });
    const note = element("div", { class: "broken", role: "alert" }, element("p", {}, sentence));
    if (isAboutWork && viewedLink(location.hash) === null) note.append(anew);
    byId("panels").replaceChildren(note);
});
