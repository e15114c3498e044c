// The melody of the pattern: transport, the curve and the piano roll as they sound, voices, MIDI.
import type { MakePanel, Panel, Studio, Work } from "./context";
import { RequestFailed } from "./context";
import { button, element, icon } from "./elements";
import { offered, optionField } from "./option_fields";
import { CurveView } from "./play/curve_view";
import { makeMidiMenu } from "./play/midi_menu";
import { Player } from "./play/player";
import { remediesFor, withMovesDrawn } from "./play/remedies";
import { RollView } from "./play/roll_view";
import { VoiceList } from "./play/voice_list";
import type { Made, Notes, Opened, Options } from "./protocol";
import type { Melody } from "./sound/melody";
import { barsOf, firstFrom, keyName, placeText, readMelody } from "./sound/melody";
import { NoteOrigins } from "./sound/origins";
import type { Loop } from "./sound/transport";

const icons = {
    play: "M5 3v10l8-5z",
    pause: "M5 3.5v9M11 3.5v9",
    stop: "M4 4h8v8H4z",
    loop: "M3 8V7a3 3 0 0 1 3-3h6.5M10.5 2l2 2-2 2M13 8v1a3 3 0 0 1-3 3H3.5M5.5 14l-2-2 2-2",
    closer: "M7 3v8M3 7h8M14 14l-3.5-3.5",
    wider: "M3 7h8M14 14l-3.5-3.5",
    save: "M8 2v8M5 7.5L8 10.5l3-3M3 13h10",
};
const half_frame = 0.008; // seconds
/// Options that change how the curve is read.
const reading = [
    "scale",
    "tonic",
    "instrument",
    "unit",
    "meter",
    "mapping",
    "vertical",
    "runs",
    "velocity",
    "range",
    "transpose",
    "bars",
];

function timeText(seconds: number): string {
    const whole = Math.max(0, Math.round(seconds));
    const minutes = Math.floor(whole / 60);
    const rest = String(whole % 60).padStart(2, "0");
    return minutes < 60
        ? `${minutes}:${rest}`
        : `${Math.floor(minutes / 60)}:${String(minutes % 60).padStart(2, "0")}:${rest}`;
}

class PlayPanel implements Panel {
    readonly name = "play";
    readonly label = "Play";
    readonly element = element("div", { class: "play" });

    private readonly player: Player;
    private readonly origins: NoteOrigins;
    private readonly curve: CurveView;
    private readonly roll: RollView;
    private readonly voices: VoiceList;
    private isShown = false;
    private isStale = true; // the melody belongs to an older work
    private loaded = ""; // what it was made from
    private heardName = ""; // of the pattern whose melody is shown
    private playsMoves = ""; // the name of the pattern whose moves are played as if they were drawn
    private frame = 0;
    private litNote = -1;
    private isLooping = false;
    private loopBars: [number, number] = [1, 4];

    private readonly playButton = button("Play", () => void this.player.toggle(), {
        kind: "primary play-main",
        icon: icons.play,
    });
    private readonly stopButton = button("Stop, and go to the beginning", () => this.player.stop(), {
        icon: icons.stop,
    });
    private readonly loopButton = button("Loop", () => this.setLooping(!this.isLooping), { icon: icons.loop });
    private readonly loopFrom = element("input", {
        type: "number",
        min: 1,
        "aria-label": "Loop from bar",
        class: "play-bar-number number",
    });
    private readonly loopTo = element("input", {
        type: "number",
        min: 1,
        "aria-label": "Loop to bar",
        class: "play-bar-number number",
    });
    private readonly loopRange = element(
        "span",
        { class: "play-loop", hidden: true },
        "bars ",
        this.loopFrom,
        " to ",
        this.loopTo,
    );
    private readonly placeLine = element("p", { class: "play-place" });
    private readonly timeLine = element("p", { class: "play-time number" });
    private readonly position = element("input", {
        type: "range",
        class: "play-position",
        min: 0,
        max: 1,
        step: 1,
        value: 0,
        "aria-label": "Position",
    });
    private readonly tempo = element("input", { type: "range", id: "play-tempo", min: 20, max: 300, step: 1 });
    private readonly tempoField = element("input", {
        type: "text",
        inputmode: "numeric",
        "aria-label": "Tempo, quarters a minute",
        class: "number",
    });
    private readonly volume = element("input", { type: "range", id: "play-volume", min: 0, max: 100, step: 1 });
    private readonly hover = element("p", { class: "play-hover", "aria-hidden": "true" });
    private readonly problem = element("div", { class: "note error play-problem", role: "alert", hidden: true });
    private readonly curveCanvas = element("canvas", {
        class: "play-curve-canvas",
        role: "img",
        "aria-label": "The curve as it sounds",
    });
    private readonly rollCanvas = element("canvas", {
        class: "play-roll-canvas",
        role: "img",
        "aria-label": "Piano roll",
    });
    private readonly facts = element("p", { class: "play-facts" });
    private readonly reading = element("div", { class: "play-reading" });

