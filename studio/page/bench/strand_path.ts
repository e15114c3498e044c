// Traces a line as the libraries draw it: its points control a uniform cubic B-spline (engine/geometry/spline.h).

export interface Pen {
    moveTo(x: number, y: number): void;
    bezierCurveTo(x1: number, y1: number, x2: number, y2: number, x: number, y: number): void;
    closePath(): void;
}

/// Traces the closed curve of points x, y, x, y …
export function traceStrand(pen: Pen, points: readonly number[]): void {
    traceSegments(pen, points, 0, points.length / 2);
    pen.closePath();
}

/// Traces `count` pieces from the point `first`.
export function traceSegments(pen: Pen, points: readonly number[], first: number, count: number): void {
    const size = points.length / 2;
    const at = (i: number): number => 2 * (((i % size) + size) % size);
    for (let i = first; i < first + count; ++i) {
        const [a, b, c, d] = [at(i - 1), at(i), at(i + 1), at(i + 2)];
        const joint = (k: number, p: number, q: number, r: number): number =>
            (points[p + k] + 4 * points[q + k] + points[r + k]) / 6;
        if (i === first) pen.moveTo(joint(0, a, b, c), joint(1, a, b, c));
        pen.bezierCurveTo(
            (2 * points[b] + points[c]) / 3,
            (2 * points[b + 1] + points[c + 1]) / 3,
            (points[b] + 2 * points[c]) / 3,
            (points[b + 1] + 2 * points[c + 1]) / 3,
            joint(0, b, c, d),
            joint(1, b, c, d),
        );
    }
}
