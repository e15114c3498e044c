// The times at which notes are played. All times are computed from whole ticks and one anchor, so that rounding errors
// do not accumulate.
import type { Melody } from "./melody";
import { eachSounding, firstFrom, secondsAt, tempoAt, tickAfter } from "./melody";

/// Receives notes. Times are in seconds of the clock.
export interface NoteSink {
    note(index: number, time: number, seconds: number): void;
    /// Cancels notes that begin after this time; sounding notes continue.
    cancel(time: number): void;
    silence(): void;
    started?(tick: number, time: number): void;
    stopped?(time: number): void;
    clock?(time: number): void; // 24 times per quarter note
}

export interface Loop {
    from: number;
    to: number;
} // ticks

const lead = 0.06; // seconds from pressing the key to the first note
const clocks = 24; // per quarter note, as in MIDI

export class Transport {
    ahead = 0.25; // seconds by which notes are sent in advance
    playing = false;
    onEnd: () => void = () => {};

    private melody: Melody | null = null;
    private chosen: number | null = null; // quarter notes per minute; null: those of the melody
    private loopRange: Loop | null = null;
    private anchorTick = 0;
    private anchorTime = 0;
    private next = 0; // note
    private pass = 0; // of the loop
    private nextClock = 0;

    constructor(
        private readonly now: () => number,
        private readonly sinks: NoteSink[],
    ) {}

    /// Quarter notes per minute for the whole piece; null: it has its own tempos.
    get tempo(): number | null {
        return this.chosen;
    }
    /// Quarter notes per minute at a tick.
    tempoAt(tick: number): number {
        return this.melody ? tempoAt(this.melody, tick, this.chosen) : (this.chosen ?? 120);
    }
    /// Seconds from the beginning of the melody to a tick.
    secondsAt(tick: number): number {
        return this.melody ? secondsAt(this.melody, tick, this.chosen) : 0;
    }
    /// The tick that is played some seconds after another, without loops.
    tickAfter(tick: number, seconds: number): number {
        return this.melody ? tickAfter(this.melody, this.secondsAt(tick) + seconds, this.chosen) : tick;
    }
    get loop(): Loop | null {
        return this.loopRange;
    }

    /// The position in the melody at a time of the clock.
    tickAt(time: number): number {
        if (!this.playing) return this.anchorTick;
        const passed = this.secondsAt(this.anchorTick) + Math.max(0, time - this.anchorTime);
        const loop = this.activeLoop();
        const end = loop ? this.secondsAt(loop.to) : Infinity;
        if (!loop || passed < end) return Math.min(this.tickAfter(0, passed), this.melody?.end ?? 0);
        return this.tickAfter(loop.from, (passed - end) % (end - this.secondsAt(loop.from)));
    }

    /// A loop that ends before the anchor is not entered again.
    private activeLoop(): Loop | null {
        return this.loopRange && this.anchorTick < this.loopRange.to ? this.loopRange : null;
    }

    /// The time of a tick, counted from the anchor without loops: beyond the end of a loop, its ticks follow again.
    private timeOf(straight: number): number {
        const loop = this.activeLoop();
        let seconds = -this.secondsAt(this.anchorTick);
        if (loop && straight > loop.to) {
            const ticks = loop.to - loop.from;
            const passes = Math.floor((straight - loop.to) / ticks);
            const from = this.secondsAt(loop.from);
            const end = this.secondsAt(loop.to);
            seconds += end + passes * (end - from) - from;
            seconds += this.secondsAt(loop.from + (straight - loop.to - passes * ticks));
        } else {
            seconds += this.secondsAt(straight);
        }
        return this.anchorTime + seconds;
    }

    private straight(onset: number): number {
        const loop = this.activeLoop();
        if (!loop || this.pass === 0) return onset;
        return loop.to + (this.pass - 1) * (loop.to - loop.from) + (onset - loop.from);
    }

    play(): void {
        if (!this.melody || this.playing) return;
        if (this.anchorTick >= this.melody.end - 1e-6) this.anchorTick = this.loopRange?.from ?? 0;
        this.playing = true;
        this.begin(this.now() + lead);
        for (const sink of this.sinks) sink.started?.(this.anchorTick, this.anchorTime);
        this.schedule();
    }

    pause(): void {
        if (!this.playing) return;
        const now = this.now();
        const tick = this.tickAt(now);
        this.playing = false;
        this.anchorTick = tick;
        for (const sink of this.sinks) {
            sink.silence();
            sink.stopped?.(now);
        }
    }

