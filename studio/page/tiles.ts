// Tiles of the endless plane, as in a web map: squares of a fixed size at each scale, counted from 0 0.
import { exactOf, exactText, wholes, type Exact } from "./decimal";
import { decimalsOf, pixelOf, pointAt, type Camera, type Size } from "./camera";

export interface Tile {
    readonly scale: number;
    readonly column: bigint;
    readonly row: bigint;
} // rows are counted upwards

export interface TileGrid {
    readonly side: number; // pixels of the picture
    readonly css: number; // the same in CSS pixels
}

/// The grid of tiles for which a tile is a whole number of screen pixels.
export function tileGrid(ratio: number): TileGrid {
    const side = Math.round(512 * ratio);
    return { side, css: side / ratio };
}

export function tileName(tile: Tile): string {
    return `${tile.scale} ${tile.column} ${tile.row}`;
}

/// The power of two nearest to a scale, for tiles that are used while the scale changes.
export function levelScale(scale: number): number {
    return 2 ** Math.round(Math.log2(scale));
}

function unitOf(grid: TileGrid, scale: number): Exact {
    const unit = exactOf(scale * grid.css);
    return unit > 0n ? unit : 1n;
}

/// The tiles of a scale that a view shows, from its centre outwards; at most `most`.
export function seenTiles(camera: Camera, size: Size, grid: TileGrid, scale: number, most = 400): Tile[] {
    const unit = unitOf(grid, scale);
    const low = pointAt(camera, size, 0, size.height);
    const high = pointAt(camera, size, size.width, 0);
    const first = { column: wholes(low.x, unit), row: wholes(low.y, unit) };
    const last = { column: wholes(high.x, unit), row: wholes(high.y, unit) };
    const columns = Number(last.column - first.column) + 1;
    const rows = Number(last.row - first.row) + 1;
    if (!(columns * rows <= most)) return [];
    const tiles: { tile: Tile; away: number }[] = [];
    for (let right = 0; right < columns; ++right) {
        for (let up = 0; up < rows; ++up) {
            const tile = { scale, column: first.column + BigInt(right), row: first.row + BigInt(up) };
            const box = tileBox(tile, camera, size, grid);
            const away = Math.hypot((box.left + box.right - size.width) / 2, (box.top + box.bottom - size.height) / 2);
            tiles.push({ tile, away });
        }
    }
    return tiles.sort((one, other) => one.away - other.away).map(({ tile }) => tile);
}

/// The position of a tile in the view, in CSS pixels.
export function tileBox(tile: Tile, camera: Camera, size: Size, grid: TileGrid) {
    const unit = unitOf(grid, tile.scale);
    const low = pixelOf(camera, size, tile.column * unit, tile.row * unit);
    const high = pixelOf(camera, size, (tile.column + 1n) * unit, (tile.row + 1n) * unit);
    return { left: low.left, top: high.top, right: high.left, bottom: low.top };
}

/// The part of the plane that a tile shows, as the `window` of a request.
export function tileWindow(tile: Tile, grid: TileGrid): [string, string, string, string] {
    const unit = unitOf(grid, tile.scale);
    const decimals = decimalsOf(tile.scale) + 6;
    const text = (count: bigint) => exactText(count * unit, decimals);
    return [text(tile.column), text(tile.row), text(tile.column + 1n), text(tile.row + 1n)];
}
