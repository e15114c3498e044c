// Remembers the volume between visits.

const name = "sikku-volume";
const usual = 0.8;

export function rememberedVolume(): number {
    try {
        const value = Number(localStorage.getItem(name) ?? usual);
        return value >= 0 && value <= 1 ? value : usual;
    } catch {
        return usual; // no storage available
    }
}

export function rememberVolume(volume: number): void {
    try {
        localStorage.setItem(name, String(volume));
    } catch {
        // no storage available
    }
}
