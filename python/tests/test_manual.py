"""The tutorial and the examples of the manual run."""

from __future__ import annotations

import inspect
import re
import runpy
from pathlib import Path

import pytest
import sikku
from conftest import SOURCE
from sikku.outputs import Outputs


def test_the_tutorial_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    runpy.run_path(str(SOURCE / "python/tutorial.py"))
    assert (tmp_path / "kolam.pdf").exists()


@pytest.mark.filterwarnings("ignore::sikku.SikkuWarning")
def test_the_examples_of_the_manual_run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    blocks = re.findall(r"```python\n(.*?)```", (SOURCE / "docs/python.md").read_text(), re.DOTALL)
    assert len(blocks) >= 5
    names: dict[str, object] = {}
    for block in blocks:
        exec(block, names)


def test_everything_public_is_documented() -> None:
    for name in sikku.__all__:
        thing = getattr(sikku, name)
        assert inspect.getdoc(thing), name
        if inspect.isclass(thing) and thing.__module__ in ("sikku.data", "sikku.pattern"):
            inherited = vars(Outputs) if thing is sikku.Pattern else {}
            for member, value in {**vars(thing), **inherited}.items():
                if not member.startswith("_") and (inspect.isfunction(value) or isinstance(value, property)):
                    assert inspect.getdoc(value), f"{name}.{member}"