    seek(tick: number): void {
        const target = Math.min(Math.max(0, tick), this.melody?.end ?? 0);
        this.anchorTick = target;
        if (!this.playing) return;
        for (const sink of this.sinks) sink.silence();
        this.begin(this.now() + lead / 2);
        for (const sink of this.sinks) sink.started?.(target, this.anchorTime);
        this.schedule();
    }

    /// Starts the notes that began before the anchor, and continues with those that begin there.
    private begin(time: number): void {
        const melody = this.melody!;
        this.anchorTime = time;
        this.pass = 0;
        this.next = firstFrom(melody, this.anchorTick);
        this.nextClock = Math.ceil((this.anchorTick * clocks) / melody.ticks - 1e-9);
        eachSounding(melody, this.anchorTick, this.anchorTick + 1e-9, (index) => {
            const left = melody.onset[index] + melody.duration[index] - this.anchorTick;
            if (melody.onset[index] < this.anchorTick) this.hand(index, time, this.anchorTick, left);
        });
    }

    /// @param tempo  quarter notes per minute for the whole piece; null: the tempos of the melody
    setTempo(tempo: number | null): void {
        if (tempo === this.chosen || (tempo !== null && !(tempo > 0))) return;
        this.keepingPlace(() => {
            this.chosen = tempo;
        });
    }

    setLoop(loop: Loop | null): void {
        this.keepingPlace(() => {
            this.loopRange = loop && loop.to > loop.from ? loop : null;
        });
    }

    setMelody(melody: Melody | null): void {
        this.keepingPlace(() => {
            this.melody = melody;
        });
        if (!melody && this.playing) this.pause();
    }

    /// Sends notes that have not begun again, at their new times.
    private keepingPlace(change: () => void): void {
        if (!this.playing || !this.melody) {
            change();
            this.anchorTick = Math.min(this.anchorTick, this.melody?.end ?? 0);
            return;
        }
        const now = Math.max(this.now(), this.anchorTime);
        const tick = this.tickAt(now);
        change();
        if (!this.melody) return;
        for (const sink of this.sinks) sink.cancel(now);
        this.anchorTick = Math.min(tick, this.melody.end);
        this.anchorTime = now;
        this.pass = 0;
        // A note at exactly this time has begun.
        this.next = firstFrom(this.melody, this.anchorTick + 1e-6);
        this.nextClock = Math.floor((this.anchorTick * clocks) / this.melody.ticks) + 1;
        this.schedule();
    }

    /// Sends the notes of the next moment; called every few milliseconds.
    schedule(): void {
        const melody = this.melody;
        if (!this.playing || !melody) return;
        const now = this.now();
        const until = now + this.ahead;
        const loop = this.activeLoop();
        for (;;) {
            if (loop && (this.next >= melody.count || melody.onset[this.next] >= loop.to)) {
                const again = loop.to + this.pass * (loop.to - loop.from);
                if (this.timeOf(again) > until) break; // the next pass comes later
                ++this.pass;
                this.next = firstFrom(melody, loop.from);
                continue;
            }
            if (this.next >= melody.count) break;
            const onset = melody.onset[this.next];
            const time = this.timeOf(this.straight(onset));
            if (time > until) break;
            const end = loop
                ? Math.min(onset + melody.duration[this.next], loop.to)
                : onset + melody.duration[this.next];
            this.hand(this.next, time, onset, end - onset);
            ++this.next;
        }
        this.sendClocks(until, melody);
        if (!loop && now >= this.timeOf(melody.end)) this.finish(melody);
    }

    private hand(index: number, time: number, from: number, ticks: number): void {
        const seconds = Math.max(0.01, this.secondsAt(from + ticks) - this.secondsAt(from));
        for (const sink of this.sinks) sink.note(index, time, seconds);
    }

    private sendClocks(until: number, melody: Melody): void {
        for (; ; ++this.nextClock) {
            const time = this.timeOf((this.nextClock * melody.ticks) / clocks);
            if (time > until) break;
            for (const sink of this.sinks) sink.clock?.(time);
        }
    }

    private finish(melody: Melody): void {
        this.playing = false;
        this.anchorTick = melody.end;
        for (const sink of this.sinks) sink.stopped?.(this.now());
        this.onEnd();
    }
}
