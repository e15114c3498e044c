// Summarises the examination of a kolam in a sentence.
import { counted } from "../numbers_shown";
import type { Examined } from "../protocol";

function many(count: number, one: string, more: string): string {
    return count === 1 ? `One ${one}` : `${count.toLocaleString("en")} ${more}`;
}

/// `One closed line around 49 dots; symmetry D4.`
export function certificateText(found: Examined): string {
    const isOpen = found.open_lines > 0;
    const lines = many(found.lines, isOpen ? "line" : "closed line", isOpen ? "lines" : "closed lines");
    const dots = counted(found.dots.length, "dot");
    const symmetry = found.symmetry === "" || found.symmetry === "C1" ? "no symmetry" : `symmetry ${found.symmetry}`;
    const faults = found.faults.map((fault) => `; ${fault}`).join("");
    return `${lines} around ${dots}; ${symmetry}${faults}.`;
}
