"""Times the Python module: PYTHONPATH=build/python/python python3 tests/bench/python_bench.py"""

from __future__ import annotations

import collections
import time
from collections.abc import Callable

import sikku


def best(work: Callable[[], object], repeats: int = 5) -> float:
    """Seconds taken by the fastest of several runs."""
    times = []
    for _ in range(repeats):
        began = time.perf_counter()
        work()
        times.append(time.perf_counter() - began)
    return min(times)


def report(name: str, seconds: float, number: float, unit: str) -> None:
    print(f"{name:28} {seconds:7.3f} s  {seconds / number * 1e9:6.1f} ns a {unit}")


hilbert = sikku.load("hilbert")
dragon = sikku.load("dragon")
bush = sikku.load("bush-3d", n=9)
melody = sikku.load("hilbert-in-c", n=9)

for n in (10, 11, 12):
    report(f"path of hilbert, n = {n}", best(lambda: hilbert.path(n)), 4**n, "point")
report("path of dragon, n = 20", best(lambda: dragon.path(20)), len(dragon.path(20).points), "point")
report("path of bush-3d, n = 9", best(bush.path), len(bush.path().points), "point")
symbols = hilbert.with_settings(n=9).measure()["symbols"]
report("word of hilbert, n = 9", best(lambda: collections.deque(hilbert.word(9), maxlen=0)), symbols, "module")
report("notes of hilbert, n = 9", best(melody.notes), len(melody.notes()), "note")
report("load", best(lambda: sikku.load("snake-kolam")), 1, "pattern")
report("draw snake-kolam", best(sikku.load("snake-kolam").draw), 1, "print")
report("patterns", best(sikku.patterns), 1, "list")
