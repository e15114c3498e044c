// Writes sound as WAV: 16 bits, as many channels as are given.

/// @param channels  samples from -1 to 1, equally many in each
export function wavOf(channels: readonly Float32Array[], rate: number): Uint8Array {
    const count = channels[0]?.length ?? 0;
    const frame = 2 * channels.length; // bytes
    const bytes = new Uint8Array(44 + count * frame);
    const view = new DataView(bytes.buffer);
    const letters = (at: number, text: string) => {
        for (let i = 0; i < text.length; ++i) bytes[at + i] = text.charCodeAt(i);
    };
    letters(0, "RIFF");
    view.setUint32(4, 36 + count * frame, true);
    letters(8, "WAVEfmt ");
    view.setUint32(16, 16, true);
    view.setUint16(20, 1, true);
    view.setUint16(22, channels.length, true);
    view.setUint32(24, rate, true);
    view.setUint32(28, rate * frame, true);
    view.setUint16(32, frame, true);
    view.setUint16(34, 16, true);
    letters(36, "data");
    view.setUint32(40, count * frame, true);
    channels.forEach((samples, channel) => {
        for (let i = 0; i < count; ++i) {
            const sample = Math.max(-1, Math.min(1, samples[i]!));
            view.setInt16(44 + i * frame + 2 * channel, Math.round(sample * 32767), true);
        }
    });
    return bytes;
}
