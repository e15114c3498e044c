"""tiles() and tile_counts()."""

from __future__ import annotations

import json
from typing import Any

import numpy
import pytest
import sikku
from conftest import Run

# Polygons that do not tile, too: gaps, overlaps and open outlines are reported.
NAMES = ["penrose-rhombs", "ammann-beenker", "chair", "hat", "spiral-tiling", "koch-island"]


def program_says(run: Run, name: str) -> dict[str, Any]:
    facts: dict[str, Any] = json.loads(run("tiling", name, "--json").stdout)
    return facts


def area(corners: Any) -> float:
    """The area of a polygon by the shoelace formula."""
    x, y = corners[:, 0], corners[:, 1]
    return float(x @ numpy.roll(y, -1) - y @ numpy.roll(x, -1)) / 2


@pytest.mark.parametrize("name", NAMES)
def test_tiles_are_those_of_the_program(name: str, run: Run) -> None:
    said = program_says(run, name)
    tiles = sikku.load(name).tiles()
    listed = said.pop("list")
    said.pop("border")
    assert tiles.certificate == said
    assert len(tiles) == len(listed) == said["tiles"]
    assert [one["tile"] for one in listed] == tiles.number.tolist()
    assert [one["shape"] for one in listed] == tiles.shape.tolist()
    assert [one["orientation"] for one in listed] == tiles.orientation.tolist()
    assert [one["colour"] for one in listed] == tiles.colour.tolist()
    assert [one["reflected"] for one in listed] == tiles.is_reflected.tolist()
    pairs = {tuple(pair) for pair in tiles.neighbours.tolist()}
    index = {one["tile"]: i for i, one in enumerate(listed)}
    assert pairs == {(i, index[other]) for i, one in enumerate(listed) for other in one["neighbours"] if i < index[other]}
    for one, corners in zip(listed, tiles.polygons):
        assert numpy.allclose(one["corners"], corners, atol=1e-8)


def test_tiles_cover_their_area_and_neighbours_differ() -> None:
    tiles = sikku.load("penrose-rhombs").tiles(5)
    assert tiles.certificate["tiling"] is True
    areas = [area(corners) for corners in tiles.polygons]
    assert min(areas) > 0  # anticlockwise
    assert sum(areas) == pytest.approx(tiles.certificate["area"])
    first, second = tiles.neighbours.T
    assert (tiles.neighbour_colour[first] != tiles.neighbour_colour[second]).all()
    assert tiles.neighbour_colour.max() + 1 <= 4
    thick = {letter for letter, shape in zip(tiles.letter, tiles.shape) if shape == tiles.shape[0]}
    assert "" not in tiles.letter and len(thick) < len(set(tiles.letter)) + 1


def test_arrays_have_the_documented_types() -> None:
    tiles = sikku.load("chair").tiles(2)
    assert tiles.corners.dtype == numpy.float64 and tiles.corners.shape[1] == 2
    assert tiles.begins.dtype == tiles.number.dtype == numpy.int64
    assert len(tiles.begins) == len(tiles) + 1 and tiles.begins[-1] == len(tiles.corners)
    assert tiles.shape.dtype == tiles.orientation.dtype == tiles.colour.dtype == numpy.int32
    assert tiles.neighbours.dtype == tiles.neighbour_colour.dtype == numpy.int32
    assert tiles.is_reflected.dtype == numpy.bool_


def test_counts_are_exact() -> None:
    counts = sikku.load("chair").tile_counts(60)
    assert counts["n"] == 60
    assert sum(one["count"] for one in counts["growth"]["counts"]) == 4**60  # a chair is cut into four


def test_what_has_no_tiles() -> None:
    nothing = sikku.load("hilbert", n=2).tiles()
    assert len(nothing) == 0 and nothing.polygons == []
    assert nothing.corners.shape == (0, 2) and nothing.neighbours.shape == (0, 2)
    with pytest.raises(sikku.PatternError, match="map"):
        sikku.load("checkers").tiles()
    with pytest.raises(sikku.Error):
        sikku.load("bush-3d", n=3).tiles()
    with pytest.raises(sikku.BudgetError):
        sikku.load("penrose-rhombs").tiles(budget=10)
