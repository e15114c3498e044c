"""Runs the program and reads its reports."""

import re
import subprocess
from pathlib import Path

SECONDS = 120


class Program:
    def __init__(self, path: str):
        self.path = path

    def run(self, *arguments: str | Path) -> subprocess.CompletedProcess:
        try:
            return subprocess.run(
                [self.path, *map(str, arguments)], capture_output=True, text=True, timeout=SECONDS,
                stdin=subprocess.DEVNULL,
            )  # fmt: skip
        except subprocess.TimeoutExpired:
            return subprocess.CompletedProcess(arguments, 1, "", f"stopped after {SECONDS} s")

    def makes(self, command: str, pattern: Path, output: Path, *options: str) -> str:
        """Makes a file. Returns "", or the reason if it cannot be made."""
        done = self.run("-q", command, pattern, "-o", output, *options)
        return "" if done.returncode == 0 and output.exists() else reason_of(done)


def reason_of(failed: subprocess.CompletedProcess) -> str:
    return failed.stderr.strip() or f"exit status {failed.returncode}"


def table_of(report: str) -> list[tuple[str, str]]:
    """The lines of a report after its heading: a name in the first ten columns, and a text."""
    rows: list[tuple[str, str]] = []
    for line in report.splitlines()[1:]:
        match = re.match(r"([a-z][a-z ]*?)\s{2,}(.*)", line)
        if match:
            rows.append((match[1], match[2].strip()))
        elif rows and line.startswith(" ") and line.strip():
            rows[-1] = (rows[-1][0], rows[-1][1] + "; " + line.strip())
    return rows
