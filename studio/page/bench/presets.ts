// The grids that the bench offers.

/// Grids by the names that people use, with their notation where that differs.
export const presets: [string, (string | [string, string])[]][] = [
    ["Ner pulli (straight)", ["7 to 1 ner pulli", "9 to 1 ner pulli", "13 to 1 ner pulli", "11 to 5 ner pulli"]],
    ["Squares and rectangles", ["3x3", "5x5", "7x7", "9x9", "11x11", "15x15", "4x7", "6x10"]],
    ["Idukku pulli (interlaced)", [
        "3-2 idukku", "5-3 idukku", "7-4 idukku", "9-5 idukku", "11-6 idukku", "13-7 idukku", "15-8 idukku", "7x7 idukku",
    ]],
    ["Blocks", ["15x9-9x3", "9x5-5x2", "7x3 to 3"]],
    ["Free shapes", [
        ["Triangle of 21 dots", "1-2-3-4-5-6"],
        ["Star of 37 dots", "1-2-7-6-5-6-7-2-1"],
        ["Pyramid of 25 dots", "1-3-5-7-9"],
        ["Hourglass", "7-5-3-1-3-5-7"],
        ["Frame", "ooooooo/ooooooo/oo...oo/oo...oo/oo...oo/ooooooo/ooooooo"],
        ["Pinwheel", "..oo.../..oo.../..ooooo/ooooooo/ooooo../...oo../...oo.."],
        ["Heart", ".oo.oo./ooooooo/ooooooo/.ooooo./..ooo../...o..."],
    ]],
];