    constructor(private readonly studio: Studio) {
        this.player = new Player(studio);
        this.origins = new NoteOrigins(studio.engine);
        this.voices = new VoiceList(this.player);
        this.curve = new CurveView(this.curveCanvas, () => this.redraw());
        this.roll = new RollView(this.rollCanvas, {
            seek: (tick) => this.seek(tick),
            loop: (loop) => this.dragLoop(loop),
            point: (text) => this.point(text),
            redraw: () => this.redraw(),
        });
        this.build();
        this.listen();
        this.player.onChange = () => this.update();
        this.player.setVolume(remembered());
        this.showVolume();
    }

    private build(): void {
        const transport = element(
            "div",
            { class: "play-transport" },
            this.playButton,
            this.stopButton,
            this.loopButton,
            this.loopRange,
            element("div", { class: "play-where" }, this.placeLine, this.timeLine),
        );
        const tempo = element(
            "div",
            { class: "slider play-tempo" },
            element("label", { for: "play-tempo" }, "Tempo"),
            this.tempo,
            this.tempoField,
        );
        const volume = element(
            "div",
            { class: "slider play-volume" },
            element("label", { for: "play-volume" }, "Volume"),
            this.volume,
        );
        const zoom = element(
            "div",
            { class: "play-zoom" },
            button("See more bars", () => this.roll.zoom(1 / 1.5), { kind: "quiet", icon: icons.wider }),
            button("See fewer bars", () => this.roll.zoom(1.5), { kind: "quiet", icon: icons.closer }),
        );
        const save = button("Save as MIDI", () => void this.saveMidi(), { icon: icons.save, shows: true });
        const side = element(
            "aside",
            { class: "play-side", "aria-label": "Voices and settings" },
            this.voices.element,
            element("details", { class: "group" }, element("summary", {}, "How the curve becomes music"), this.reading),
            element("details", { class: "group" }, element("summary", {}, "MIDI out"), makeMidiMenu(this.player)),
            element("div", { class: "play-section" }, save, this.facts),
        );
        this.element.append(
            element("div", { class: "play-head" }, transport, element("div", { class: "play-levels" }, tempo, volume)),
            this.problem,
            element(
                "div",
                { class: "play-body" },
                element(
                    "div",
                    { class: "play-views" },
                    element("div", { class: "play-curve" }, this.curveCanvas, this.hover),
                    element("div", { class: "play-roll" }, this.rollCanvas, zoom),
                    this.position,
                ),
                side,
            ),
        );
    }

    private listen(): void {
        const { studio } = this;
        studio.onOpened((facts, work) => this.change(facts, work));
        studio.store.subscribe((work, before) => {
            if (work.play === before.play) return;
            this.applyTempo();
            if (studio.opened) this.change(studio.opened.facts, { ...studio.opened.work, play: work.play });
        });
        this.position.addEventListener("input", () => {
            const { melody } = this.player;
            if (melody) this.seek(this.position.valueAsNumber * melody.beat);
        });
        this.position.addEventListener("keydown", (event) => {
            const { melody } = this.player;
            const bars = { PageUp: -1, PageDown: 1 }[event.key];
            if (!melody || bars === undefined) return;
            event.preventDefault();
            this.seek(Math.round(this.player.place() / melody.bar + bars) * melody.bar);
        });
        this.tempo.addEventListener("input", () => this.setTempo(this.tempo.valueAsNumber));
        this.tempo.addEventListener("dblclick", () => this.setTempo(null));
        this.tempoField.addEventListener("change", () => {
            const value = Number(this.tempoField.value);
            this.setTempo(value > 0 ? Math.min(600, Math.max(5, value)) : null);
        });
        this.volume.addEventListener("input", () => {
            this.player.setVolume(this.volume.valueAsNumber / 100);
            this.showVolume();
            remember(this.player.volume);
        });
        for (const field of [this.loopFrom, this.loopTo]) {
            field.addEventListener("change", () => {
                const { melody } = this.player;
                if (!melody) return;
                const bars = barsOf(melody);
                const from = Math.min(bars, Math.max(1, Math.round(Number(this.loopFrom.value)) || 1));
                const to = Math.min(bars, Math.max(from, Math.round(Number(this.loopTo.value)) || from));
                this.loopBars = [from, to];
                this.applyLoop();
            });
        }
        this.curveCanvas.addEventListener("click", (event) => {
            const tick = this.curve.tickAt(event.offsetX, event.offsetY);
            if (tick !== null) this.seek(tick);
        });
        this.curveCanvas.addEventListener("pointermove", (event) => {
            const { melody } = this.player;
            if (!melody || melody.count > 200_000 || event.buttons !== 0) return;
            const tick = this.curve.tickAt(event.offsetX, event.offsetY);
            const note = tick === null ? -1 : firstFrom(melody, tick + 1e-6) - 1;
            this.point(tick === null || note < 0 ? null : `${placeText(melody, tick)}, ${keyName(melody.key[note])}`);
        });
        this.curveCanvas.addEventListener("pointerleave", () => this.point(null));
        document.addEventListener("keydown", (event) => this.press(event));
        new MutationObserver(() => {
            this.curve.reset();
            this.roll.reset();
            this.voices.update();
        }).observe(document.documentElement, { attributeFilter: ["data-theme"] });
    }

