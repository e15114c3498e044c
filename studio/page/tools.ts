// The buttons in the top bar, and their keyboard shortcuts.
import { openAbout } from "./about";
import type { Application } from "./application";
import { menuButton } from "./dialog";
import { button, byId, element } from "./elements";
import { openExport } from "./export";
import { makeHistory } from "./history_panel";
import { setTheme, theme, type Theme } from "./layout";
import { askForFile } from "./open_file";
import { openPattern } from "./opening";
import { titleOf } from "./pattern_text";
import { askForLink, openShare } from "./share";
import { listen, openShortcuts, shown, type Shortcut } from "./shortcuts";

const icons = {
    undo: "M3 6h6.5a3.5 3.5 0 0 1 0 7H6M3 6l3-3M3 6l3 3",
    redo: "M13 6H6.5a3.5 3.5 0 0 0 0 7H10M13 6l-3-3M13 6l-3 3",
    history: "M8 4.5V8l2.5 1.5M2.8 6A5.5 5.5 0 1 1 2.5 8M2.5 3v3h3",
    open: "M2 12.5v-9h4l1.5 2H14v7zM2 7.5h12",
    share: "M8 9.5v-7M5.2 5 8 2.2 10.8 5M3.5 8v5.5h9V8",
    more: "M3.5 8h.01M8 8h.01M12.5 8h.01",
};

const empty_pattern = `title: A curve of mine
derivation length: 4
angle factor: 4
axiom: X
X --> -YF+XFX+FY-
Y --> +XF-YFY-FX+

ground: #8c3b2a
stroke: 0.3 step #fffaf0
`;

function shortcutsOf(application: Application): Shortcut[] {
    const { store } = application;
    const stepN = (by: number) => {
        const n = Number(application.opened?.facts.n ?? "0") + by;
        if (n >= 0) store.setting("derivation length", String(n), "setting derivation length");
    };
    const tabs = [...document.querySelectorAll<HTMLElement>("#tabs .tab")];
    return [
        { keys: "Ctrl+Z", label: "Undo", act: () => store.undo() },
        { keys: "Ctrl+Shift+Z", label: "Redo", act: () => store.redo() },
        { keys: "Ctrl+Y", label: "Redo", act: () => store.redo() },
        { keys: "Ctrl+O", label: "Open a file", act: () => askForFile(application), everywhere: true },
        { keys: "Ctrl+S", label: "Export", act: () => openExport(application), everywhere: true },
        { keys: "Alt+Up", label: "Increase n", act: () => stepN(1) },
        { keys: "Alt+Down", label: "Decrease n", act: () => stepN(-1) },
        ...tabs.map((tab, at): Shortcut => ({
            keys: `Alt+${at + 1}`,
            label: tab.textContent ?? "",
            everywhere: true,
            act: () => {
                tab.click();
                tab.focus();
            },
        })),
        {
            keys: "Alt+T",
            label: "Go to the text",
            everywhere: true,
            act: () => document.querySelector<HTMLElement>(".cm-content")?.focus(),
        },
        { keys: "Ctrl+Space", label: "Complete a key (in the text)" },
        { keys: "F1", label: "Explain the key or symbol at the cursor (in the text)" },
        { keys: "F12", label: "Go to the definition of the name at the cursor (in the text)" },
        { keys: "F2", label: "Rename the name at the cursor everywhere (in the text)" },
        { keys: "F8", label: "Next error (in the text)" },
        { keys: "Ctrl+F", label: "Search (in the text)" },
        { keys: "?", label: "Show this list", act: () => openShortcuts(shortcutsOf(application)) },
    ];
}

/// @param guide  shows the guided start
export function makeTools(application: Application, guide: () => void): void {
    const { store } = application;
    const shortcuts = shortcutsOf(application);
    const undo = button(`Undo (${shown("Ctrl+Z")})`, () => store.undo(), { kind: "quiet", icon: icons.undo });
    const redo = button(`Redo (${shown("Ctrl+Shift+Z")})`, () => store.redo(), { kind: "quiet", icon: icons.redo });
    const steps = button("History", () => {}, { kind: "quiet", icon: icons.history });
    const open = button("Open", () => {}, { icon: icons.open, shows: true });
    const share = button("Share", () => openShare(application), { icon: icons.share, shows: true });
    const save = button("Export", () => openExport(application), { kind: "primary" });
    const more = button("More", () => {}, { kind: "quiet", icon: icons.more });
    byId("tools").append(undo, redo, steps, element("span", { class: "gap" }), open, share, save, more);

    makeHistory(application, steps);
    menuButton(open, () => [
        {
            label: "New pattern",
            act: () => openPattern(application, { name: "mine.lsys", text: empty_pattern, variant: "", settings: [] }),
        },
        { label: "A bundled pattern…", act: () => store.change({ panel: "gallery" }) },
        { label: "A file…", detail: shown("Ctrl+O"), act: () => askForFile(application) },
        { label: "A link…", act: () => askForLink(application) },
    ]);
    const themes: [Theme, string][] = [["system", "System colours"], ["light", "Light"], ["dark", "Dark"]];
    menuButton(more, () => [
        ...themes.map(([name, label]) => ({ label, detail: theme() === name ? "✓" : "", act: () => setTheme(name) })),
        null,
        { label: "Guided start", act: guide },
        { label: "Keyboard", detail: "?", act: () => openShortcuts(shortcuts) },
        { label: "About the studio", act: () => openAbout(application) },
    ]);

    const refresh = () => {
        undo.disabled = store.position === 0;
        redo.disabled = store.position === store.history.length - 1;
        const title = titleOf(store.work.pattern);
        byId("work-title").textContent = title;
        document.title = `${title} · Sikku studio`;
    };
    store.watch(refresh);
    refresh();
    listen(shortcuts);
}
