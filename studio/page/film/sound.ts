// Plays a melody into memory, with the voices of the page.
import { secondsAt, type Melody } from "../sound/melody";
import { Renderer } from "../sound/renderer";
import { SoundOutput, type VoiceSettings } from "../sound/sound_output";
import { timbreNamed, timbreOf } from "../sound/timbres";

const rate = 44_100;
const tail = 2.5; // seconds in which the last notes and the room die away
export const longest_sound = 300; // seconds

/// The voices that a melody has if none are chosen.
export function usualVoices(melody: Melody): VoiceSettings[] {
    return Array.from({ length: melody.voices }, (_, index) => {
        const part = melody.parts[melody.partOfVoice[index]!];
        const timbre = part?.drums ? "drums" : timbreOf(part?.program ?? 0).name;
        return { timbre, volume: 0.8, muted: false, solo: false };
    });
}

/// The seconds of a melody, without the time in which it dies away.
export function secondsOf(melody: Melody, tempo: number | null): number {
    return secondsAt(melody, melody.end, tempo);
}

/// Plays the first `longest_sound` seconds at most. @param tempo  quarter notes a minute; null: those of the melody
export async function renderSound(melody: Melody, voices: VoiceSettings[], tempo: number | null, volume: number): Promise<AudioBuffer> {
    const seconds = Math.min(secondsOf(melody, tempo), longest_sound);
    const onset = (note: number) => secondsAt(melody, melody.onset[note]!, tempo);
    const context = new OfflineAudioContext(2, Math.ceil((seconds + tail) * rate), rate);
    const renderer = new Renderer(context);
    try {
        const notes = Array.from({ length: melody.count }, (_, note) => note).filter(
            (note) => onset(note) < seconds,
        );
        const timbreOfNote = (note: number) => timbreNamed(voices[melody.voice[note]!]?.timbre ?? "piano");
        await renderer.prepare(notes.map((note) => [timbreOfNote(note), melody.key[note]!] as const));
        const output = new SoundOutput(context, renderer);
        output.melody = melody;
        output.setVoices(voices);
        output.master.setVolume(volume);
        for (const note of notes) {
            const end = secondsAt(melody, melody.onset[note]! + melody.duration[note]!, tempo);
            output.note(note, onset(note), end - onset(note));
        }
        return await context.startRendering();
    } finally {
        renderer.close();
    }
}
