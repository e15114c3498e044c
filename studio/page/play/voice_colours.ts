// A colour for each voice: distinct inks for light and dark paper.

const on_light = ["#a8442a", "#1f6f78", "#b07a12", "#5a4a9c", "#4c7a2f", "#9a3a72", "#2b5fa3", "#7a5a3a"];
const on_dark = ["#f08a66", "#62c4c8", "#e9b949", "#ab9cf0", "#9fce76", "#ea8fc0", "#7fb3f0", "#d0ab84"];

export function voiceColour(voice: number, isDark: boolean): string {
    const colours = isDark ? on_dark : on_light;
    return colours[voice % colours.length];
}
