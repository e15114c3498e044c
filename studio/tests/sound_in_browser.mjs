// Measures the sound of the studio in headless Chromium, after all processing: peaks, levels, pitch, decay, ends of
// notes, and the timing of notes over ten minutes.
//     node tests/sound_in_browser.mjs
import assert from "node:assert/strict";
import { build } from "esbuild";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { launch } from "./browser.mjs";

const sound = join(dirname(fileURLToPath(import.meta.url)), "../page/sound");
const entry = `
    export { SoundOutput } from "./sound_output";
    export { timbres, timbreNamed, renderTimbre, renderedKey } from "./timbres";
    export { Transport } from "./transport";
    export { readMelody } from "./melody";
`;
const made = await build({
    stdin: { contents: entry, resolveDir: sound, loader: "ts" },
    bundle: true,
    write: false,
    format: "iife",
    globalName: "sikku",
    target: "es2022",
    logLevel: "warning",
});
const browser = await launch();
try {
    const page = await browser.newPage();
    await page.addScriptTag({ content: made.outputFiles[0].text });
    const rows = await page.evaluate(measure);
    for (const row of rows) {
        console.log(
            [
                row.name.padEnd(15),
                `level ${row.level.toFixed(1)} dB`,
                `peak ${row.peak.toFixed(1)} dB`,
                `full ${row.full.toFixed(1)} dB`,
                `centroid ${row.soft.toFixed(0)} to ${row.loud.toFixed(0)} Hz`,
                `decay ${row.decay.toFixed(2)} s`,
                `pitch ${row.cents.toFixed(2)} cents`,
                `end ${row.step.toFixed(4)}`,
            ].join("  "),
        );
    }
    const levels = rows.map(({ level }) => level);
    const spread = Math.max(...levels) - Math.min(...levels);
    console.log(`spread of levels ${spread.toFixed(1)} dB`);
    for (const row of rows) {
        assert.ok(row.full <= -0.99, `${row.name}: ${row.full} dBFS in a chord of twelve`);
        assert.ok(Math.abs(row.cents) < 2, `${row.name}: ${row.cents} cents`);
        assert.ok(row.step < 0.02, `${row.name}: a click at the end, ${row.step}`);
        assert.ok(row.loud >= row.soft || row.name === "drums", `${row.name}: soft notes are brighter`);
    }
    assert.ok(spread < 3, `levels differ by ${spread} dB`);
    const drift = await page.evaluate(tenMinutes);
    console.log(`ten minutes: ${drift.count} notes, off by at most ${(drift.most * 1000).toFixed(3)} ms`);
    assert.ok(drift.count === 1170 && drift.most < 0.0005);
} finally {
    await browser.close();
}

