// Films and sound, made in the page: the line as it is drawn, growth from n = 0, or the melody as it is played; as GIF,
// WebM or WAV.
import { titleOfArrangement } from "./arrangements";
import { messageOf, type Studio } from "./context";
import { openDialog, type Dialog } from "./dialog";
import { button, element, field } from "./elements";
import { GifWriter, paletteOf } from "./film/gif";
import { Pen, readDrawing, type Drawing } from "./film/outlines";
import { longest_sound, renderSound, secondsOf, usualVoices } from "./film/sound";
import { wavOf } from "./film/wav";
import { bytes as sizeOf } from "./numbers_shown";
import { optionOf, withOption } from "./options";
import { pageOptions } from "./option_scopes";
import { imageOf, isAbort } from "./pictures";
import { CurveView } from "./play/curve_view";
import { showSpline } from "./play/spline";
import { readInk } from "./play/surface";
import type { Made, Notes, Pixels } from "./protocol";
import { readMelody, tickAfter, type Melody } from "./sound/melody";
import type { VoiceSettings } from "./sound/sound_output";

export type FilmKind = "line" | "growth" | "play";

const kinds: [FilmKind, string][] = [
    ["line", "The line is drawn"],
    ["growth", "Growth, from n = 0"],
    ["play", "The melody plays"],
];
const sizes = [320, 480, 720, 1080]; // pixels of the longer side
const gif_rate = 20; // pictures a second
const film_rate = 30;
const pause = 1.5; // seconds that the last picture stays
const longest_film = 60; // seconds
const most_gif_pixels = 260e6; // of all pictures
// Firefox never finishes a recording without sound whose type names a codec of sound.
const silent_types = ["video/webm;codecs=vp9", "video/webm;codecs=vp8", "video/webm", "video/mp4"];
const sounding_types = ["video/webm;codecs=vp9,opus", "video/webm;codecs=vp8,opus", "video/webm", "video/mp4"];
const recording_patience = 10_000; // milliseconds after the end of a film

/// Draws the picture of a film at a given time on a canvas; `seconds` is the length of the film.
interface Film {
    width: number;
    height: number;
    seconds: number;
    draw(context: CanvasRenderingContext2D, at: number): void;
    rate: number; // pictures a second that differ
    sound?: AudioBuffer;
}

/// The voices and the tempo with which Play plays; absent: those of the text.
export interface Playing {
    voices: VoiceSettings[];
    tempo: number | null; // of the whole piece; null: its own
    volume: number;
}

class FilmDialog {
    private kind: FilmKind;
    private stop = new AbortController();
    private isBusy = false;
    private readonly dialog: Dialog;
    private readonly preview = element("canvas", { class: "film-preview", width: 320, height: 320, role: "img", "aria-label": "The film" });
    private readonly seconds = element("input", { type: "number", id: "film-seconds", min: 1, max: longest_film, step: 1, value: 6 });
    private readonly size = element("select", { id: "film-size" }, ...sizes.map((size) =>
        element("option", { value: size, selected: size === 480 }, `${size} pixels`)));
    private readonly status = element("p", { class: "film-status", role: "status" });
    private readonly gif = button("Save as GIF", () => void this.run("gif", () => this.makeGif()), { kind: "primary" });
    private readonly webm = button("Save as WebM", () => void this.run("webm", () => this.makeWebm()));
    private readonly wav = button("Save as WAV", () => void this.run("wav", () => this.makeWav()));

    constructor(
        private readonly studio: Studio,
        kind: FilmKind,
        private readonly playing: Playing | null,
    ) {
        this.kind = kind;
        this.dialog = openDialog("Film and sound", { closed: () => this.stop.abort() });
        this.dialog.body.classList.add("film");
        const kindFields = element("fieldset", { class: "film-kinds" }, element("legend", { class: "unseen" }, "What the film shows"));
        for (const [name, label] of this.offered()) {
            const radio = element("input", { type: "radio", name: "film-kind", value: name });
            radio.checked = name === this.kind;
            radio.addEventListener("change", () => this.choose(name));
            kindFields.append(element("label", { class: "switch" }, radio, label));
        }
        this.dialog.body.append(
            kindFields,
            element("div", { class: "fields" }, field("Length, in seconds", this.seconds), field("Longer side", this.size)),
            this.status,
            this.preview,
        );
        this.dialog.footer.append(this.wav, this.webm, this.gif);
        if (!this.offered().some(([name]) => name === this.kind)) this.kind = "growth";
        this.choose(this.kind);
        this.size.addEventListener("change", () => this.choose(this.kind));
        this.dialog.body.querySelector<HTMLElement>("input:checked")?.focus();
    }

