// Plays the MIDI file of a page with the oscillators of the browser.
"use strict";

// Reads a Standard MIDI file: notes with their times in seconds, in order; frequencies contain the pitch bend.
function readMidi(buffer) {
    const data = new DataView(buffer);
    let at = 0;
    const variable = () => {
        let value = 0, byte;
        do {
            byte = data.getUint8(at++);
            value = value * 128 + (byte & 127);
        } while (byte > 127);
        return value;
    };
    if (data.getUint32(0) !== 0x4d546864) throw new Error("This is not a MIDI file.");
    const tracks = data.getUint16(10), division = data.getUint16(12);
    const events = [];
    at = 14;
    for (let track = 0; track < tracks; ++track) {
        const end = at + 8 + data.getUint32(at + 4);
        at += 8;
        let tick = 0, status = 0;
        while (at < end) {
            tick += variable();
            if (data.getUint8(at) > 127) status = data.getUint8(at++);
            if (status === 0xff) {
                const type = data.getUint8(at++), size = variable();
                if (type === 0x51) {
                    const tempo = data.getUint16(at) * 256 + data.getUint8(at + 2);
                    events.push({tick, order: events.length, type: "tempo", tempo});
                }
                at += size;
            } else if (status >= 0xf0) {
                at += variable();
            } else {
                const type = status >> 4, one = data.getUint8(at++);
                const two = type === 12 || type === 13 ? 0 : data.getUint8(at++);
                events.push({tick, order: events.length, type, channel: status & 15, track, one, two});
            }
        }
        at = end;
    }
    events.sort((a, b) => a.tick - b.tick || a.order - b.order);

    const notes = [], sounding = new Map();
    const channels = Array.from({length: 16}, () => ({program: 0, bend: 0, range: 2, rpn: -1, high: 0, volume: 1}));
    let time = 0, tick = 0, second = 500000 / 1e6 / division;
    for (const event of events) {
        time += (event.tick - tick) * second;
        tick = event.tick;
        if (event.type === "tempo") {
            second = event.tempo / 1e6 / division;
            continue;
        }
        const channel = channels[event.channel], key = event.channel * 128 + event.one;
        if (event.type === 9 && event.two > 0) {
            const pitch = event.one + channel.bend * channel.range;
            const note = {
                start: time, end: time, drum: event.channel === 9, key: event.one, program: channel.program,
                frequency: 440 * 2 ** ((pitch - 69) / 12), loudness: event.two / 127 * channel.volume,
            };
            notes.push(note);
            if (!sounding.has(key)) sounding.set(key, []);
            sounding.get(key).push(note);
        } else if (event.type === 8 || event.type === 9) {
            const note = sounding.get(key)?.shift();
            if (note) note.end = time;
        } else if (event.type === 12) {
            channel.program = event.one;
        } else if (event.type === 14) {
            channel.bend = (event.two * 128 + event.one - 8192) / 8192;
        } else if (event.type === 11) {
            if (event.one === 101) channel.high = event.two;
            if (event.one === 100) channel.rpn = channel.high * 128 + event.two;
            if (event.one === 6 && channel.rpn === 0) channel.range = event.two;
            if (event.one === 7) channel.volume = event.two / 100;
        }
    }
    return {notes, length: time};
}

