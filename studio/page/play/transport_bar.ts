// Play, stop, loop, tempo, volume, and the current position.
import { button, element, icon, slideTo } from "../elements";
import type { Melody } from "../sound/melody";
import { barAt, barsOf, barStart, placeText } from "../sound/melody";
import type { Loop } from "../sound/transport";
import { remember, remembered } from "../storage";
import type { Player } from "./player";

const icons = {
    play: "M5 3v10l8-5z",
    pause: "M5 3.5v9M11 3.5v9",
    stop: "M4 4h8v8H4z",
    loop: "M3 8V7a3 3 0 0 1 3-3h6.5M10.5 2l2 2-2 2M13 8v1a3 3 0 0 1-3 3H3.5M5.5 14l-2-2 2-2",
};
const slowest = 20; // of the slider; the field accepts other values
const fastest = 300;
const volume_key = "sikku-volume";

function timeText(seconds: number): string {
    const whole = Math.max(0, Math.round(seconds));
    const two = (value: number): string => String(value).padStart(2, "0");
    const minutes = Math.floor(whole / 60);
    const hours = Math.floor(minutes / 60);
    return hours > 0 ? `${hours}:${two(minutes % 60)}:${two(whole % 60)}` : `${minutes}:${two(whole % 60)}`;
}

function barField(label: string): HTMLInputElement {
    return element("input", { type: "number", min: 1, "aria-label": label, class: "play-bar-number number" });
}

export interface TransportActs {
    seek(tick: number): void;
    tempo(value: number | null): void; // null: as written
    looped(loop: Loop | null): void;
}

export class TransportBar {
    readonly element: HTMLElement;
    readonly position = element("input", {
        type: "range",
        class: "play-position",
        min: 0,
        max: 1,
        step: 1,
        value: 0,
        "aria-label": "Position",
    });
    private readonly play = button("Play", () => void this.player.toggle(), {
        kind: "primary play-main",
        icon: icons.play,
    });
    private readonly stop = button("Stop and return to the beginning", () => this.player.stop(), { icon: icons.stop });
    private readonly loop = button("Loop", () => this.setLooping(!this.isLooping), { icon: icons.loop });
    private readonly from = barField("Loop from bar");
    private readonly to = barField("Loop to bar");
    private readonly range = element("span", { class: "play-loop", hidden: true }, "bars ", this.from, " to ", this.to);
    private readonly place = element("p", { class: "play-place" });
    private readonly time = element("p", { class: "play-time number" });
    private readonly tempo = element("input", { type: "range", id: "play-tempo", min: slowest, max: fastest, step: 1 });
    private tempoText = ""; // the tempo that is played
    private readonly tempoField = element("input", {
        type: "text",
        inputmode: "numeric",
        "aria-label": "Tempo, quarter notes per minute",
        class: "number",
    });
    private readonly volume = element("input", { type: "range", id: "play-volume", min: 0, max: 100, step: 1 });
    private isLooping = false;
    private bars: [number, number] = [1, 4];

    constructor(
        private readonly player: Player,
        private readonly acts: TransportActs,
    ) {
        const where = element("div", { class: "play-where" }, this.place, this.time);
        const tempoLabel = element("label", { for: "play-tempo" }, "Tempo");
        const volumeLabel = element("label", { for: "play-volume" }, "Volume");
        const tempo = element("div", { class: "slider play-tempo" }, tempoLabel, this.tempo, this.tempoField);
        const volume = element("div", { class: "slider play-volume" }, volumeLabel, this.volume);
        this.element = element(
            "div",
            { class: "play-head" },
            element("div", { class: "play-transport" }, this.play, this.stop, this.loop, this.range, where),
            element("div", { class: "play-levels" }, tempo, volume),
        );
        this.listen();
        const loudness = remembered<number>(volume_key, player.volume);
        if (loudness >= 0 && loudness <= 1) player.setVolume(loudness);
        this.showVolume();
    }

    private listen(): void {
        const { player, acts } = this;
        this.position.addEventListener("input", () => {
            if (player.melody) acts.seek(this.position.valueAsNumber * player.melody.beat);
        });
        this.position.addEventListener("keydown", (event) => {
            const { melody } = player;
            const bars = { PageUp: -1, PageDown: 1 }[event.key];
            if (!melody || bars === undefined) return;
            event.preventDefault();
            acts.seek(barStart(melody, Math.max(0, Math.round(barAt(melody, player.place()) + bars))));
        });
        this.tempo.addEventListener("input", () => acts.tempo(this.tempo.valueAsNumber));
        this.tempo.addEventListener("dblclick", () => acts.tempo(null));
        this.tempoField.addEventListener("change", () => {
            const text = this.tempoField.value.trim();
            const value = Number(text);
            // An empty field restores the tempo of the pattern; an invalid one keeps the last tempo.
            if (text === "" && !this.tempoField.validity.badInput) acts.tempo(null);
            else if (value > 0 && Number.isFinite(value)) acts.tempo(Math.min(600, Math.max(5, value)));
            this.tempoField.value = this.tempoText;
        });
        this.volume.addEventListener("input", () => {
            player.setVolume(this.volume.valueAsNumber / 100);
            this.showVolume();
            remember(volume_key, player.volume);
        });
        for (const field of [this.from, this.to]) field.addEventListener("change", () => this.readRange());
    }

