// The sound of the studio without a browser: timing without drift, measurements of timbres, MIDI messages.
import assert from "node:assert/strict";
import { test } from "node:test";
import { load } from "./load.mjs";

const { readMelody, placeText, keyName, barsOf, barAt, barStart, beatsIn, secondsAt, tickAfter } = await load("sound/melody");
const { Transport } = await load("sound/transport");
const { MidiOutput, bentKey, channelOf, songPosition } = await load("sound/midi_output");
const { timbres, timbreOf, renderTimbre, renderedKey } = await load("sound/timbres");
const { levelOf } = await load("sound/sample");

const ticks = 480;
const rate = 44100;

function melodyOf(notes, { tempo = 120, end = 0, voices = 1, changes = [], upbeat = 0 } = {}) {
    const bytes = new Uint8Array(
        new Float64Array(
            notes.flatMap(([onset, duration, key = 60, voice = 0, velocity = 80]) => [
                onset,
                duration,
                key,
                velocity,
                voice,
                0,
                0,
                1,
                0,
                -1,
            ]),
        ).buffer,
    );
    const last = Math.max(end, ...notes.map(([onset, duration]) => onset + duration));
    const parts = [{ name: "part", scale: "major", program: 0, voices }];
    return readMelody({ count: notes.length, end: last, tempo, beats: 4, unit: 4, ticks, parts, changes, upbeat }, bytes);
}

/// Plays by an irregular clock, like a timer, and records the notes sent.
function player(melody) {
    const clock = { time: 3.1 };
    const heard = [];
    const sink = {
        note: (index, time, seconds) => heard.push({ index, time, seconds, handed: clock.time }),
        cancel(time) {
            for (let i = heard.length; i-- > 0;) if (heard[i].time > time) heard.splice(i, 1);
        },
        silence() {
            this.cancel(clock.time);
        },
    };
    const transport = new Transport(() => clock.time, [sink]);
    transport.setMelody(melody);
    transport.setTempo(melody.tempo);
    let step = 0;
    const run = (seconds) => {
        const until = clock.time + seconds;
        while (clock.time < until) {
            clock.time += [0.025, 0.0251, 0.031, 0.0249, 0.06][step++ % 5];
            transport.schedule();
        }
    };
    return { clock, heard, transport, run };
}

test("ten minutes at 117 quarters a minute: no note is off by a nanosecond, none is late or missing", () => {
    const count = 117 * 10 * 3; // triplets
    const melody = melodyOf(
        Array.from({ length: count }, (_, i) => [i * 160, 150]),
        { tempo: 117 },
    );
    const { heard, transport, run } = player(melody);
    transport.play();
    run(602);
    assert.equal(heard.length, count);
    const start = heard[0].time;
    let most = 0;
    heard.forEach((note, i) => {
        most = Math.max(most, Math.abs(note.time - start - (i * 60) / (117 * 3)));
        assert.ok(note.handed <= note.time, "handed over in time");
        assert.equal(note.index, i);
    });
    assert.ok(most < 1e-9, `drift of ${most} s`);
    assert.equal(transport.playing, false);
});

test("a change of tempo keeps the place, and hands over again what had not begun", () => {
    const melody = melodyOf(Array.from({ length: 400 }, (_, i) => [i * 120, 120]));
    const { clock, heard, transport, run } = player(melody);
    transport.play();
    run(5.01);
    const before = transport.tickAt(clock.time);
    transport.setTempo(93);
    assert.ok(Math.abs(transport.tickAt(clock.time) - before) < 1e-6);
    run(5);
    heard.forEach((note, i) => assert.equal(note.index, i, "each note once"));
    const gaps = heard.slice(1).map((note, i) => note.time - heard[i].time);
    assert.ok(Math.abs(gaps[2] - 0.125) < 1e-9);
    assert.ok(Math.abs(gaps.at(-1) - 60 / 93 / 4) < 1e-9);
});

// Two bars of 4/4 at 120 quarters a minute, three of 6/8 at 60, then 4/4 at 240.
const sections = [
    { onset: 3840, tempo: 60, beats: 6, unit: 8 },
    { onset: 8160, tempo: 240, beats: 4, unit: 4 },
];

