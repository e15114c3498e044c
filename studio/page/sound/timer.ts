// A timer in a worker, because browsers slow down the timers of pages in the background.

const source = `let timer;
onmessage = ({ data }) => {
    clearInterval(timer);
    if (data) timer = setInterval(() => postMessage(0), data);
};`;

export class Timer {
    private worker: Worker | null = null;
    private fallback = 0;

    constructor(private readonly tick: () => void) {
        try {
            const address = URL.createObjectURL(new Blob([source], { type: "text/javascript" }));
            this.worker = new Worker(address);
            this.worker.onmessage = () => this.tick();
        } catch {
            this.worker = null; // a browser without workers from a Blob
        }
    }

    start(milliseconds: number): void {
        if (this.worker) this.worker.postMessage(milliseconds);
        else this.fallback = window.setInterval(this.tick, milliseconds);
    }

    stop(): void {
        this.worker?.postMessage(0);
        clearInterval(this.fallback);
    }
}
