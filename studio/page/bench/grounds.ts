// The grounds that the bench offers, and how the board shows them.
export type GroundName = "earth" | "red-earth" | "cow-dung" | "slate" | "concrete" | "white";

export interface GroundLook {
    label: string;
    line: string; // of the pattern
    colour: string;
    ink: string; // of the lines and dots that are rice flour on other grounds
    mark: string; // of the gap under the pointer
    grain: number; // how rough it looks, 0 to 1
    tone: [r: number, g: number, b: number]; // of its light grains
}

const rice = "#fffaf0";
const lamp = "#ffd58a";
/// In the order in which they are offered. Floors have the mean colours of their textures.
export const grounds: Record<GroundName, GroundLook> = {
    "earth": { label: "Plain earth", line: "ground: #7d3324", colour: "#7d3324", ink: rice, mark: lamp, grain: 1, tone: [255, 196, 150] },
    "red-earth": { label: "Beaten red earth", line: "ground: red-earth", colour: "#7e3c2c", ink: rice, mark: lamp, grain: 1.8, tone: [255, 196, 150] },
    "cow-dung": { label: "Cow dung wash", line: "ground: cow-dung", colour: "#58583c", ink: rice, mark: lamp, grain: 1.6, tone: [226, 224, 160] },
    "slate": { label: "Slate", line: "ground: slate", colour: "#404346", ink: rice, mark: lamp, grain: 1.2, tone: [190, 206, 220] },
    "concrete": { label: "Concrete", line: "ground: concrete", colour: "#807b74", ink: rice, mark: lamp, grain: 1.4, tone: [240, 236, 228] },
    "white": { label: "White paper", line: "paper: white", colour: "#ffffff", ink: "#7d3324", mark: "#c4552f", grain: 0, tone: [0, 0, 0] },
};
export const ground_names = Object.keys(grounds) as GroundName[];

/// The ground that a pattern states in the words of the bench; plain earth for all others.
export function groundOf(text: string): GroundName {
    const lines = new Set(text.split("\n").map((line) => line.trim()));
    return ground_names.findLast((name) => lines.has(grounds[name].line)) ?? "earth";
}

/// True for a line that the bench writes.
export function isGroundLine(line: string): boolean {
    return ground_names.some((name) => grounds[name].line === line);
}