// Families of General MIDI instruments: overtones, seconds until a held note has faded, seconds of the attack.
function timbre(program) {
    if (program < 8) return {overtones: [0, 1, 0.5, 0.24, 0.12, 0.06], fade: 1.6, attack: 0.004};
    if (program < 16) return {overtones: [0, 1, 0, 0, 0.35, 0, 0, 0, 0, 0.1], fade: 0.9, attack: 0.002};
    if (program < 24) return {overtones: [0, 1, 0.8, 0.3, 0.5, 0, 0, 0, 0.2], fade: 0, attack: 0.02};
    if (program < 32) return {overtones: [0, 1, 0.6, 0.5, 0.3, 0.2, 0.1], fade: 1.2, attack: 0.004};
    if (program < 40) return {overtones: [0, 1, 0.5, 0.2], fade: 1.2, attack: 0.008};
    if (program < 56) return {overtones: [0, 1, 0.5, 0.33, 0.25, 0.2, 0.16, 0.14], fade: 0, attack: 0.06};
    if (program < 64) return {overtones: [0, 1, 0.8, 0.65, 0.5, 0.35, 0.2], fade: 0, attack: 0.03};
    if (program < 72) return {overtones: [0, 1, 0.1, 0.6, 0.1, 0.35, 0.05, 0.2], fade: 0, attack: 0.03};
    if (program < 80) return {overtones: [0, 1, 0.25, 0.08], fade: 0, attack: 0.04};
    if (program < 104) return {overtones: [0, 1, 0.4, 0.3, 0.2, 0.15], fade: 0, attack: 0.03};
    return {overtones: [0, 1, 0.7, 0.55, 0.45, 0.3, 0.25, 0.2, 0.1], fade: 1, attack: 0.003};
}

const patience = 3000; // milliseconds that a browser may take to start sound
const ahead = 0.3; // seconds by which notes are scheduled in advance

class Player {
    constructor(element) {
        this.element = element;
        this.button = element.querySelector("button");
        this.slider = element.querySelector("input");
        this.clock = element.querySelector("output");
        this.line = element.querySelector(".head-line");
        this.scheduled = 0; // notes
        this.playing = false;
        this.place = 0; // seconds
        this.button.addEventListener("click", () => void (this.playing ? this.pause() : this.play()));
        this.slider.addEventListener("input", () => void this.seek(this.slider.value / 1000));
        const roll = element.querySelector(".roll");
        roll?.addEventListener("click", event => {
            const box = roll.getBoundingClientRect();
            void this.seek((event.clientX - box.left) / box.width);
        });
        element.hidden = false;
    }

    async load() {
        if (this.score) return true;
        try {
            const answer = await fetch(this.element.dataset.midi);
            if (!answer.ok) throw new Error(answer.statusText);
            this.score = readMidi(await answer.arrayBuffer());
            return true;
        } catch (error) {
            this.clock.textContent = `The melody cannot be loaded (${error.message}).`;
            return false;
        }
    }

    now() {
        return this.playing ? Math.max(0, this.context.currentTime - this.began) : this.place;
    }

    async play() {
        this.context ??= new AudioContext();
        void this.context.resume();
        if (!await this.load() || this.playing) return;
        if (this.place >= this.score.length - 0.05) this.place = 0;
        this.out = this.context.createDynamicsCompressor();
        const gain = this.context.createGain();
        gain.gain.value = 0.5;
        this.out.connect(gain).connect(this.context.destination);
        this.asked = performance.now();
        this.silent = this.context.currentTime;
        this.began = this.context.currentTime + 0.06 - this.place;
        this.next = this.score.notes.findIndex(note => note.start >= this.place - 0.001);
        if (this.next < 0) this.next = this.score.notes.length;
        this.playing = true;
        this.button.textContent = "Pause";
        this.timer = setInterval(() => this.tick(), 60);
        this.tick();
    }

    pause() {
        this.place = this.now();
        this.playing = false;
        clearInterval(this.timer);
        this.out.disconnect();
        this.button.textContent = "Play";
        this.show();
    }

    async seek(share) {
        if (!await this.load()) return;
        const was = this.playing;
        if (was) this.pause();
        this.place = Math.min(Math.max(share, 0), 1) * this.score.length;
        if (was) await this.play();
        this.show();
    }

