// The melody of the pattern: transport, the curve and the piano roll as they are played, voices, MIDI.
import { titleOfArrangement } from "./arrangements";
import type { MakePanel, Panel, Studio, Work } from "./context";
import { messageOf, RequestFailed } from "./context";
import { button, element } from "./elements";
import { openFilm } from "./film";
import { onTheme } from "./layout";
import { optionOf, withOption } from "./options";
import { CurveView } from "./play/curve_view";
import { makeMidiMenu } from "./play/midi_menu";
import { Player } from "./play/player";
import { showReading } from "./play/reading_fields";
import { remediesFor, withMovesDrawn } from "./play/remedies";
import { RollView } from "./play/roll_view";
import { showSpline } from "./play/spline";
import { TransportBar } from "./play/transport_bar";
import { VoiceList } from "./play/voice_list";
import type { ArrangementRequest, Made, Notes, Opened } from "./protocol";
import { Refusal } from "./refusal";
import type { Melody } from "./sound/melody";
import { barsOf, firstFrom, keyName, placeText, readMelody } from "./sound/melody";
import { NoteOrigins } from "./sound/origins";
import { isAnother } from "./versions";

const icons = {
    closer: "M7 3v8M3 7h8M14 14l-3.5-3.5",
    wider: "M3 7h8M14 14l-3.5-3.5",
    film: "M2.5 3.5h11v9h-11zM5.5 3.5v9M10.5 3.5v9M2.5 8h3M10.5 8h3",
    save: "M8 2v8M5 7.5L8 10.5l3-3M3 13h10",
};
const patience = 300; // milliseconds until the panel reports that it is making a melody
const half_frame = 0.008; // seconds
const most_pointed = 200_000; // notes searched for the one under the pointer
/// Elements in which the space key has another meaning.
const own_space =
    "button, a, select, summary, textarea, dialog, [role='tab'], [role='application'], input:not([type='range'])";

// What the view plays, of a work that may be newer than the facts.
const played = ({ play, arrangement = null }: Work): Pick<Work, "play" | "arrangement"> => ({ play, arrangement });

class PlayPanel implements Panel {
    readonly name = "play";
    readonly label = "Play";
    readonly element = element("div", { class: "play" });

    private readonly player: Player;
    private readonly origins: NoteOrigins;
    private readonly curve: CurveView;
    private readonly roll: RollView;
    private readonly voices: VoiceList;
    private readonly bar: TransportBar;
    private isShown = false;
    private isStale = true; // the melody belongs to an older work
    private loaded = ""; // what it was made from
    private heard: Work["pattern"] | null = null; // the pattern whose melody is shown
    private playsMoves: Work["pattern"] | null = null; // its moves are played as if they were drawn
    private waitTimer = 0;
    private mutedState = ""; // as shown by the views
    private frame = 0;
    private litNote = -1;

    private readonly hover = element("p", { class: "play-hover", "aria-hidden": "true" });
    private readonly problem = element("div", { class: "note error play-problem", role: "alert", hidden: true });
    private readonly refusal: Refusal;
    private readonly waiting = element("p", { class: "note play-waiting", role: "status", hidden: true });
    private readonly arranged = element("div", { class: "play-arranged", hidden: true });
    private readonly curveCanvas = element("canvas", { class: "play-curve-canvas", role: "img" });
    private readonly rollCanvas = element("canvas", { class: "play-roll-canvas", role: "img" });
    private readonly facts = element("p", { class: "play-facts" });
    private readonly reading = element("div", { class: "play-reading" });

    constructor(private readonly studio: Studio) {
        this.player = new Player(studio);
        this.refusal = new Refusal(studio, this.problem);
        this.origins = new NoteOrigins(studio.engine);
        this.voices = new VoiceList(this.player);
        this.curve = new CurveView(this.curveCanvas, () => this.redraw());
        this.bar = new TransportBar(this.player, {
            seek: (tick) => this.seek(tick),
            tempo: (value) => this.setTempo(value),
            looped: (loop) => {
                this.roll.shownLoop = loop;
                this.redraw();
            },
        });
        this.roll = new RollView(this.rollCanvas, {
            seek: (tick) => this.seek(tick),
            loop: (loop) => this.bar.setLoop(loop),
            point: (text) => this.point(text),
            redraw: () => this.redraw(),
        });
        this.describe("No melody yet.", "the pattern");
        this.build();
        this.listen();
        this.showArrangement(this.studio.store.work.arrangement ?? null);
        this.player.onChange = () => this.update();
        this.update();
    }

