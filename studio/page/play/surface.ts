// A canvas that fills its element at the resolution of the screen.
import { element } from "../elements";
import { isDark } from "../layout";

export interface Ink {
    raised: string;
    line: string;
    strong: string;
    ink: string;
    faint: string;
    accent: string;
    isDark: boolean;
}

/// The present colours of the page.
export function readInk(): Ink {
    const style = getComputedStyle(document.documentElement);
    const of = (name: string) => style.getPropertyValue(`--${name}`).trim();
    return {
        raised: of("raised"),
        line: of("line"),
        strong: of("line-strong"),
        ink: of("ink"),
        faint: of("ink-faint"),
        accent: of("accent"),
        isDark: isDark(),
    };
}

export class Surface {
    readonly context: CanvasRenderingContext2D;
    width = 1; // CSS pixels
    height = 1;
    ratio = 1;

    constructor(
        readonly canvas: HTMLCanvasElement,
        changed: () => void,
        private readonly finest = 3, // pixels of the screen per CSS pixel
    ) {
        this.context = canvas.getContext("2d")!;
        new ResizeObserver(() => {
            if (this.fit()) changed();
        }).observe(canvas);
    }

    /// True if the size has changed.
    fit(): boolean {
        const { clientWidth, clientHeight } = this.canvas;
        const ratio = Math.min(this.finest, window.devicePixelRatio || 1);
        if (clientWidth === 0 || clientHeight === 0) return false;
        if (clientWidth === this.width && clientHeight === this.height && ratio === this.ratio) return false;
        this.width = clientWidth;
        this.height = clientHeight;
        this.ratio = ratio;
        this.canvas.width = Math.round(clientWidth * ratio);
        this.canvas.height = Math.round(clientHeight * ratio);
        this.context.setTransform(ratio, 0, 0, ratio, 0, 0);
        return true;
    }

    /// Another canvas of the same size, for parts that do not change.
    layer(): CanvasRenderingContext2D {
        const { width, height } = this.canvas;
        const canvas = element("canvas", { width, height });
        const context = canvas.getContext("2d")!;
        context.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
        return context;
    }

    put(layer: CanvasRenderingContext2D): void {
        this.context.drawImage(layer.canvas, 0, 0, this.width, this.height);
    }
}
