// The patterns that the gallery shows first: one of each kind, all quick to draw.

export const picked: readonly string[] = [
    "snake-kolam",
    "anklets-of-krishna",
    "padi-kolam",
    "hilbert",
    "dragon",
    "penrose-rhombs",
    "hat",
    "abop-plant-f",
    "bush-3d",
    "lilac",
    "gosper-waltz",
    "hilbert-todi",
];

/// Kinds in the order in which the gallery shows them; others follow.
export const kinds: readonly string[] = [
    "kolams",
    "curves",
    "tilings",
    "plants",
    "melodies",
    "arrangements",
    "maps",
    "words",
    "kolam-library",
];

/// The name of a kind as the user sees it.
export function kindName(kind: string): string {
    return kind === "kolam-library" ? "kolams on grids" : kind;
}
