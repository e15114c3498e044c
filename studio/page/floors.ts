// Floors as grounds. Pictures of the page show their textures; the plane, which has no size in millimetres, and fields
// for colours show their mean colours.

const floors: Readonly<Record<string, string>> = {
    "red-earth": "#7e3c2c",
    "cow-dung": "#58583c",
    slate: "#404346",
    concrete: "#807b74",
};

/// The mean colour of a floor; any other ground as it is.
export function plainGround(text: string): string {
    return floors[text.trim().toLowerCase()] ?? text;
}