    private build(): void {
        const zoom = element(
            "div",
            { class: "play-zoom" },
            button("Show more bars", () => this.roll.zoom(1 / 1.5), { kind: "quiet", icon: icons.wider }),
            button("Show fewer bars", () => this.roll.zoom(1.5), { kind: "quiet", icon: icons.closer }),
        );
        const save = button("Save as MIDI", () => void this.saveMidi(), { icon: icons.save, shows: true });
        const film = button("Save as WAV or film…", () => this.openFilm(), { icon: icons.film, shows: true });
        const group = (title: string, content: HTMLElement): HTMLElement =>
            element("details", { class: "group" }, element("summary", {}, title), content);
        const side = element(
            "aside",
            { class: "play-side", "aria-label": "Voices and settings" },
            this.voices.element,
            group("How the curve becomes music", this.reading),
            group("MIDI out", makeMidiMenu(this.player)),
            element("div", { class: "play-section" }, save, film, this.facts),
        );
        const views = element(
            "div",
            { class: "play-views" },
            element("div", { class: "play-curve" }, this.curveCanvas, this.hover),
            element("div", { class: "play-roll" }, this.rollCanvas, zoom),
            this.bar.position,
        );
        this.element.append(this.bar.element, this.arranged, this.problem, this.waiting, element("div", { class: "play-body" }, views, side));
    }

    private listen(): void {
        const { studio, curveCanvas } = this;
        studio.onOpened((facts, work) => {
            // An arrangement does not depend on the text, but may have to wait for it after a reload.
            if (!work.arrangement || this.isStale) this.change(facts, work);
        });
        studio.onChecked(() => this.sayWaiting());
        studio.store.subscribe((work, before) => {
            const isOther = work.arrangement?.text !== before.arrangement?.text;
            if (isOther) this.player.stop();
            if (isOther || (!work.arrangement && isAnother(work.pattern, before.pattern))) this.forget();
            this.showArrangement(work.arrangement ?? null);
            if (work.play === before.play && !isOther) return;
            this.applyTempo();
            if (studio.opened) this.change(studio.opened.facts, { ...studio.opened.work, ...played(work) });
        });
        curveCanvas.addEventListener("click", (event) => {
            const tick = this.curve.tickAt(event.offsetX, event.offsetY);
            if (tick !== null) this.seek(tick);
        });
        curveCanvas.addEventListener("pointermove", (event) => {
            const { melody } = this.player;
            if (!melody || melody.count > most_pointed || event.buttons !== 0) return;
            const tick = this.curve.tickAt(event.offsetX, event.offsetY);
            const note = tick === null ? -1 : firstFrom(melody, tick + 1e-6) - 1;
            this.point(tick === null || note < 0 ? null : `${placeText(melody, tick)}, ${keyName(melody.key[note])}`);
        });
        curveCanvas.addEventListener("pointerleave", () => this.point(null));
        document.addEventListener("keydown", (event) => this.press(event));
        onTheme(() => {
            this.curve.reset();
            this.roll.reset();
            this.voices.update();
        });
    }

    private press(event: KeyboardEvent): void {
        const isChord = event.ctrlKey || event.metaKey || event.altKey;
        const isMeant = this.isShown || this.player.transport.playing; // music continues behind the other views
        if (!isMeant || event.key !== " " || event.defaultPrevented || isChord) return;
        const { target } = event;
        if (target instanceof HTMLElement && (target.isContentEditable || target.closest(own_space))) return;
        event.preventDefault();
        void this.player.toggle();
    }

    // --- the melody -----------------------------------------------------------------------------------------------

    private change(facts: Opened, work: Work): void {
        this.isStale = true;
        if (this.isShown || this.player.transport.playing) void this.load(facts, work);
    }

    private async load(facts: Opened, work: Work): Promise<void> {
        // The tempo does not change the notes.
        const isTimed = optionOf(work.play, "seconds") !== undefined;
        const isNumber = Number(optionOf(work.play, "tempo")) > 0;
        const options = isTimed || !isNumber ? work.play : withOption(work.play, "tempo", null);
        const source = this.sourceOf(work);
        const what = JSON.stringify([source, options]);
        if (what === this.loaded) {
            this.isStale = false;
            return;
        }
        this.wait();
        try {
            const { json, bytes } = await this.studio.engine.request<Notes>(
                { do: "notes", options, ...source },
                { key: "notes", seconds: work.arrangement ? 60 : 20 },
            );
            this.loaded = what;
            this.isStale = false;
            this.refusal.clear();
            this.endWait();
            this.showMelody(readMelody(json, bytes), facts, work);
        } catch (error) {
            if (!(error instanceof RequestFailed)) return; // superseded by a later request
            this.loaded = what;
            this.isStale = false;
            this.endWait();
            this.showProblem(error, facts, work);
        }
    }

