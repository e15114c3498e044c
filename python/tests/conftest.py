"""Runs the command-line program for comparison."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path
from typing import Protocol

import pytest

SOURCE = Path(__file__).resolve().parents[2]


class Run(Protocol):
    def __call__(self, *arguments: str) -> subprocess.CompletedProcess[bytes]: ...


@pytest.fixture(scope="session")
def program() -> Path:
    """The program, from the environment or the build folder of ./check."""
    return Path(os.environ.get("SIKKU_PROGRAM", SOURCE / "build/dev/bin/sikku"))


@pytest.fixture(scope="session")
def run(program: Path) -> Run:
    def run_program(*arguments: str) -> subprocess.CompletedProcess[bytes]:
        return subprocess.run([program, *arguments], capture_output=True, timeout=60)

    return run_program