    // A map has neither a pen nor a melody; an arrangement has no picture.
    private offered(): [FilmKind, string][] {
        const facts = this.studio.opened?.facts;
        if (this.studio.store.work.arrangement && this.kind === "play") return kinds.filter(([name]) => name === "play");
        return kinds.filter(([name]) => name === "growth" || !facts?.is_map);
    }

    private choose(kind: FilmKind): void {
        this.kind = kind;
        const isPlay = kind === "play";
        this.seconds.parentElement!.hidden = isPlay;
        this.wav.hidden = !isPlay;
        this.gif.hidden = isPlay;
        this.webm.classList.toggle("primary", isPlay);
        const canRecord = typeof MediaRecorder !== "undefined" && "captureStream" in HTMLCanvasElement.prototype;
        this.webm.hidden = !canRecord;
        this.status.textContent = isPlay
            ? "Sound as WAV is made at once; a film with sound is recorded while it plays."
            : `A GIF is made at once. A WebM is recorded while it plays${canRecord ? "" : ", which this browser cannot do"}.`;
        void this.showFirst();
    }

    // Shows a picture of the film, or why there is none.
    private async showFirst(): Promise<void> {
        this.stop.abort();
        this.stop = new AbortController();
        const { signal } = this.stop;
        try {
            if (this.kind === "play") return void this.preview.getContext("2d")!.clearRect(0, 0, 9999, 9999);
            const film = await this.film(signal);
            if (!signal.aborted) this.show(film, film.seconds * (this.kind === "line" ? 0.6 : 1));
        } catch (error) {
            if (!isAbort(error) && !signal.aborted) this.status.textContent = messageOf(error);
        }
    }

    private show(film: Film, at: number): void {
        this.preview.width = film.width;
        this.preview.height = film.height;
        film.draw(this.preview.getContext("2d")!, at);
    }

    private get name(): string {
        const { arrangement, pattern } = this.studio.store.work;
        return ((this.kind === "play" ? arrangement : null) ?? pattern).name.replace(/\.[^.]*$/, "") || "pattern";
    }

    // Makes a file, one at a time.
    private async run(extension: string, make: () => Promise<[bytes: Uint8Array, type: string, extension?: string]>): Promise<void> {
        if (this.isBusy) return;
        this.setBusy(true);
        this.stop.abort();
        this.stop = new AbortController();
        const { signal } = this.stop;
        try {
            const [bytes, type, other = extension] = await make();
            if (signal.aborted) return;
            const name = `${this.name}.${other}`;
            this.studio.save(name, bytes, type);
            this.status.textContent = `Saved ${name} (${sizeOf(bytes.length)}).`;
        } catch (error) {
            if (!isAbort(error) && !signal.aborted) this.status.textContent = messageOf(error);
        } finally {
            this.setBusy(false);
        }
    }

    private setBusy(isBusy: boolean): void {
        this.isBusy = isBusy;
        for (const each of [this.gif, this.webm, this.wav]) each.disabled = isBusy;
    }

    private get length(): number {
        return Math.min(longest_film, Math.max(1, this.seconds.valueAsNumber || 6));
    }

    private progress(share: number): void {
        this.status.textContent = `Making the film: ${Math.round(100 * share)} %`;
    }

    // --- what the films show

    private film(signal: AbortSignal): Promise<Film> {
        if (this.kind === "growth") return this.growth(signal);
        return this.kind === "line" ? this.line(signal) : this.play();
    }

    private async line(signal: AbortSignal): Promise<Film> {
        const { engine, help, store } = this.studio;
        const { pattern, draw } = store.work;
        const { bytes } = await engine.request<Made>(
            { do: "make", interpreter: "draw", format: "svg", options: pageOptions(help, draw), pattern },
            { signal, seconds: 30 },
        );
        const drawing = readDrawing(new TextDecoder().decode(bytes));
        if (drawing.outlines.length === 0) throw new Error("This pattern draws no lines.");
        return lineFilm(drawing, Number(this.size.value), this.length);
    }