    private press(event: KeyboardEvent): void {
        if (
            !this.isShown
            || event.key !== " "
            || event.defaultPrevented
            || event.ctrlKey
            || event.metaKey
            || event.altKey
        )
            return;
        const target = event.target instanceof HTMLElement ? event.target : null;
        if (
            target
            && (target.isContentEditable
                || target.closest(
                    "button, a, select, summary, textarea, dialog, [role='tab'], input:not([type='range'])",
                ))
        )
            return;
        event.preventDefault();
        void this.player.toggle();
    }

    // --- the melody -----------------------------------------------------------------------------------------------

    private change(facts: Opened, work: Work): void {
        this.isStale = true;
        if (this.isShown || this.player.transport.playing) void this.load(facts, work);
    }

    private async load(facts: Opened, work: Work): Promise<void> {
        // The tempo changes no note.
        const isTimed = work.play.some(([name]) => name === "seconds");
        const options: Options = isTimed ? work.play : work.play.filter(([name]) => name !== "tempo");
        const pattern = this.played(work);
        const what = JSON.stringify([pattern, options]);
        if (what === this.loaded) {
            this.isStale = false;
            return;
        }
        this.element.setAttribute("aria-busy", "true");
        try {
            const { json, bytes } = await this.studio.engine.request<Notes>(
                { do: "notes", options, pattern },
                { key: "notes" },
            );
            this.loaded = what;
            this.isStale = false;
            this.problem.hidden = true;
            this.showMelody(readMelody(json, bytes), facts, work);
        } catch (error) {
            if (!(error instanceof RequestFailed)) return; // replaced by a later one
            this.loaded = what;
            this.isStale = false;
            this.showProblem(error.message, facts, work);
        } finally {
            this.element.removeAttribute("aria-busy");
        }
    }

    /// The pattern whose melody is heard.
    private played(work: Work): Work["pattern"] {
        return (this.playsMoves === work.pattern.name && withMovesDrawn(work.pattern)) || work.pattern;
    }

    private showProblem(message: string, facts: Opened, work: Work): void {
        const remedies = remediesFor(message, work.pattern, work.play).map(({ label, options, pattern }) =>
            button(label, () => {
                if (options) {
                    this.studio.store.change({ play: options });
                } else if (pattern) {
                    this.playsMoves = work.pattern.name;
                    void this.load(facts, work);
                }
            }),
        );
        this.problem.replaceChildren(
            element("p", {}, sentence(message)),
            element("div", { class: "toolbar" }, ...remedies),
        );
        this.problem.hidden = false;
    }

    private showMelody(melody: Melody, facts: Opened, work: Work): void {
        if (work.pattern.name !== this.heardName && !this.player.transport.playing) this.player.transport.seek(0);
        this.heardName = work.pattern.name;
        this.origins.reset(melody, this.played(work));
        this.player.setMelody(melody);
        this.curve.show(melody);
        this.roll.show(melody);
        this.litNote = -1;
        const bars = barsOf(melody);
        if (this.loopBars[1] > bars) this.loopBars = [Math.min(this.loopBars[0], bars), bars];
        this.position.max = String(Math.max(1, Math.ceil(melody.end / melody.beat)));
        this.loopFrom.max = this.loopTo.max = String(bars);
        const scales = [...new Set(melody.parts.map((part) => part.scale))].join("; ");
        const range =
            melody.count > 0 ? `, ${keyName(Math.round(melody.lowest))} to ${keyName(Math.round(melody.highest))}` : "";
        this.facts.textContent = `${melody.count.toLocaleString("en")} ${melody.count === 1 ? "note" : "notes"} in ${bars.toLocaleString(
            "en",
        )} ${bars === 1 ? "bar" : "bars"}${range}. ${scales}.`;
        this.applyTempo();
        this.applyLoop();
        this.showReading();
        this.curveCanvas.setAttribute(
            "aria-label",
            `The curve of ${facts.title || "the pattern"} as it sounds: ${this.facts.textContent}`,
        );
        this.rollCanvas.setAttribute("aria-label", `Piano roll: ${this.facts.textContent}`);
        this.update();
    }

