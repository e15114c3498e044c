// The effects on the sum of all voices: reverb, and a limiter.
import { makeChance } from "./chance";

const ceiling = 0.891; // -1 dBFS
const room_seconds = 2.1;

export class Master {
    readonly dry: GainNode;
    readonly wet: GainNode;
    readonly analyser: AnalyserNode;
    private readonly volume: GainNode;

    constructor(private readonly context: BaseAudioContext) {
        this.dry = context.createGain();
        this.wet = context.createGain();
        this.volume = context.createGain();
        const room = context.createConvolver();
        room.normalize = false;
        room.buffer = impulse(context);
        const high = context.createBiquadFilter();
        high.type = "highpass";
        high.frequency.value = 180;
        const compressor = context.createDynamicsCompressor();
        compressor.threshold.value = -12;
        compressor.knee.value = 12;
        compressor.ratio.value = 8;
        compressor.attack.value = 0.003;
        compressor.release.value = 0.2;
        const input = context.createGain();
        input.gain.value = 1 / clip_range;
        const clip = context.createWaveShaper();
        clip.curve = clipCurve();
        this.analyser = context.createAnalyser();
        this.analyser.fftSize = 1024;
        this.wet.connect(high).connect(room).connect(this.volume);
        this.dry.connect(this.volume);
        this.volume
            .connect(compressor)
            .connect(input)
            .connect(clip)
            .connect(this.analyser)
            .connect(context.destination);
        this.setVolume(0.8);
    }

    /// Sets the volume, from 0 to 1.
    setVolume(share: number): void {
        this.volume.gain.setTargetAtTime(1.8 * share * share, this.context.currentTime, 0.015);
    }
}

const clip_range = 4;

/// The curve of the limiter: linear up to two thirds of the ceiling, then bending towards it, and constant beyond.
function clipCurve(): Float32Array<ArrayBuffer> {
    const size = 8193;
    const knee = 0.66 * ceiling;
    const curve = new Float32Array(size);
    for (let i = 0; i < size; ++i) {
        const x = clip_range * ((2 * i) / (size - 1) - 1);
        const beyond = Math.max(0, Math.abs(x) - knee) / (ceiling - knee);
        curve[i] = Math.sign(x) * (Math.min(Math.abs(x), knee) + (ceiling - knee) * Math.tanh(beyond));
    }
    return curve;
}

/// The impulse response of a room: noise that decays and darkens, and a few early echoes.
function impulse(context: BaseAudioContext): AudioBuffer {
    const rate = context.sampleRate;
    const length = Math.round(room_seconds * rate);
    const buffer = context.createBuffer(2, length, rate);
    for (let channel = 0; channel < 2; ++channel) {
        const data = buffer.getChannelData(channel);
        const chance = makeChance(channel + 1);
        let low = 0;
        let power = 0;
        for (let i = 0; i < length; ++i) {
            const time = i / rate;
            const cutoff = 600 + 8400 * Math.exp(-time / 0.45);
            low += (1 - Math.exp((-2 * Math.PI * cutoff) / rate)) * (2 * chance() - 1 - low);
            const swell = Math.min(1, time / 0.012);
            data[i] = low * swell * Math.exp((-6.9 * time) / room_seconds);
        }
        for (let echo = 0; echo < 7; ++echo)
            data[Math.round((0.008 + 0.05 * chance()) * rate)] += 0.5 * (chance() - 0.5);
        const fade = Math.round(0.05 * rate);
        for (let i = 0; i < fade; ++i) data[length - 1 - i] *= i / fade;
        for (const value of data) power += value * value;
        const factor = 1 / Math.sqrt(power);
        for (let i = 0; i < length; ++i) data[i] *= factor;
    }
    return buffer;
}
