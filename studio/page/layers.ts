// Chooses the cached tiles that show a view best.
import type { Camera, Size } from "./camera";
import type { Layer } from "./map_painter";
import type { TileLoader } from "./pictures";
import { seenTiles, tileBox, type TileGrid } from "./tiles";

const finest = -2.6; // octaves from the view's scale
const coarsest = 12;
const mostTiles = 160; // of a layer
const mostLayers = 6;

/// Layers of tiles, the best last; layers hidden by one that covers the view are left out.
export function layersOf(tiles: TileLoader, subject: string, camera: Camera, size: Size, grid: TileGrid): Layer[] {
    const layers: Layer[] = [];
    const scales = tiles
        .scalesOf(subject)
        .map((scale) => ({ scale, away: Math.log2(scale / camera.scale) }))
        .filter(({ away }) => away > finest && away < coarsest)
        .sort((one, other) => badness(one.away) - badness(other.away));
    for (const { scale } of scales) {
        const seen = seenTiles(camera, size, grid, scale, mostTiles);
        const pieces = seen.flatMap((tile) => {
            const bitmap = tiles.picture(subject, tile);
            return bitmap ? [{ bitmap, box: tileBox(tile, camera, size, grid) }] : [];
        });
        if (pieces.length === 0) continue;
        const isWhole = pieces.length === seen.length;
        layers.unshift({ isWhole, pieces });
        if (isWhole || layers.length >= mostLayers) break;
    }
    return layers;
}

// Finer tiles are better than equally distant coarser ones.
function badness(away: number): number {
    return away > 0 ? away : -away * 0.9;
}