    /// The fields of the options that change the notes.
    private showReading(): void {
        const { help, store } = this.studio;
        if (this.reading.contains(document.activeElement)) return;
        const rows = reading.flatMap((name) => offered(help.play.options).filter((option) => option.name === name));
        this.reading.replaceChildren(
            ...rows.map((option) => {
                const value = store.work.play.find(([name]) => name === option.name)?.[1];
                return optionField(option, value, (name, text) => this.setOption(name, text));
            }),
        );
    }

    private setOption(name: string, value: string | null, merge?: string): void {
        const { store } = this.studio;
        const others = store.work.play.filter(([each]) => each !== name);
        store.change({ play: value === null ? others : [...others, [name, value]] }, merge);
    }

    // --- the transport --------------------------------------------------------------------------------------------

    private seek(tick: number): void {
        this.player.seek(tick);
        this.redraw();
    }

    private setTempo(value: number | null): void {
        this.setOption("tempo", value === null ? null : String(value), value === null ? undefined : "tempo");
    }

    private applyTempo(): void {
        const chosen = Number(this.studio.store.work.play.find(([name]) => name === "tempo")?.[1]);
        const tempo = chosen > 0 ? chosen : (this.player.melody?.tempo ?? 120);
        this.player.transport.setTempo(tempo);
        this.tempo.valueAsNumber = tempo;
        this.tempo.style.setProperty("--at", `${((Math.min(300, Math.max(20, tempo)) - 20) / 280) * 100}%`);
        this.tempo.setAttribute("aria-valuetext", `${tempo} quarters a minute`);
        if (document.activeElement !== this.tempoField) this.tempoField.value = String(tempo);
        this.redraw();
    }

    private setLooping(isLooping: boolean): void {
        const { melody } = this.player;
        if (isLooping && melody && !this.isLooping) {
            // Four bars from where the music is, unless a range was chosen.
            const bar = Math.floor(this.player.place() / melody.bar) + 1;
            if (bar < this.loopBars[0] || bar > this.loopBars[1]) {
                this.loopBars = [bar, Math.min(barsOf(melody), bar + 3)];
            }
        }
        this.isLooping = isLooping;
        this.applyLoop();
    }

    private dragLoop(loop: Loop): void {
        const { melody } = this.player;
        if (!melody) return;
        this.loopBars = [Math.round(loop.from / melody.bar) + 1, Math.ceil(loop.to / melody.bar - 1e-6)];
        this.isLooping = true;
        this.applyLoop();
    }

    private applyLoop(): void {
        const { melody, transport } = this.player;
        const [from, to] = this.loopBars;
        const loop =
            this.isLooping && melody
                ? { from: (from - 1) * melody.bar, to: Math.min(to * melody.bar, melody.end) }
                : null;
        transport.setLoop(loop);
        this.roll.setLoop(loop);
        this.loopButton.setAttribute("aria-pressed", String(this.isLooping));
        this.loopRange.hidden = !this.isLooping;
        this.loopFrom.value = String(from);
        this.loopTo.value = String(to);
        this.redraw();
    }

    private showVolume(): void {
        const percent = Math.round(this.player.volume * 100);
        this.volume.value = String(percent);
        this.volume.style.setProperty("--at", `${percent}%`);
        this.volume.setAttribute("aria-valuetext", `${percent} percent`);
    }

    private async saveMidi(): Promise<void> {
        const { work } = this.studio.store;
        try {
            const { json, bytes } = await this.studio.engine.request<Made>(
                { do: "make", interpreter: "play", format: "mid", options: work.play, pattern: this.played(work) },
                { key: "midi file" },
            );
            const name = `${work.pattern.name.replace(/\.[^.]*$/, "") || "melody"}.mid`;
            this.studio.save(name, bytes, "audio/midi");
            const warning = json.remarks.find((remark) => remark.is_warning);
            this.studio.say(warning ? warning.text : `Saved ${name}.`, warning ? "warning" : "fact");
        } catch (error) {
            if (error instanceof RequestFailed) this.studio.say(error.message, "error");
        }
    }

