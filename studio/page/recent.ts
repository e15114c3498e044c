// Caches the most recently used values, up to a number of bytes.

export class Recent<Thing extends { bytes: number; close(): void }> {
    private readonly things = new Map<string, Thing>(); // the most recently used last
    private used = 0;

    constructor(private readonly most: number) {}

    get bytes(): number {
        return this.used;
    }
    get count(): number {
        return this.things.size;
    }

    has(name: string): boolean {
        return this.things.has(name);
    }

    /// Returns the value and marks it as used.
    get(name: string): Thing | undefined {
        const thing = this.things.get(name);
        if (thing) {
            this.things.delete(name);
            this.things.set(name, thing);
        }
        return thing;
    }

    add(name: string, thing: Thing): void {
        this.remove(name);
        this.things.set(name, thing);
        this.used += thing.bytes;
        for (const [oldest] of this.things) {
            if (this.used <= this.most || oldest === name) break;
            this.remove(oldest);
        }
    }

    private remove(name: string): void {
        const thing = this.things.get(name);
        if (!thing) return;
        this.things.delete(name);
        this.used -= thing.bytes;
        thing.close();
    }
}
