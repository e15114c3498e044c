"""make_kolam(), radial_kolam() and read_kolam()."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
import sikku
from conftest import SOURCE, Run


@pytest.mark.parametrize(
    "arguments",
    [
        ["--grid", "7x7", "--seed", "4"],
        ["--grid", "1-3-5-3-1", "--symmetry", "C4", "--single-line", "--seed", "3"],
        ["--grid", "15-8 idukku pulli", "--density", "0.5", "--joined", "0.2", "--colours"],
        ["--grid", "3x3", "--crossings", "all", "--single-line", "--dots"],
        ["--grid", "5x5", "--crossings", "all", "--centred"],
        ["--grid", "3x21", "--period", "4", "--single-line", "--seed", "3"],
    ],
)
def test_kolams_are_those_of_the_program(arguments: list[str], run: Run, tmp_path: Path) -> None:
    file = tmp_path / "x.lsys"
    result = run("-q", "kolam", *arguments, "-o", str(file), "--json")
    values = dict(zip(arguments[::2], arguments[1::2])) if "--single-line" not in arguments else {}
    given = " ".join(arguments)
    made = sikku.make_kolam(
        arguments[1],
        seed=4 if "--seed 4" in given else 3 if "--seed 3" in given else 0,
        symmetry="C4" if "C4" in given else None,
        density=0.5 if "--density" in values else None,
        joined=0.2 if "--joined" in values else 0.0,
        crossings="all" if "--crossings" in given else None,
        period=4 if "--period 4" in given else 0,
        single_line="--single-line" in given,
        colours="--colours" in given,
        dots="--dots" in given,
        centred="--centred" in given,
    )
    assert made.pattern.text == file.read_text()
    assert made.facts == json.loads(result.stdout)


def test_radial_kolams_are_those_of_the_program(run: Run, tmp_path: Path) -> None:
    file = tmp_path / "x.lsys"
    run("-q", "kolam", "--radial", "8x5", "--order", "1-3-5-2-4", "-o", str(file))
    assert sikku.radial_kolam(8, 5, order=[1, 3, 5, 2, 4]).text == file.read_text()
    with pytest.raises(sikku.SettingError):
        sikku.radial_kolam(1, 5)


@pytest.mark.parametrize("name", ["x.png", "x.svg", "x.lsys"])
def test_kolams_are_read_back(name: str, tmp_path: Path) -> None:
    made = sikku.make_kolam("5x5", seed=2)
    if name == "x.lsys":
        (tmp_path / name).write_text(made.pattern.text)
    else:
        made.pattern.save(tmp_path / name, dots=True, size="80x80mm", **({"dpi": 150} if name == "x.png" else {}))
    read = sikku.read_kolam(tmp_path / name)
    assert read.facts["crossings"] == made.facts["crossings"]
    assert read.pattern.kolam()["lines"] == made.facts["lines"]
    fixed = sikku.read_kolam(tmp_path / name, fix=["1,1: turn", "1,2: cross"])
    assert fixed.facts["crossings"].startswith("01")
    assert [one["gap"] for one in fixed.facts["repaired"]] == [1, 2]


def test_photographs_with_an_expected_grid(tmp_path: Path) -> None:
    made = sikku.make_kolam("1-3-5-3-1", seed=2)
    file = tmp_path / "x.png"
    made.pattern.save(file, dots=True, size="80x80mm", dpi=150)
    whole = sikku.read_kolam(file, grid="5-1")
    assert whole.facts["crossings"] == made.facts["crossings"]
    assert whole.facts["completed"] == []
    side = 472
    for part in ({"crop": (2, 3, 465, 466)}, {"corners": [(0, 0), (side, 0), (side, side), (0, side)]}):
        assert sikku.read_kolam(file, **part).facts["crossings"] == made.facts["crossings"]  # type: ignore[arg-type]
    assert sikku.read_kolam(file, fix=["no dot 1,3"]).facts["dots"] == 12
    with pytest.raises(sikku.Error, match="found 13 dots .*; expected 25 dots"):
        sikku.read_kolam(file, grid="5x5")
    for wrong in ({"grid": "x"}, {"crop": (1, 2, 3)}, {"corners": [(1, 1)] * 4}, {"fix": ["dot 1,3"]}):
        with pytest.raises(sikku.SettingError, match=next(iter(wrong))):
            sikku.read_kolam(file, **wrong)  # type: ignore[arg-type]


def test_errors_of_kolams(tmp_path: Path) -> None:
    for arguments in (
        {"grid": "7y7"},
        {"grid": "5x7", "symmetry": "C4"},
        {"grid": "5x5", "density": 2},
        {"grid": "5x5", "crossings": "012"},
        {"grid": "5x5", "crossings": "all", "symmetry": "C4"},
        {"grid": "5x5", "seed": 1.5},
        {"grid": "5x5", "period": -1},
        {"grid": "7xfill"},
        {"grid": "7-4", "centred": True},
    ):
        with pytest.raises(sikku.SettingError):
            sikku.make_kolam(**arguments)  # type: ignore[arg-type]
    with pytest.raises(sikku.Error, match="single line"):
        sikku.make_kolam("4x4", symmetry="C4", single_line=True)
    with pytest.raises(sikku.NotFoundError):
        sikku.read_kolam(tmp_path / "missing.png")
    with pytest.raises(sikku.Error, match="unknown format"):
        sikku.read_kolam(SOURCE / "README.md")
    (tmp_path / "x.lsys").write_text(sikku.make_kolam("3x3").pattern.text)
    with pytest.raises(sikku.SettingError, match="lattice"):
        sikku.read_kolam(tmp_path / "x.lsys", lattice="round")
    with pytest.raises(sikku.SettingError, match="fix"):
        sikku.read_kolam(tmp_path / "x.lsys", fix=["9,9: cross"])