    private async growth(signal: AbortSignal): Promise<Film> {
        const { engine, help, store, opened } = this.studio;
        const { pattern, draw } = store.work;
        const most = Number(opened?.facts.n ?? 0);
        if (most > 200) throw new Error("Growth has one picture for each n; reduce n to 200 or less.");
        const size = Number(this.size.value);
        const pictures: ImageData[] = [];
        for (let n = 0; n <= most; ++n) {
            const settings = withOption(pattern.settings, "derivation length", String(n));
            try {
                const answer = await engine.request<Pixels>(
                    { do: "pixels", width: size, height: size, options: pageOptions(help, draw), pattern: { ...pattern, settings } },
                    { signal, seconds: 30 },
                );
                pictures.push(imageOf(answer));
            } catch (error) {
                if (isAbort(error)) throw error;
                if (n === most) throw error; // the first words may draw nothing
            }
            if (n < most) this.progress(n / most);
        }
        const last = pictures.at(-1)!;
        const same = pictures.filter((each) => each.width === last.width && each.height === last.height);
        const each = this.length / same.length;
        this.status.textContent = `${same.length} pictures, ${Math.round(each * 100) / 100} seconds each.`;
        return {
            width: last.width,
            height: last.height,
            seconds: this.length,
            rate: same.length / this.length,
            draw: (context, at) => context.putImageData(same[Math.min(same.length - 1, Math.floor(at / each + 1e-6))]!, 0, 0),
        };
    }

    private async melody(): Promise<{ melody: Melody; playing: Playing; title: string }> {
        const { engine, store } = this.studio;
        const { arrangement, pattern, play } = store.work;
        const isTimed = optionOf(play, "seconds") !== undefined;
        const options = isTimed ? play : withOption(play, "tempo", null);
        const { json, bytes } = await engine.request<Notes>(
            { do: "notes", options, ...(arrangement ? { arrangement } : { pattern }) },
            { seconds: 60, signal: this.stop.signal },
        );
        const melody = readMelody(json, bytes);
        if (melody.count === 0) throw new Error("This pattern plays no notes.");
        const chosen = Number(optionOf(play, "tempo"));
        const usual = { voices: usualVoices(melody), tempo: chosen > 0 ? chosen : null, volume: 0.8 };
        const playing = this.playing?.voices.length === melody.voices ? this.playing : usual;
        return { melody, playing, title: arrangement ? titleOfArrangement(arrangement) : "" };
    }

    private async play(): Promise<Film> {
        const { melody, playing } = await this.melody();
        const seconds = secondsOf(melody, playing.tempo);
        if (seconds > longest_film) {
            throw new Error(
                `The melody lasts ${Math.round(seconds)} seconds, and films at most ${longest_film}; ` +
                    "set a faster tempo or fewer bars, or save it as WAV.",
            );
        }
        this.status.textContent = "Playing the melody into memory…";
        const sound = await renderSound(melody, playing.voices, playing.tempo, playing.volume);
        const size = Number(this.size.value);
        const width = size;
        const height = Math.round((size * 9) / 16 / 2) * 2;
        const canvas = element("canvas", { class: "film-curve", "aria-hidden": "true" });
        const ratio = window.devicePixelRatio || 1;
        canvas.style.width = `${width / ratio}px`;
        canvas.style.height = `${height / ratio}px`;
        this.dialog.body.append(canvas); // it takes its size from the page
        const curve = new CurveView(canvas, () => {});
        curve.show(melody);
        await showSpline(this.studio, curve, melody, this.studio.store.work);
        const { raised } = readInk();
        return {
            width,
            height,
            seconds: Math.min(sound.duration, seconds + 2),
            rate: film_rate,
            sound,
            draw(context, at) {
                context.fillStyle = raised;
                context.fillRect(0, 0, width, height);
                curve.draw(Math.min(melody.end, tickAfter(melody, at, playing.tempo)));
                context.drawImage(canvas, 0, 0, width, height);
            },
        };
    }

    // --- files

    private async makeGif(): Promise<[Uint8Array, string]> {
        const { signal } = this.stop;
        const film = await this.film(signal);
        const rate = Math.min(gif_rate, film.rate);
        const count = Math.max(1, Math.round(film.seconds * rate));
        if (count * film.width * film.height > most_gif_pixels) {
            throw new Error("This GIF would be too large: reduce its length or its size, or save it as WebM.");
        }
        this.show(film, film.seconds);
        const context = this.preview.getContext("2d", { willReadFrequently: true })!;
        const pixels = () => context.getImageData(0, 0, film.width, film.height).data;
        const writer = new GifWriter(film.width, film.height, paletteOf(pixels()));
        for (let at = 0; at < count; ++at) {
            film.draw(context, ((at + 1) * film.seconds) / count - (film.rate < gif_rate ? 1e-3 : 0));
            writer.add(pixels(), film.seconds / count + (at === count - 1 ? pause : 0));
            this.progress((at + 1) / count);
            await new Promise((done) => setTimeout(done));
            signal.throwIfAborted();
        }
        return [writer.finish(), "image/gif"];
    }