test("sections are played in their own tempos, and all in one that is chosen", () => {
    const melody = melodyOf(Array.from({ length: 42 }, (_, i) => [i * 240, 240]), { changes: sections });
    const { heard, transport, run, clock } = player(melody);
    transport.setTempo(null);
    const secondsOf = (tick) =>
        tick <= 3840 ? tick / 960 : tick <= 8160 ? 4 + (tick - 3840) / 480 : 13 + (tick - 8160) / 1920;
    for (const tick of [0, 100, 3840, 5000, 8160, 10000]) {
        assert.ok(Math.abs(secondsAt(melody, tick, null) - secondsOf(tick)) < 1e-9);
        assert.ok(Math.abs(tickAfter(melody, secondsOf(tick), null) - tick) < 1e-6);
    }
    transport.play();
    run(20);
    assert.equal(heard.length, 42);
    const start = heard[0].time;
    heard.forEach((note, i) => {
        assert.ok(Math.abs(note.time - start - secondsOf(i * 240)) < 1e-9, `note ${i}`);
        assert.ok(Math.abs(note.seconds - (secondsOf(i * 240 + 240) - secondsOf(i * 240))) < 1e-9);
        assert.ok(note.handed <= note.time);
    });
    // A loop across both changes comes around in time.
    heard.length = 0;
    transport.setLoop({ from: 1920, to: 9120 });
    transport.seek(1920);
    transport.play();
    run(60);
    const pass = secondsOf(9120) - secondsOf(1920);
    heard.forEach((note, i) => {
        const expected = Math.floor(i / 30) * pass + secondsOf(1920 + (i % 30) * 240) - secondsOf(1920);
        assert.ok(Math.abs(note.time - heard[0].time - expected) < 1e-9);
    });
    const tick = transport.tickAt(clock.time);
    assert.ok(tick >= 1920 && tick < 9120);
    transport.setTempo(90);
    assert.ok(Math.abs(transport.tickAt(clock.time) - tick) < 1e-6);
    assert.ok(Math.abs(transport.secondsAt(9600) - (9600 / 480) * (60 / 90)) < 1e-9);
});

test("bars follow the meters of sections, and an upbeat is bar 0", () => {
    const melody = melodyOf([[0, 10080]], { changes: sections });
    assert.equal(barsOf(melody), 6);
    assert.deepEqual([0, 1, 2, 3, 4, 5, 6].map((bar) => barStart(melody, bar)), [0, 1920, 3840, 5280, 6720, 8160, 10080]);
    assert.equal(barAt(melody, 6000), 3.5);
    assert.deepEqual(beatsIn(melody, 2), [4080, 4320, 4560, 4800, 5040]);
    assert.equal(placeText(melody, 5530), "Bar 4 of 6, beat 2");
    const upbeat = melodyOf([[0, 4320]], { upbeat: 480 });
    assert.equal(placeText(upbeat, 100), "Bar 0 of 2, beat 4");
    assert.equal(placeText(upbeat, 480), "Bar 1 of 2, beat 1");
    assert.deepEqual([0, 1, 2].map((bar) => barStart(upbeat, bar)), [0, 480, 2400]);
});

test("a new melody while playing keeps the place", () => {
    const first = melodyOf(Array.from({ length: 100 }, (_, i) => [i * 240, 240]));
    const second = melodyOf(Array.from({ length: 200 }, (_, i) => [i * 120, 120, 72]));
    const { clock, heard, transport, run } = player(first);
    transport.play();
    run(4);
    const before = transport.tickAt(clock.time);
    transport.setMelody(second);
    assert.ok(Math.abs(transport.tickAt(clock.time) - before) < 1e-6);
    run(2);
    const after = heard.filter((note) => note.time > 3.1 + 4.2);
    assert.equal(second.onset[after[0].index] % 120, 0);
    for (const note of after.slice(1, -1)) {
        const tick = transport.tickAfter(before, note.time - clock.time);
        assert.ok(Number.isFinite(tick));
    }
});

test("a loop comes around without a gap, for ever on the beat", () => {
    const melody = melodyOf(Array.from({ length: 64 }, (_, i) => [i * 480, 480]));
    const { heard, transport, run, clock } = player(melody);
    transport.setLoop({ from: 4 * 480, to: 8 * 480 });
    transport.seek(4 * 480);
    transport.play();
    run(600);
    const start = heard[0].time;
    heard.forEach((note, i) => {
        assert.equal(note.index, 4 + (i % 4));
        assert.ok(Math.abs(note.time - start - i * 0.5) < 1e-9);
    });
    assert.ok(heard.length > 1190);
    const tick = transport.tickAt(clock.time);
    assert.ok(tick >= 4 * 480 && tick < 8 * 480);
});

test("a loop of rests does not hang", () => {
    const { transport, run, heard } = player(melodyOf([[0, 480], [9600, 480]]));
    transport.setLoop({ from: 1000, to: 1001 });
    transport.seek(1000);
    transport.play();
    run(1);
    assert.equal(heard.length, 0);
});