    // Another pattern: the melody shown does not belong to it. Music continues until the next melody is ready.
    private forget(): void {
        this.isStale = true;
        this.refusal.clear();
        this.wait();
        if (!this.player.transport.playing) this.clear();
    }

    // Shows no melody.
    private clear(): void {
        this.loaded = "";
        this.heard = null;
        this.player.setMelody(null);
        this.curve.show(null);
        this.roll.show(null);
        this.bar.clear();
        this.describe("No melody yet.", "the pattern");
    }

    // After a moment, reports that a melody is being made, and dims the previous one.
    private wait(): void {
        clearTimeout(this.waitTimer);
        this.element.setAttribute("aria-busy", "true");
        this.waitTimer = window.setTimeout(() => {
            this.waiting.hidden = false;
            this.element.classList.add("stale");
            this.sayWaiting();
        }, patience);
    }

    private sayWaiting(): void {
        this.waiting.textContent = this.studio.hasErrors ? "The text has errors." : "Making the melody…";
    }

    private endWait(): void {
        clearTimeout(this.waitTimer);
        this.waiting.hidden = true;
        this.element.classList.remove("stale");
        this.element.removeAttribute("aria-busy");
    }

    /// The pattern whose melody is played.
    private played(work: Work): Work["pattern"] {
        const { playsMoves } = this;
        return (playsMoves && !isAnother(playsMoves, work.pattern) && withMovesDrawn(work.pattern)) || work.pattern;
    }

    /// What is played: the arrangement, or the pattern.
    private sourceOf(work: Work): { arrangement: ArrangementRequest } | { pattern: Work["pattern"] } {
        return work.arrangement ? { arrangement: work.arrangement } : { pattern: this.played(work) };
    }

    // Says which arrangement is played, and offers to return to the pattern.
    private showArrangement(arrangement: ArrangementRequest | null): void {
        this.arranged.hidden = arrangement === null;
        if (!arrangement) return;
        const back = button("Play the pattern instead", () =>
            this.studio.store.change({ arrangement: null, play: [] }),
        );
        this.arranged.replaceChildren(
            element("p", {}, "Arrangement: ", element("strong", {}, titleOfArrangement(arrangement))),
            back,
        );
    }

    private showProblem(error: RequestFailed, facts: Opened, work: Work): void {
        if (work.arrangement) {
            this.clear();
            this.problem.textContent = messageOf(error);
            this.problem.hidden = false;
            return;
        }
        // Music continues while its pattern is edited; the panel is dimmed.
        if (!this.player.transport.playing || !this.heard || isAnother(this.heard, work.pattern)) this.clear();
        else this.element.classList.add("stale");
        const remedies = remediesFor(error.message, work.pattern, work.play).map(({ label, options, pattern }) =>
            button(label, () => {
                if (options) {
                    this.studio.store.change({ play: options });
                } else if (pattern) {
                    this.playsMoves = work.pattern;
                    void this.load(facts, work);
                }
            }),
        );
        this.refusal.show(error, work.pattern);
        if (remedies.length > 0) this.problem.append(element("div", { class: "toolbar" }, ...remedies));
    }

    private showMelody(melody: Melody, facts: Opened, work: Work): void {
        const isOther = !this.heard || isAnother(this.heard, work.pattern);
        if (isOther && !this.player.transport.playing) this.player.transport.seek(0);
        this.heard = work.pattern;
        // Notes of an arrangement come from several texts.
        this.origins.reset(melody, work.arrangement ? null : this.played(work));
        this.player.setMelody(melody);
        this.curve.show(melody);
        void showSpline(this.studio, this.curve, melody, work, () => this.player.melody === melody);
        this.roll.show(melody);
        this.litNote = -1;
        const many = (count: number, one: string): string =>
            `${count.toLocaleString("en")} ${count === 1 ? one : `${one}s`}`;
        const scales = [...new Set(melody.parts.map((part) => part.scale))].join("; ");
        const [low, high] = [keyName(Math.round(melody.lowest)), keyName(Math.round(melody.highest))];
        const range = melody.count > 0 ? `, ${low} to ${high}` : "";
        this.describe(
            `${many(melody.count, "note")} in ${many(barsOf(melody), "bar")}${range}. ${scales}.`,
            (work.arrangement ? titleOfArrangement(work.arrangement) : facts.title) || "the pattern",
        );
        this.applyTempo();
        this.bar.showMelody(melody);
        showReading(this.reading, this.studio.help, this.studio.store.work.play, (name, value) =>
            this.setOption(name, value),
        );
        this.update();
    }

