#!/usr/bin/env python3
"""Writes the licence of each library into a folder, one file per library, with the common licences that it refers to,
and `components.tsv`, a list of the libraries.

usage: packaging/licences.py program|module FOLDER LIST [SLIM]

LIST is a file with the paths of shared libraries, a line each; SLIM is the folder of an OpenImageIO that is not Debian's.
"""

import re
import shutil
import sys
from pathlib import Path

from components import MODULE_HEADERS, PROGRAM_HEADERS, of_libraries, of_packages

if len(sys.argv) not in (4, 5) or sys.argv[1] not in ("program", "module"):
    sys.exit(__doc__)
headers = PROGRAM_HEADERS if sys.argv[1] == "program" else MODULE_HEADERS
folder = Path(sys.argv[2])
folder.mkdir(parents=True, exist_ok=True)
slim = Path(sys.argv[4]) if len(sys.argv) == 5 else None
rows = []
common = Path("/usr/share/common-licenses")
for component in sorted({*of_packages(headers), *of_libraries(Path(sys.argv[3]).read_text().split(), slim)}):
    (folder / f"{component.name}.txt").write_text(component.text)
    for name in re.findall(rf"{common}/([A-Za-z0-9.-]*[A-Za-z0-9])", component.text):
        shutil.copyfile(common / name, folder / name)
    rows.append(f"{component.name}\t{component.version}\t{component.licence}\n")
(folder / "components.tsv").write_text("".join(rows))