    tick() {
        const {notes, length} = this.score, until = this.now() + ahead;
        for (; this.next < notes.length && notes[this.next].start < until; ++this.next) {
            this.sound(notes[this.next]);
            ++this.scheduled;
        }
        if (this.context.currentTime === this.silent && performance.now() - this.asked > patience) {
            this.pause();
            this.clock.textContent = "The browser cannot play sound; is there an audio device?";
            return;
        }
        if (this.now() >= length) {
            this.pause();
            this.place = length;
        }
        this.show();
    }

    sound(note) {
        const {context} = this;
        const start = Math.max(context.currentTime, this.began + note.start);
        const gain = context.createGain();
        gain.connect(this.out);
        const loud = 0.02 + 0.3 * note.loudness ** 1.6;
        if (note.drum) {
            this.hit(note, start, gain, loud);
            return;
        }
        const {overtones, fade, attack} = timbre(note.program);
        this.waves ??= new Map();
        const name = overtones.join();
        if (!this.waves.has(name)) {
            const real = new Float32Array(overtones.length);
            this.waves.set(name, context.createPeriodicWave(real, new Float32Array(overtones)));
        }
        const tone = context.createOscillator();
        tone.setPeriodicWave(this.waves.get(name));
        tone.frequency.value = Math.min(note.frequency, context.sampleRate / 2.2);
        const end = start + Math.max(note.end - note.start, 0.03);
        gain.gain.setValueAtTime(0, start);
        gain.gain.linearRampToValueAtTime(loud, start + attack);
        if (fade) gain.gain.setTargetAtTime(0, start + attack, fade * (220 / Math.max(note.frequency, 110)) ** 0.4 / 2);
        gain.gain.setTargetAtTime(0, end, 0.05);
        tone.connect(gain);
        tone.start(start);
        tone.stop(end + 0.4);
    }

    // Drums: a falling tone for the bass drum and toms, noise for the others.
    hit(note, start, gain, loud) {
        const {context} = this, low = note.key < 37 || [41, 43, 45, 47, 48, 50].includes(note.key);
        let source;
        if (low) {
            source = context.createOscillator();
            source.frequency.setValueAtTime(note.key < 37 ? 140 : 220, start);
            source.frequency.exponentialRampToValueAtTime(note.key < 37 ? 45 : 90, start + 0.12);
            source.connect(gain);
        } else {
            if (!this.noise) {
                this.noise = context.createBuffer(1, context.sampleRate / 2, context.sampleRate);
                const samples = this.noise.getChannelData(0);
                let state = 1;
                for (let i = 0; i < samples.length; ++i) {
                    state = (Math.imul(state, 1664525) + 1013904223) | 0;
                    samples[i] = state / 2147483648;
                }
            }
            source = context.createBufferSource();
            source.buffer = this.noise;
            const filter = context.createBiquadFilter();
            filter.type = note.key < 41 ? "bandpass" : "highpass";
            filter.frequency.value = note.key < 41 ? 1800 : 6500;
            source.connect(filter).connect(gain);
        }
        const length = low ? 0.25 : [46, 49, 51, 57].includes(note.key) ? 0.45 : 0.12;
        gain.gain.setValueAtTime(loud * (low ? 1.8 : 0.9), start);
        gain.gain.exponentialRampToValueAtTime(0.0001, start + length);
        source.start(start);
        source.stop(start + length);
    }

    show() {
        if (!this.score) return;
        const clock = seconds => `${Math.floor(seconds / 60)}:${String(Math.floor(seconds % 60)).padStart(2, "0")}`;
        const now = Math.min(this.now(), this.score.length), share = this.score.length ? now / this.score.length : 0;
        this.slider.value = 1000 * share;
        this.slider.setAttribute("aria-valuetext", `${clock(now)} of ${clock(this.score.length)}`);
        this.clock.textContent = `${clock(now)} / ${clock(this.score.length)}`;
        this.line?.style.setProperty("left", `${100 * share}%`);
    }
}

for (const element of document.querySelectorAll("[data-midi]")) window.sikkuPlayer = new Player(element);