/// Runs in the page.
async function measure() {
    const { SoundOutput, timbres, renderTimbre, renderedKey } = globalThis.sikku;
    const rate = 44100;
    const decibels = (value) => 20 * Math.log10(Math.max(value, 1e-9));
    const render = async (timbre, notes, seconds, isDry = false) => {
        const context = new OfflineAudioContext(2, seconds * rate, rate);
        const output = new SoundOutput(context, {
            find(wanted, key) {
                const sample = renderTimbre(wanted, renderedKey(wanted, key), rate);
                const buffer = context.createBuffer(1, sample.data.length, rate);
                buffer.copyToChannel(sample.data, 0);
                return { buffer, frequency: sample.frequency, loops: sample.loops };
            },
        });
        output.setVoices([{ timbre: timbre.name, volume: 0.8, muted: false, solo: false }]);
        if (isDry) output.master.wet.disconnect();
        for (const [key, velocity, time, length] of notes) output.strike(0, key, velocity, time, length);
        const buffer = await context.startRendering();
        return buffer.getChannelData(0).map((value, i) => (value + buffer.getChannelData(1)[i]) / 2);
    };
    const level = (data, from, to) => {
        let sum = 0;
        for (let i = Math.round(from * rate); i < to * rate; ++i) sum += data[i] * data[i];
        return Math.sqrt(sum / ((to - from) * rate));
    };
    const peak = (data) => data.reduce((most, value) => Math.max(most, Math.abs(value)), 0);
    const centroid = (data, from) => {
        const size = 8192;
        let power = 0;
        let sum = 0;
        for (let k = 10; k < 1500; k += 4) {
            let re = 0;
            let im = 0;
            for (let i = 0; i < size; ++i) {
                const value = data[from + i] * (0.5 - 0.5 * Math.cos((2 * Math.PI * i) / size));
                re += value * Math.cos((2 * Math.PI * k * i) / size);
                im += value * Math.sin((2 * Math.PI * k * i) / size);
            }
            power += Math.hypot(re, im);
            sum += Math.hypot(re, im) * k;
        }
        return ((sum / power) * rate) / size;
    };
    // The lag of the greatest autocorrelation near many periods, between samples by a parabola.
    const pitch = (data, from, expected) => {
        const periods = Math.max(1, Math.floor(0.05 * expected));
        const middle = (periods * rate) / expected;
        const size = Math.round(0.12 * rate);
        let mean = 0;
        for (let i = 0; i < size; ++i) mean += data[from + i] / size;
        const at = (lag) => {
            let sum = 0;
            let energy = 0;
            for (let i = 0; i < size; ++i) {
                sum += (data[from + i] - mean) * (data[from + i + lag] - mean);
                energy += (data[from + i + lag] - mean) ** 2;
            }
            return sum / Math.sqrt(energy);
        };
        let best = Math.round(middle);
        const reach = Math.max(2, Math.round((0.3 * rate) / expected / 2));
        for (let lag = best - reach, most = -Infinity, centre = best; lag <= centre + reach; ++lag) {
            const value = at(lag);
            if (value > most) {
                most = value;
                best = lag;
            }
        }
        const [a, b, c] = [at(best - 1), at(best), at(best + 1)];
        return (periods * rate) / (best + (0.5 * (a - c)) / (a - 2 * b + c));
    };
    const rows = [];
    for (const timbre of timbres) {
        const key = timbre.everyKey ? 38 : 62.37; // a microtone
        const data = await render(timbre, [[key, 100, 0.1, 1.5]], 4);
        const soft = await render(timbre, [[key, 30, 0.1, 1.5]], 2);
        const loud = await render(timbre, [[key, 127, 0.1, 1.5]], 2);
        const chord = [];
        for (let i = 0; i < 12; ++i) chord.push([timbre.everyKey ? 36 + i : 40 + 4 * i, 127, 0.1 + 0.002 * i, 1]);
        const full = await render(timbre, chord, 2);
        let most = 0;
        if (timbre.lasts) most = level(data, 0.4, 1.6);
        else for (let t = 0.1; t < 1.3; t += 0.05) most = Math.max(most, level(data, t, t + 0.25));
        let decay = 0;
        for (let t = 0.15; t < 3.8; t += 0.05) if (level(data, t, t + 0.05) > most * 0.01) decay = t;
        const hertz = 440 * 2 ** ((key - 69) / 12);
        // The sharpest bend of the wave at the end of the note, relative to the sharpest within the note.
        let before = 0;
        let after = 0;
        const end = Math.round(1.6 * rate);
        for (let i = end - 6000; i < end - 50; ++i)
            before = Math.max(before, Math.abs(data[i] - 2 * data[i - 1] + data[i - 2]));
        for (let i = end - 50; i < end + 2000; ++i)
            after = Math.max(after, Math.abs(data[i] - 2 * data[i - 1] + data[i - 2]));
        const isWide = ["strings", "choir", "pad", "air", "pipe-organ", "accordion", "lead"].includes(timbre.name);
        const dry = await render(timbre, [[key, 100, 0.1, 1.5]], 2, true);
        const found = timbre.everyKey ? hertz : pitch(dry, Math.round((timbre.lasts ? 0.3 : 0.13) * rate), hertz);
        rows.push({
            name: timbre.name,
            level: decibels(most),
            peak: decibels(peak(data)),
            full: decibels(peak(full)),
            soft: centroid(soft, Math.round(0.15 * rate)),
            loud: centroid(loud, Math.round(0.15 * rate)),
            decay,
            cents: isWide ? 0 : 1200 * Math.log2(found / hertz), // ensembles have many pitches around one; see sound.test.mjs
            step: Math.max(0, after - before),
        });
    }
    return rows;
}

/// In the page: compares the time of each note with the expected one.
async function tenMinutes() {
    const { Transport, readMelody } = globalThis.sikku;
    const rate = 8000;
    const count = 117 * 10;
    const values = [];
    for (let i = 0; i < count; ++i) values.push(i * 480, 60, 72, 127, 0, 0, 0, 1, 0, -1);
    const melody = readMelody(
        {
            count,
            end: count * 480,
            tempo: 117,
            beats: 4,
            unit: 4,
            ticks: 480,
            parts: [{ name: "part", scale: "", program: 0, voices: 1 }],
        },
        new Uint8Array(new Float64Array(values).buffer),
    );
    const context = new OfflineAudioContext(1, 602 * rate, rate);
    const buffer = context.createBuffer(1, 64, rate);
    buffer.copyToChannel(new Float32Array(64).fill(0.9), 0);
    const clock = { time: 0 };
    const transport = new Transport(
        () => clock.time,
        [
            {
                note(index, time) {
                    const source = context.createBufferSource();
                    source.buffer = buffer;
                    source.connect(context.destination);
                    source.start(time);
                },
                cancel() {},
                silence() {},
            },
        ],
    );
    transport.setMelody(melody);
    transport.setTempo(117);
    transport.play();
    for (let i = 0; transport.playing && i < 40000; ++i) {
        clock.time += [0.025, 0.0253, 0.041, 0.0249][i % 4];
        transport.schedule();
    }
    const data = (await context.startRendering()).getChannelData(0);
    const onsets = [];
    for (let i = 1; i < data.length; ++i) {
        if (Math.abs(data[i]) > 0.3 && (onsets.length === 0 || i - onsets[onsets.length - 1] > 0.1 * rate))
            onsets.push(i);
    }
    let most = 0;
    onsets.forEach((onset, i) => {
        most = Math.max(most, Math.abs((onset - onsets[0]) / rate - (i * 60) / 117));
    });
    return { count: onsets.length, most };
}