    private readRange(): void {
        const { melody } = this.player;
        if (!melody) return;
        const bars = barsOf(melody);
        const place = (field: HTMLInputElement, old: number): number => {
            const number = Math.round(Number(field.value));
            return field.value.trim() === "" || Number.isNaN(number) ? old : number + 1 - melody.firstBar;
        };
        const from = Math.min(bars, Math.max(1, place(this.from, this.bars[0])));
        const to = Math.min(bars, Math.max(from, place(this.to, this.bars[1])));
        this.bars = [from, to];
        this.applyLoop();
    }

    private setLooping(isLooping: boolean): void {
        const { melody } = this.player;
        if (isLooping && melody) {
            // Four bars from the current position, unless it is in the chosen range.
            const bar = Math.min(barsOf(melody), Math.floor(barAt(melody, this.player.place())) + 1);
            const [from, to] = this.bars;
            if (bar < from || bar > to) this.bars = [bar, Math.min(barsOf(melody), bar + 3)];
        }
        this.isLooping = isLooping;
        this.applyLoop();
    }

    /// Sets the range that was dragged over the bars.
    setLoop(loop: Loop): void {
        const { melody } = this.player;
        if (!melody) return;
        this.bars = [Math.round(barAt(melody, loop.from)) + 1, Math.ceil(barAt(melody, loop.to) - 1e-6)];
        this.isLooping = true;
        this.applyLoop();
    }

    private applyLoop(): void {
        const { melody, transport } = this.player;
        const [from, to] = this.bars;
        const range = melody && { from: barStart(melody, from - 1), to: Math.min(barStart(melody, to), melody.end) };
        const loop = this.isLooping ? range : null;
        transport.setLoop(loop);
        this.loop.setAttribute("aria-pressed", String(this.isLooping));
        this.range.hidden = !this.isLooping;
        const beforeFirst = (melody?.firstBar ?? 1) - 1;
        this.from.value = String(from + beforeFirst);
        this.to.value = String(to + beforeFirst);
        this.acts.looped(loop);
    }

    private showVolume(): void {
        const percent = Math.round(this.player.volume * 100);
        slideTo(this.volume, percent, `${percent} percent`);
    }

    /// Shows that there is nothing to play.
    clear(): void {
        this.place.textContent = "";
        this.time.textContent = "";
        this.position.max = "1";
        this.position.value = "0";
        this.position.style.setProperty("--at", "0%");
        this.position.removeAttribute("aria-valuetext");
    }

    showMelody(melody: Melody): void {
        const bars = barsOf(melody);
        if (this.bars[1] > bars) this.bars = [Math.min(this.bars[0], bars), bars];
        this.position.max = String(Math.max(1, Math.ceil(melody.end / melody.beat)));
        this.from.max = this.to.max = String(bars);
        this.applyLoop();
    }

    showTempo(tempo: number): void {
        this.tempoText = String(tempo);
        slideTo(this.tempo, tempo, `${tempo} quarter notes per minute`);
        if (document.activeElement !== this.tempoField) this.tempoField.value = String(tempo);
    }

    /// Shows whether the player is playing, and whether there is anything to play.
    update(): void {
        const { melody, transport, isStarting } = this.player;
        const isActive = transport.playing || isStarting;
        this.play.replaceChildren(icon(isActive ? icons.pause : icons.play));
        this.play.setAttribute("aria-label", isActive ? "Pause" : "Play");
        this.play.title = `${isActive ? "Pause" : "Play"} (space)`;
        const isEmpty = !melody || melody.count === 0;
        for (const each of [this.play, this.stop, this.loop]) each.disabled = isEmpty;
    }

    showPlace(melody: Melody, tick: number): void {
        const text = placeText(melody, tick);
        if (this.place.textContent !== text) this.place.textContent = text;
        const { transport } = this.player;
        const time = `${timeText(transport.secondsAt(tick))} / ${timeText(transport.secondsAt(melody.end))}`;
        if (this.time.textContent !== time) this.time.textContent = time;
        const tempo = Math.round(transport.tempoAt(tick) * 100) / 100;
        if (String(tempo) !== this.tempoText) this.showTempo(tempo);
        const beat = String(Math.round(tick / melody.beat));
        if (this.position.value !== beat) {
            this.position.value = beat;
            this.position.setAttribute("aria-valuetext", text);
        }
        this.position.style.setProperty("--at", `${(100 * Math.min(1, tick / melody.end)).toFixed(2)}%`);
    }
}
