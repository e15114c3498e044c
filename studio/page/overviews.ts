// Asks for pictures of the whole view: the first quickly, perhaps coarse, so that a slider moves smoothly.
import type { Engine } from "./context";
import type { Overview } from "./map_painter";
import { bitmapAtOnce, isAbort, type Bitmap } from "./pictures";
import type { Pixels, Request } from "./protocol";

const slowPicture = 28; // milliseconds: slower pictures are made coarser while a slider moves

export class Overviews {
    quality = 1; // of pictures while a slider moves
    private asked = ""; // what is being made
    private refused = ""; // what cannot be drawn
    private count = 0; // of pictures asked for
    private shown = 0; // number of the last that has come
    private readonly busy = [0, 0]; // requests under way
    private fineTime = 0; // milliseconds that the last at full quality took
    private isCoarseQuicker = true;

    /// @param take  gets a picture and the warnings of the libraries
    /// @param fail  gets what went wrong
    constructor(
        private readonly engine: Engine,
        private readonly take: (overview: Overview, warnings: string[]) => void,
        private readonly fail: (error: unknown) => void,
    ) {}

    /// @param what  name of the picture: one that is being made, or cannot be made, is not asked for again
    /// @param fullRatio  its ratio at full quality
    async ask(what: string, request: Request, fullRatio: number, made: (bitmap: Bitmap) => Overview): Promise<void> {
        if (what === this.asked || what === this.refused) return;
        this.asked = what;
        const number = ++this.count;
        const start = performance.now();
        try {
            const answer = await this.request(request);
            const overview = made(bitmapAtOnce(answer));
            if (number < this.shown) return overview.bitmap.close(); // a later one was quicker
            this.shown = number;
            this.learn(performance.now() - start, overview.ratio / fullRatio);
            if (this.asked === what) this.asked = "";
            this.take(
                overview,
                answer.json.remarks.flatMap(({ is_warning, text }) => (is_warning ? [text] : [])),
            );
        } catch (error) {
            if (this.asked === what) this.asked = "";
            if (isAbort(error)) return;
            this.refused = what;
            this.fail(error);
        }
    }

    // With workers to spare, two pictures are made at a time.
    private async request(request: Request) {
        const slots = this.engine.workers >= 4 ? 2 : 1;
        const slot = slots > 1 && this.busy[0]! > this.busy[1]! ? 1 : 0;
        ++this.busy[slot]!;
        try {
            return await this.engine.request<Pixels>(request, { key: `map-${slot}`, lane: "front" });
        } finally {
            --this.busy[slot]!;
        }
    }

    // Coarser pictures are made if these are slow and coarser ones are quicker.
    private learn(milliseconds: number, quality: number): void {
        if (quality >= 1) {
            const isNew = milliseconds > 2 * this.fineTime || milliseconds < this.fineTime / 2;
            if (isNew) this.isCoarseQuicker = true;
            this.fineTime = milliseconds;
        } else if (milliseconds > 0.75 * this.fineTime) {
            this.isCoarseQuicker = false;
        }
        this.quality = milliseconds < slowPicture || !this.isCoarseQuicker ? 1 : 0.5;
    }
}