    private describe(facts: string, title: string): void {
        this.facts.textContent = facts;
        this.curveCanvas.setAttribute("aria-label", `The curve of ${title} as it sounds: ${facts}`);
        this.rollCanvas.setAttribute("aria-label", `Piano roll: ${facts}`);
    }

    private setOption(name: string, value: string | null, merge?: string): void {
        const { store } = this.studio;
        store.change({ play: withOption(store.work.play, name, value) }, merge);
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
        const chosen = Number(optionOf(this.studio.store.work.play, "tempo"));
        const { transport } = this.player;
        transport.setTempo(chosen > 0 ? chosen : null); // for all sections, as in files
        this.bar.showTempo(Math.round(transport.tempoAt(this.player.place()) * 100) / 100);
        this.redraw();
    }

    private async saveMidi(): Promise<void> {
        const { work } = this.studio.store;
        try {
            const { json, bytes } = await this.studio.engine.request<Made>(
                { do: "make", interpreter: "play", format: "mid", options: work.play, ...this.sourceOf(work) },
                { key: "midi file", seconds: 60 },
            );
            const name = `${(work.arrangement ?? work.pattern).name.replace(/\.[^.]*$/, "") || "melody"}.mid`;
            this.studio.save(name, bytes, "audio/midi");
            const warning = json.remarks.find((remark) => remark.is_warning);
            this.studio.say(warning ? warning.text : `Saved ${name}.`, warning ? "warning" : "fact");
        } catch (error) {
            if (error instanceof RequestFailed) this.studio.say(error.message, "error");
        }
    }

    // A file sounds as the page does, with its voices and tempo.
    private openFilm(): void {
        const { player } = this;
        player.pause();
        const voices = player.voices.map((voice) => ({ ...voice }));
        const { tempo } = player.transport;
        openFilm(this.studio, "play", player.melody && { voices, tempo, volume: player.volume });
    }

    // --- drawing ---------------------------------------------------------------------------------------------

    private point(text: string | null): void {
        this.hover.textContent = text ?? "";
    }

    /// Updates after the player has started, stopped, or changed a voice.
    private update(): void {
        this.bar.update();
        this.voices.update();
        const muted = (voice: number): boolean => !this.player.isHeard(voice);
        const state = this.player.voices.map((_, voice) => muted(voice)).join();
        if (state !== this.mutedState) {
            this.mutedState = state;
            this.curve.setMuted(muted);
            this.roll.muted = muted;
        }
        if (!this.player.transport.playing) {
            this.litNote = -1;
            this.studio.highlight(null);
        }
        this.redraw();
    }

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
        if (!melody) {
            if (this.isShown) {
                this.curve.draw(0);
                this.roll.draw(0);
            }
            return;
        }
        const tick = this.player.place();
        if (transport.playing) this.light(melody, tick);
        let isUnfinished = false;
        if (this.isShown) {
            isUnfinished = this.curve.draw(tick);
            this.roll.follow(tick, transport.playing);
            this.roll.draw(tick);
            this.bar.showPlace(melody, tick);
        }
        if (transport.playing || isUnfinished) this.redraw();
    }

    /// Highlights the origin of the note that has just begun, in the editor.
    private light(melody: Melody, heard: number): void {
        const { transport } = this.player;
        // A note that begins before the middle of this frame belongs to the frame.
        const tick = Math.min(transport.tickAfter(heard, half_frame), melody.end);
        let note = firstFrom(melody, tick + 1e-6) - 1;
        void this.origins.lookAhead(Math.max(0, note));
        // Among notes that begin together, choose the first audible voice.
        for (let i = note; i >= 0 && melody.onset[i] === melody.onset[note]; --i) {
            if (this.player.isHeard(melody.voice[i])) note = i;
        }
        if (note < 0 || note === this.litNote) return;
        const place = this.origins.placeOf(note);
        if (!place) return;
        this.litNote = note;
        this.studio.highlight(place);
        performance.clearMarks("note lit");
        const late = (transport.secondsAt(heard) - transport.secondsAt(melody.onset[note]!)) * 1000;
        performance.mark("note lit", { detail: { note, late, line: place.line, column: place.column } });
    }

    show(): void {
        this.isShown = true;
        const { opened, store } = this.studio;
        // While a new text has errors, there is nothing to play.
        const isOurs = opened && (store.work.arrangement || !isAnother(opened.work.pattern, store.work.pattern));
        if (this.isStale && isOurs) void this.load(opened.facts, { ...opened.work, ...played(store.work) });
        this.curve.reset();
        this.roll.reset();
    }

    hide(): void {
        this.isShown = false;
    }
}

export const makePlayPanel: MakePanel = (studio) => new PlayPanel(studio);
