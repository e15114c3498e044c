// Chooses the resolution of motion, so that it stays smooth on slow graphics.

const slowFrame = 26; // milliseconds
const coarsest = 0.36;

export class Pace {
    /// Resolution along each side, relative to the screen.
    quality = 1;
    private learned = 1; // for the next motion
    private last = 0;
    private slow = 0;

    frame(now: number): void {
        const passed = now - this.last;
        this.last = now;
        if (passed > 2500) return; // the first of a motion
        this.quality = this.learned;
        this.slow = passed > slowFrame ? this.slow + 1 : Math.max(0, this.slow - 0.25);
        if (this.slow < 3 || this.learned <= coarsest) return;
        this.slow = 0;
        this.quality = this.learned = this.learned * 0.7;
    }

    rest(): void {
        this.quality = 1;
        this.last = -1e9;
    }
}
