"""Checked by mypy, never run: what the stub says about options."""

from __future__ import annotations

import sikku

kolam = sikku.load("snake-kolam")
svg: str = kolam.draw("svg", size="A3", dots=True, dpi=300)
usual: str = kolam.draw(step="7mm", stroke="0.3mm navy", my_define=3)
png: bytes = kolam.draw("png", dpi="300")
midi: bytes = kolam.play("mid", bars=8, scale="dorian", progress=print)
score: str = kolam.play("ly")
names: list[str] = kolam.save("x.pdf", size="A3", bars=4)
height, width, _ = kolam.pixels(dpi=96).shape
wrong: str = kolam.draw("svg", landscape="yes")  # type: ignore[assignment]
