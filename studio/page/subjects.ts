// Short names for the subjects of pictures: a pattern and how it is drawn.

const mostCharacters = 16e6; // of all patterns that have names

export class Subjects {
    private readonly names = new Map<string, string>();
    private count = 0;
    private characters = 0;

    /// Equal subjects have equal names, as long as they are stored.
    nameOf(kind: string, ...subject: unknown[]): string {
        const text = JSON.stringify([kind, ...subject]);
        const known = this.names.get(text);
        if (known !== undefined) return known;
        const name = `${kind}-${++this.count}`;
        this.names.set(text, name);
        this.characters += text.length;
        for (const [oldest] of this.names) {
            if (this.characters < mostCharacters || oldest === text) break;
            this.names.delete(oldest);
            this.characters -= oldest.length;
        }
        return name;
    }
}
