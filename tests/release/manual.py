"""Runs the examples of a manual in order, in one namespace: python3 manual.py docs/python.md"""

import re
import sys
import tempfile
from pathlib import Path

blocks = re.findall(r"```python\n(.*?)```", Path(sys.argv[1]).read_text(), re.DOTALL)
assert len(blocks) >= 5, "the manual has fewer examples than expected"
names: dict[str, object] = {}
with tempfile.TemporaryDirectory() as folder:
    import os

    os.chdir(folder)
    for block in blocks:
        exec(block, names)
print(f"{len(blocks)} examples of {Path(sys.argv[1]).name} work")