    // --- what is seen ---------------------------------------------------------------------------------------------

    private point(text: string | null): void {
        this.hover.textContent = text ?? "";
    }

    /// After the player has started, stopped, or changed a voice.
    private update(): void {
        const { melody, transport } = this.player;
        const isPlaying = transport.playing;
        const isActive = isPlaying || this.player.isStarting;
        this.playButton.replaceChildren(icon(isActive ? icons.pause : icons.play));
        this.playButton.setAttribute("aria-label", isActive ? "Pause" : "Play");
        this.playButton.title = `${isActive ? "Pause" : "Play"} (space)`;
        for (const each of [this.playButton, this.stopButton, this.loopButton])
            each.disabled = !melody || melody.count === 0;
        this.voices.update();
        const muted = (voice: number) => !this.player.isHeard(voice);
        const state = this.player.voices.map((_, voice) => muted(voice)).join();
        if (state !== this.mutedState) {
            this.mutedState = state;
            this.curve.setMuted(muted);
            this.roll.setMuted(muted);
        }
        if (!isPlaying) {
            this.litNote = -1;
            this.studio.highlight(null);
        }
        this.redraw();
    }
    private mutedState = "";

    private redraw(): void {
        if (this.frame === 0) {
            this.frame = requestAnimationFrame(() => {
                this.frame = 0;
                this.draw();
            });
        }
    }

    private draw(): void {
        const { melody, transport } = this.player;
        if (!melody) return;
        const tick = this.player.place();
        if (transport.playing) this.light(melody, tick);
        let isUnfinished = false;
        if (this.isShown) {
            isUnfinished = this.curve.draw(tick);
            this.roll.follow(tick, transport.playing);
            this.roll.draw(tick);
            this.showPlace(melody, tick);
        }
        if (transport.playing || isUnfinished) this.redraw();
    }

    private showPlace(melody: Melody, tick: number): void {
        const text = placeText(melody, tick);
        if (this.placeLine.textContent !== text) this.placeLine.textContent = text;
        const { secondsPerTick } = this.player.transport;
        const time = `${timeText(tick * secondsPerTick)} / ${timeText(melody.end * secondsPerTick)}`;
        if (this.timeLine.textContent !== time) this.timeLine.textContent = time;
        const beat = String(Math.round(tick / melody.beat));
        if (this.position.value !== beat) {
            this.position.value = beat;
            this.position.setAttribute("aria-valuetext", text);
        }
        this.position.style.setProperty("--at", `${(100 * Math.min(1, tick / melody.end)).toFixed(2)}%`);
    }

    /// Marks in the editor where the note that has just begun comes from.
    private light(melody: Melody, heard: number): void {
        const { secondsPerTick } = this.player.transport;
        // A note that begins before the middle of this frame's time on the screen belongs to it.
        const tick = Math.min(heard + half_frame / secondsPerTick, melody.end);
        let note = firstFrom(melody, tick + 1e-6) - 1;
        void this.origins.lookAhead(Math.max(0, note));
        // Of notes that begin together, the first voice that is heard.
        for (let i = note; i >= 0 && melody.onset[i] === melody.onset[note]; --i) {
            if (this.player.isHeard(melody.voice[i])) note = i;
        }
        if (note < 0 || note === this.litNote) return;
        const place = this.origins.placeOf(note);
        if (!place) return;
        this.litNote = note;
        this.studio.highlight(place);
        performance.clearMarks("note lit");
        const late = (heard - melody.onset[note]) * secondsPerTick * 1000;
        performance.mark("note lit", { detail: { note, late, line: place.line, column: place.column } });
    }

    show(): void {
        this.isShown = true;
        const { opened, store } = this.studio;
        if (this.isStale && opened) void this.load(opened.facts, { ...opened.work, play: store.work.play });
        this.curve.reset();
        this.roll.reset();
    }

    hide(): void {
        this.isShown = false;
    }
}

const sentence = (text: string): string =>
    `${text.slice(0, 1).toUpperCase()}${text.slice(1)}${/[.!?`]$/.test(text) ? "" : "."}`;

const memory = "sikku-volume";

function remembered(): number {
    try {
        const value = Number(localStorage.getItem(memory) ?? "0.8");
        return value >= 0 && value <= 1 ? value : 0.8;
    } catch {
        return 0.8; // a page without a memory
    }
}

function remember(volume: number): void {
    try {
        localStorage.setItem(memory, String(volume));
    } catch {
        // a page without a memory
    }
}

export const makePlayPanel: MakePanel = (studio) => new PlayPanel(studio);
