"""Imports a folder of Fractint collections (.l) and compares the patterns with measurements by another reader.

usage: collection.py PROGRAM FOLDER [ORDER...]

With FOLDER/facts.json (for each file the entries in order: {"entry": name, "facts": {order: {"drawn": steps, "length":
length, "box": [x0, y0, x1, y1] or null}}}) all numbers have to agree to a relative error of 1e-5. Without it, each
entry is measured at the orders given. Entries whose pattern states losses may differ. Exits with 1 if others do.
"""
import concurrent.futures
import json
import os
import re
import subprocess
import sys
import tempfile

program, folder = sys.argv[1:3]
orders = sys.argv[3:]
tolerance = 1e-5


def run(*arguments, **options):
    return subprocess.run([program, *arguments], capture_output=True, text=True, **options)


def entries_of(file, scratch):
    """(name, text of the pattern or None), in the order of the file."""
    target = os.path.join(scratch, os.path.basename(file))
    run("-q", "import", file, "-o", target)
    texts = {}
    # Nothing is written for a collection without systems, or with mistakes in all of them.
    for name in os.listdir(target) if os.path.isdir(target) else []:
        path = os.path.join(target, name)
        with open(path, encoding="utf-8") as stream:
            text = stream.read()
        texts[int(re.search(r"^source: .*?, line (\d+)", text, re.M).group(1))] = (path, text)
    for row in run("import", file, "--list").stdout.splitlines():
        name, line = re.match(r"(.*?)\s+line (\d+)\s", row).groups()
        yield name, texts.get(int(line))


def differences(path, order, fact):
    try:
        outcome = run("-q", "measure", path, "-n", str(order), "--json", timeout=120)
    except subprocess.TimeoutExpired:
        return "takes more than two minutes"
    if outcome.returncode:
        return outcome.stderr.strip().splitlines()[0]
    if fact is None:
        return ""
    found = json.loads(outcome.stdout)
    ink, box = found["ink"], fact["box"]
    if int(found["drawn"]) != fact["drawn"]:
        return f"{found['drawn']} steps drawn, not {fact['drawn']}"
    if abs(float(found["length"]) - fact["length"]) > tolerance * fact["length"]:
        return f"length {found['length']}, not {fact['length']}"
    if (ink is None) != (box is None):
        return f"ink {ink}, not {box}"
    if box is not None:
        scale = max(box[2] - box[0], box[3] - box[1], *map(abs, box))
        if any(abs(float(a) - b) > tolerance * scale for a, b in zip(ink, box)):
            return f"box {ink}, not {box}"
    return ""


def main():
    facts = {}
    if os.path.exists(os.path.join(folder, "facts.json")):
        with open(os.path.join(folder, "facts.json"), encoding="utf-8") as stream:
            facts = json.load(stream)
    jobs = []
    refused = []
    with tempfile.TemporaryDirectory() as scratch:
        for name in sorted(os.listdir(folder)):
            if not name.endswith(".l"):
                continue
            # Entries without a name, and those called `comment`, are comments.
            known = [one for one in facts.get(name, []) if one["entry"].lower() not in ("", "comment")]
            for number, (entry, pattern) in enumerate(entries_of(os.path.join(folder, name), scratch)):
                if pattern is None:
                    refused.append(f"{name} {entry}")
                    continue
                path, text = pattern
                late = 1 if "the derivation length less one" in text else 0
                wanted = known[number]["facts"].items() if known else [(order, None) for order in orders]
                for order, fact in wanted:
                    jobs.append((f"{name} {entry}", path, int(order) + late, fact, "Not supported:" in text))
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            results = list(pool.map(lambda job: differences(*job[1:4]), jobs))
    wrong = [(job, text) for job, text in zip(jobs, results) if text]
    print(f"{len(jobs)} measured, {len(wrong)} differ, {len(refused)} entries refused: {', '.join(refused)}")
    for job, text in wrong:
        print(f"  {job[0]}, n = {job[2]}{' (with losses)' if job[4] else ''}: {text}")
    sys.exit(1 if any(not job[4] for job, _ in wrong) else 0)


main()
