// Sends the melody to connected MIDI instruments, if the browser supports it.
import { button, checkbox, element, field, labelled } from "../elements";
import type { Player } from "./player";

export function makeMidiMenu(player: Player): HTMLElement {
    const note = element(
        "p",
        { class: "play-hint", role: "status" },
        "Sends notes, clock, start and stop to a connected instrument or another program.",
    );
    const ports = element("select", { id: "play-midi-port" }, element("option", { value: "" }, "None"));
    const alone = checkbox(() => apply(), { checked: true });
    const clock = checkbox(() => apply(), { checked: true });
    const settings = element(
        "div",
        { class: "play-midi", hidden: true },
        field("MIDI output", ports),
        labelled(clock, "Send clock, start and stop"),
        labelled(alone, "Mute the sound of this page"),
    );
    let access: MIDIAccess | null = null;

    const apply = (): void => {
        const port = access?.outputs.get(ports.value) ?? null;
        player.setMidi(port, alone.checked, clock.checked);
    };
    const list = (): void => {
        const chosen = ports.value;
        const outputs = access ? [...access.outputs.values()].filter((port) => port.state === "connected") : [];
        ports.replaceChildren(
            element("option", { value: "" }, "None"),
            ...outputs.map((port) => element("option", { value: port.id }, port.name || "Unnamed output")),
        );
        ports.value = outputs.some((port) => port.id === chosen) ? chosen : "";
        if (ports.value !== chosen) apply();
        note.textContent = outputs.length === 0 ? "No MIDI output is connected." : "";
    };
    const connect = button("Connect MIDI", async () => {
        try {
            access = await navigator.requestMIDIAccess();
        } catch {
            note.textContent =
                "The browser has blocked MIDI. Allow it in the settings of this page, then connect again.";
            return;
        }
        access.onstatechange = list;
        connect.hidden = true;
        settings.hidden = false;
        list();
        ports.focus();
    });
    ports.addEventListener("change", apply);
    if (!("requestMIDIAccess" in navigator)) {
        connect.disabled = true;
        note.textContent = "This browser does not support MIDI. Save the melody as a MIDI file instead.";
    }
    return element("div", { class: "play-section" }, connect, settings, note);
}
