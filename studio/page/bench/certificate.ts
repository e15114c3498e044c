// What the examination of a kolam has found, in a sentence.

/// The answer to `kolam`, as far as the bench shows it.
export interface Examined { kolam: boolean; faults: string[]; lines: number; open_lines: number; symmetry: string; dots: unknown[]; loose_dots: number }

const many = (count: number, one: string, more: string): string => `${count === 1 ? "One" : count.toLocaleString("en")} ${count === 1 ? one : more}`;

export function certificateText(found: Examined): string {
    const what = found.open_lines > 0 ? many(found.lines, "line", "lines") : many(found.lines, "closed line", "closed lines");
    const around = `${what} around ${found.dots.length.toLocaleString("en")} ${found.dots.length === 1 ? "dot" : "dots"}`;
    const faults = found.faults.length > 0 ? `; ${found.faults.join("; ")}` : "";
    const symmetry = found.symmetry === "" || found.symmetry === "C1" ? "no symmetry" : `symmetry ${found.symmetry}`;
    return `${around}; ${symmetry}${faults}.`;
}
