// Requests pictures of the whole view, coarse ones first if necessary, so that sliders move smoothly.
import type { Engine } from "./context";
import type { Overview } from "./map_painter";
import { bitmapAtOnce, isAbort, type Bitmap } from "./pictures";
import type { Pixels, Request } from "./protocol";

const slowPicture = 28; // milliseconds: if pictures take longer, they are coarser while a slider moves

export class Overviews {
    quality = 1; // of pictures while a slider moves
    private asked = ""; // name of the picture being made
    private refused = ""; // name of the picture that cannot be drawn
    private reason: unknown; // its error
    private count = 0; // number of requests
    private shown = 0; // number of the last picture received
    private readonly busy = [0, 0]; // requests in progress
    private fineTime = 0; // milliseconds for the last picture at full quality
    private isCoarseQuicker = true;

    /// @param take  receives a picture and the warnings of the libraries
    /// @param fail  receives the error
    constructor(
        private readonly engine: Engine,
        private readonly take: (overview: Overview, warnings: string[]) => void,
        private readonly fail: (error: unknown) => void,
    ) {}

    /// @param what  name of the picture, which is not requested again while it is being made or if it cannot be made
    /// @param fullRatio  its ratio at full quality
    async ask(what: string, request: Request, fullRatio: number, made: (bitmap: Bitmap) => Overview): Promise<void> {
        if (what === this.asked) return;
        if (what === this.refused) return this.fail(this.reason);
        this.asked = what;
        const number = ++this.count;
        const start = performance.now();
        try {
            const answer = await this.request(request);
            const overview = made(bitmapAtOnce(answer));
            if (number < this.shown) return overview.bitmap.close(); // superseded by a later picture
            this.shown = number;
            this.learn(performance.now() - start, overview.ratio / fullRatio);
            if (this.asked === what) this.asked = "";
            this.take(
                overview,
                answer.json.remarks.flatMap(({ is_warning, text }) => (is_warning ? [text] : [])),
            );
        } catch (error) {
            const isLast = this.asked === what;
            if (isLast) this.asked = "";
            if (isAbort(error)) return;
            this.refused = what;
            this.reason = error;
            if (isLast) this.fail(error);
        }
    }

    // If enough workers are available, two pictures are made at a time.
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

    // Makes coarser pictures if these are slow and coarser ones are faster.
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