test("100 000 notes of 15 voices are in order, and playing from the middle looks at few of them", () => {
    const notes = [];
    for (let voice = 0; voice < 15; ++voice) for (let i = 0; i < 7000; ++i) notes.push([i * 60, 60, 60, voice]);
    const melody = melodyOf(notes, { voices: 15 });
    for (let i = 1; i < melody.count; ++i) assert.ok(melody.onset[i - 1] <= melody.onset[i]);
    const { heard, transport, run } = player(melody);
    const begin = performance.now();
    transport.seek(200_000);
    transport.play();
    run(1);
    assert.ok(performance.now() - begin < 200);
    assert.ok(heard.length > 100);
});

test("places are told by bars and beats", () => {
    const melody = melodyOf([[0, 480], [480 * 255, 480]]);
    assert.equal(barsOf(melody), 64);
    assert.equal(placeText(melody, 11 * 1920 + 2 * 480 + 7), "Bar 12 of 64, beat 3");
    assert.equal(placeText(melody, 1e9), "Bar 64 of 64, beat 4");
    assert.equal(keyName(60), "C4");
    assert.equal(keyName(60.14), "C4 +14 cents");
    assert.equal(keyName(58.8), "B3 −20 cents");
});

test("MIDI: a note that slides bends to its goal, and is struck anew beyond the range", () => {
    const numbers = [0, 480, 60, 80, 0, 0, 0, 1, 0, -1, 480, 480, 90, 80, 0, 1, 3, 2, 3, -1, 0, 240, 30];
    const bytes = new Uint8Array(new Float64Array(numbers).buffer);
    const parts = [{ name: "part", scale: "major", program: 0, voices: 1 }];
    const head = { count: 2, glides: 1, end: 960, tempo: 120, beats: 4, unit: 4, ticks: 480, parts };
    const melody = readMelody(head, bytes);
    assert.deepEqual([...melody.glides], [[0, { ticks: 240, semitones: 30 }]]);
    const sent = [];
    const output = new MidiOutput({ send: (bytes, time) => sent.push({ bytes, time }) }, (time) => time * 1000);
    output.melody = melody;
    output.setVoices([{ program: 40, isDrums: false, isHeard: true, volume: 0.5 }]);
    output.note(0, 1, 0.5);
    output.note(1, 1.5, 0.5);
    assert.ok(sent.some(({ bytes }) => bytes[0] === 0xb0 && bytes[1] === 6 && bytes[2] === 24));
    const keys = sent.filter(({ bytes }) => bytes[0] === 0x90).map(({ bytes }) => bytes[1]);
    assert.deepEqual(keys, [60, 84, 90]);
    assert.deepEqual(
        sent.filter(({ bytes }) => bytes[0] === 0x80).map(({ bytes }) => bytes[1]),
        [60, 84, 90],
    );
    // Between, the pitch rises evenly from half of the note on.
    let key = 60;
    for (const { bytes, time } of sent) {
        if (bytes[0] === 0x90) key = bytes[1];
        if (bytes[0] !== 0xe0 || time >= 1500 || bytes[1] + 128 * bytes[2] === 8192) continue;
        const pitch = key + (24 * (bytes[1] + 128 * bytes[2] - 8192)) / 8192;
        const line = 60 + (30 * (time - 1250)) / 250;
        // The bend comes before the key that is struck anew.
        if (key === 60 && line - pitch > 20) continue;
        assert.ok(Math.abs(pitch - line) < 0.7, `${pitch} ${line}`);
    }
});

test("MIDI: notes with times, bends for pitches between the keys, 24 clocks in a quarter, start, stop, all off", () => {
    const melody = melodyOf([[0, 480, 60], [480, 480, 61.5], [960, 480, 62]]);
    const sent = [];
    const output = new MidiOutput({ send: (bytes, time) => sent.push({ bytes, time }) }, (time) => time * 1000);
    output.melody = melody;
    output.setVoices([{ program: 40, isDrums: false, isHeard: true, volume: 0.5 }]);
    const clock = { time: 1 };
    const transport = new Transport(() => clock.time, [output]);
    transport.setMelody(melody);
    transport.play();
    for (; clock.time < 3; clock.time += 0.02) transport.schedule();
    const of = (status) => sent.filter(({ bytes }) => bytes[0] === status);
    assert.deepEqual(of(0xc0)[0].bytes, [0xc0, 40]);
    assert.equal(of(0xfa).length, 1);
    const start = of(0xfa)[0].time;
    assert.deepEqual(
        of(0x90).map(({ time }) => Math.round(time - start)),
        [0, 500, 1000],
    );
    const clocks = of(0xf8);
    assert.ok(clocks.length >= 72);
    clocks.slice(0, 72).forEach(({ time }, i) => assert.ok(Math.abs(time - start - (i * 500) / 24) < 1e-6));
    assert.deepEqual(of(0xe0)[0].bytes, [0xe0, 6144 & 127, 6144 >> 7]);
    assert.deepEqual(bentKey(61.5), { key: 62, bend: 8192 - 2048 });
    assert.equal(of(0xfc).length, 1);
    assert.equal(sent.filter(({ bytes }) => (bytes[0] & 0xf0) === 0xb0 && bytes[1] === 123).length, 16);
    assert.deepEqual(
        [0, 8, 9, 14, 15].map((voice) => channelOf(voice, false)),
        [0, 8, 10, 15, 0],
    );
    assert.deepEqual(songPosition(4 * 480, 480), [0xf2, 16, 0]);
});

