// The voices: colour, name, mute, solo, volume, timbre.
import { element, slideTo } from "../elements";
import { isDark } from "../layout";
import { timbreNamed, timbres } from "../sound/timbres";
import type { Player, Voice } from "./player";
import { voiceColour } from "./voice_colours";

interface Row {
    element: HTMLElement;
    swatch: HTMLElement;
    name: HTMLElement;
    mute: HTMLButtonElement;
    solo: HTMLButtonElement;
    volume: HTMLInputElement;
    timbre: HTMLSelectElement;
    own: HTMLOptionElement;
}

export class VoiceList {
    readonly element = element("ul", { class: "play-voices", "aria-label": "Voices" });
    private rows: Row[] = [];

    constructor(private readonly player: Player) {}

    update(): void {
        const { voices } = this.player;
        while (this.rows.length > voices.length) this.rows.pop()!.element.remove();
        while (this.rows.length < voices.length) {
            const row = this.row(this.rows.length);
            this.rows.push(row);
            this.element.append(row.element);
        }
        voices.forEach((voice, index) => this.show(this.rows[index], voice, index));
    }

    private show(row: Row, voice: Voice, index: number): void {
        row.swatch.style.background = voiceColour(index, isDark());
        row.name.textContent = voice.name;
        row.element.classList.toggle("unheard", !this.player.isHeard(index));
        row.mute.setAttribute("aria-pressed", String(voice.muted));
        row.solo.setAttribute("aria-pressed", String(voice.solo));
        const percent = Math.round(voice.volume * 100);
        slideTo(row.volume, percent, `${percent} percent`);
        row.own.textContent = `As written: ${timbreNamed(this.player.instrumentOf(index)).label}`;
        row.timbre.value = voice.chosen;
        for (const [control, what] of [
            [row.mute, "Mute"],
            [row.solo, "Solo"],
            [row.volume, "Volume"],
            [row.timbre, "Timbre"],
        ] as const) {
            control.setAttribute("aria-label", `${what}, ${voice.name}`);
        }
    }

    private row(index: number): Row {
        const { player } = this;
        const swatch = element("span", { class: "play-swatch", "aria-hidden": "true" });
        const name = element("span", { class: "play-voice-name" });
        const mute = element("button", { type: "button", class: "play-toggle", title: "Mute" }, "M");
        const solo = element("button", { type: "button", class: "play-toggle", title: "Solo: only this voice" }, "S");
        const volume = element("input", { type: "range", min: 0, max: 100, step: 1, title: "Volume" });
        const own = element("option", { value: "" });
        const timbre = element(
            "select",
            { title: "Timbre" },
            own,
            ...timbres.map((each) => element("option", { value: each.name }, each.label)),
        );
        mute.addEventListener("click", () => player.change(index, { muted: !player.voices[index].muted }));
        solo.addEventListener("click", () => player.change(index, { solo: !player.voices[index].solo }));
        volume.addEventListener("input", () => player.change(index, { volume: volume.valueAsNumber / 100 }));
        volume.addEventListener("dblclick", () => player.change(index, { volume: 0.8 }));
        timbre.addEventListener("change", () => player.change(index, { chosen: timbre.value }));
        const row = element("li", { class: "play-voice" }, swatch, name, mute, solo, timbre, volume);
        return { element: row, swatch, name, mute, solo, volume, timbre, own };
    }
}