    private async makeWebm(): Promise<[Uint8Array, string, string]> {
        const { signal } = this.stop;
        const film = await this.film(signal);
        const type = (film.sound ? sounding_types : silent_types).find((each) => MediaRecorder.isTypeSupported(each));
        if (!type) throw new Error("This browser cannot record films; save a GIF instead.");
        this.show(film, 0);
        const context = this.preview.getContext("2d")!;
        const stream = this.preview.captureStream(film_rate);
        let audio: AudioContext | null = null;
        let source: AudioBufferSourceNode | null = null;
        if (film.sound) {
            audio = new AudioContext();
            await audio.resume();
            const output = audio.createMediaStreamDestination();
            source = audio.createBufferSource();
            source.buffer = film.sound;
            source.connect(output);
            source.connect(audio.destination);
            for (const track of output.stream.getAudioTracks()) stream.addTrack(track);
        }
        const recorder = new MediaRecorder(stream, { mimeType: type, videoBitsPerSecond: 40 * film.width * film.height * 0.2 + 1e6 });
        const chunks: Blob[] = [];
        recorder.ondataavailable = ({ data }) => chunks.push(data);
        const whole = film.seconds + (film.sound ? 0 : pause);
        try {
            const recorded = new Promise<void>((done, fail) => {
                recorder.onstop = () => done();
                recorder.onerror = () => fail(new Error("The browser stopped recording."));
            });
            recorder.start(1000);
            source?.start();
            const begin = performance.now();
            await new Promise<void>((done) => {
                const step = () => {
                    const at = (performance.now() - begin) / 1000;
                    if (at >= whole || signal.aborted) return done();
                    film.draw(context, Math.min(at, film.seconds));
                    this.progress(at / whole);
                    setTimeout(step, 1000 / film_rate);
                };
                step();
            });
            recorder.stop();
            const late = new Promise<void>((_, fail) => {
                setTimeout(() => fail(new Error("The browser did not finish the recording; save a GIF instead.")), recording_patience);
            });
            await Promise.race([recorded, late]);
        } finally {
            for (const track of stream.getTracks()) track.stop();
            await audio?.close();
        }
        const container = type.split(";")[0]!;
        const bytes = new Uint8Array(await new Blob(chunks).arrayBuffer());
        return [bytes, container, container.endsWith("mp4") ? "mp4" : "webm"];
    }

    private async makeWav(): Promise<[Uint8Array, string]> {
        const { melody, playing } = await this.melody();
        this.status.textContent = "Playing the melody into memory…";
        const sound = await renderSound(melody, playing.voices, playing.tempo, playing.volume);
        const channels = Array.from({ length: sound.numberOfChannels }, (_, at) => sound.getChannelData(at));
        if (secondsOf(melody, playing.tempo) > longest_sound) {
            this.studio.say(`The file has the first ${longest_sound / 60} minutes.`, "warning");
        }
        return [wavOf(channels, sound.sampleRate), "audio/wav"];
    }
}

// The line, drawn with a constant speed. Earlier times begin anew.
function lineFilm(drawing: Drawing, size: number, seconds: number): Film {
    const scale = size / Math.max(drawing.width, drawing.height);
    let pen: Pen | null = null;
    let last = -1;
    let on: CanvasRenderingContext2D | null = null;
    return {
        width: Math.round((drawing.width * scale) / 2) * 2, // films have even sides
        height: Math.round((drawing.height * scale) / 2) * 2,
        seconds,
        rate: film_rate,
        draw(context, at) {
            if (!pen || at < last || context !== on) pen = new Pen(context, drawing, scale);
            [last, on] = [at, context];
            pen.drawTo(at / seconds);
        },
    };
}

/// Opens the dialog. @param playing  how Play plays the melody
export function openFilm(studio: Studio, kind: FilmKind, playing: Playing | null = null): void {
    new FilmDialog(studio, kind, playing);
}