/// The frequency near `expected`, from the phase difference between two windows.
function frequencyOf(data, expected) {
    const size = Math.min(16384, Math.floor(data.length / 2));
    const hop = Math.round(0.02 * rate);
    const first = Math.max(0, Math.min(2000, data.length - size - hop - 1));
    const phase = (begin) => {
        let re = 0;
        let im = 0;
        for (let i = 0; i < size; ++i) {
            const w = (0.5 - 0.5 * Math.cos((2 * Math.PI * i) / size)) * data[begin + i];
            re += w * Math.cos((2 * Math.PI * expected * i) / rate);
            im -= w * Math.sin((2 * Math.PI * expected * i) / rate);
        }
        return Math.atan2(im, re);
    };
    let beyond = phase(first + hop) - phase(first) - (2 * Math.PI * expected * hop) / rate;
    beyond -= 2 * Math.PI * Math.round(beyond / (2 * Math.PI));
    return expected + (beyond * rate) / (2 * Math.PI * hop);
}

/// The mean frequency, weighted by power, around the fundamental of a periodic signal.
function meanFrequency(data, expected) {
    const bin = rate / data.length;
    const centre = Math.round(expected / bin);
    const reach = Math.max(4, Math.round(centre * 0.04));
    let power = 0;
    let sum = 0;
    for (let k = centre - reach; k <= centre + reach; ++k) {
        let re = 0;
        let im = 0;
        const w = (2 * Math.PI * k) / data.length;
        for (let i = 0; i < data.length; ++i) {
            re += data[i] * Math.cos(w * i);
            im += data[i] * Math.sin(w * i);
        }
        power += re * re + im * im;
        sum += k * (re * re + im * im);
    }
    return (sum / power) * bin;
}

test("timbres: in tune within 2 cents, as loud as each other within 3 dB, without clipping and clicks", () => {
    const levels = [];
    for (const timbre of timbres) {
        for (const key of [43, 60, 76]) {
            const sample = renderTimbre(timbre, key, rate);
            const { data, frequency, loops } = sample;
            const name = `${timbre.name} ${key}`;
            let peak = 0;
            for (const value of data) {
                assert.ok(Number.isFinite(value), name);
                peak = Math.max(peak, Math.abs(value));
            }
            assert.ok(peak <= 1.251, `${name}: peak ${peak}`);
            levels.push({ name, level: 20 * Math.log10(levelOf(sample, rate)) });
            if (loops) {
                let step = 0;
                for (let i = 1; i < data.length; ++i) step = Math.max(step, Math.abs(data[i] - data[i - 1]));
                assert.ok(Math.abs(data[0] - data.at(-1)) <= step, `${name}: a seam`);
            } else {
                assert.ok(Math.abs(data.at(-1)) < 1e-4, `${name}: ends at ${data.at(-1)}`);
                assert.ok(Math.abs(data[0]) < 0.3, `${name}: begins at ${data[0]}`);
            }
            if (frequency === 0) continue;
            const found = loops
                ? key === 60
                    ? meanFrequency(data, frequency)
                    : frequency
                : frequencyOf(data, frequency);
            const cents = 1200 * Math.log2(found / frequency);
            assert.ok(Math.abs(cents) < 2, `${name}: ${cents.toFixed(2)} cents`);
        }
    }
    const loud = Math.max(...levels.map(({ level }) => level));
    const soft = levels.reduce((a, b) => (a.level < b.level ? a : b));
    assert.ok(loud - soft.level < 3, `${soft.name}: ${soft.level.toFixed(1)} of ${loud.toFixed(1)} dB`);
});

test("each instrument of General MIDI has a timbre, and keys are rendered near enough", () => {
    const used = new Set();
    for (let program = 0; program < 128; ++program) used.add(timbreOf(program).name);
    assert.ok(used.size > 28, `${used.size}`);
    assert.equal(timbreOf(73).name, "flute");
    assert.equal(timbreOf(104).name, "sitar");
    assert.equal(timbreOf(0).name, "piano");
    for (const timbre of timbres) {
        for (let key = 20; key < 110; key += 0.37) assert.ok(Math.abs(renderedKey(timbre, key) - key) <= 1.51);
    }
});
