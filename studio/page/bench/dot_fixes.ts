// Dots added and removed by hand, in the words of `sikku kolam --fix`.
import type { Place } from "./dot_grid";

const isSame = (a: Place) => (b: Place): boolean => a.x === b.x && a.level === b.level;

/// `dot 0,3` by row and place, which count from 1 at the top and at the left side of the grid's box.
function address(dots: Place[], place: Place): string {
    const top = Math.max(...dots.map(({ level }) => level));
    const across = place.x - Math.min(...dots.map(({ x }) => x));
    return `dot ${(top - place.level) / 2 + 1},${Math.floor(across / 2) + 1}`;
}

/// The fixes that make some dots of others. Each of them counts in the grid that those before it have made.
export function dotFixes(before: readonly Place[], after: readonly Place[]): string[] {
    const dots = [...before];
    const fixes: string[] = [];
    for (const place of after) {
        if (before.some(isSame(place))) continue;
        fixes.push(address(dots, place));
        dots.push(place);
    }
    for (const place of before) {
        if (after.some(isSame(place))) continue;
        fixes.push(`no ${address(dots, place)}`);
        dots.splice(dots.findIndex(isSame(place)), 1);
    }
    return fixes;
}
