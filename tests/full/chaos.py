"""The phases of tests/full/chaos.sh. usage: chaos.py PROGRAM FOLDER SEED"""
import hashlib
import os
import random
import resource
import shutil
import signal
import subprocess
import sys
import time

program, work, seed = sys.argv[1], sys.argv[2], int(sys.argv[3])
chance = random.Random(seed)
shards = 3
kills = 200
gallery = """size = "100x100mm"
dpi = 90
format = ["png", "svg"]
[[item]]
pattern = "kolams"
name = "{kind}/{pattern}"
[[item]]
pattern = "hilbert"
n = "3:6"
[[item]]
pattern = "melodies"
format = ["mid", "html"]
seconds = 20
"""
os.chdir(work)
sys.stdout.reconfigure(line_buffering=True)
with open("gallery.toml", "w") as file:
    file.write(gallery)
command = [program, "-q", "gallery", "--file", "gallery.toml", "--poster", "A5", "--memory", "600M", "-j", "1", "-o"]


def tree(folder):
    """Every file of a folder, hidden ones too, with the hash of its bytes."""
    files = {}
    for below, _, names in os.walk(folder):
        for name in names:
            path = os.path.join(below, name)
            try:
                with open(path, "rb") as file:
                    files[os.path.relpath(path, folder)] = hashlib.sha256(file.read()).hexdigest()
            except FileNotFoundError:
                pass  # a temporary file that was renamed meanwhile
    return files


def fail(message):
    sys.exit(f"chaos, seed {seed}: {message}")


def start(folder, shard=None, **more):
    part = ["--shard", f"{shard}/{shards}"] if shard else []
    return subprocess.Popen(command + [folder] + part, stderr=subprocess.PIPE, text=True, **more)


def end(process, what, allowed, seconds=120):
    try:
        errors = process.communicate(timeout=seconds)[1]
    except subprocess.TimeoutExpired:
        process.kill()
        fail(f"{what} does not end")
    if process.returncode not in allowed:
        fail(f"{what} ended with {process.returncode}: {errors[:400]}")
    if process.returncode == 1 and "sikku: " not in errors:
        fail(f"{what} ended without a message: {errors[:400]}")
    return errors


def require_equal(folder, what):
    """After a whole run without disturbance."""
    end(start(folder), f"the whole run after {what}", [0])
    there = tree(folder)
    different = [name for name in sorted(set(whole) | set(there)) if whole.get(name) != there.get(name)]
    if different:
        fail(f"after {what} these differ from an undisturbed run: {different[:10]}")


def require_whole_files(folder):
    """Whatever stands there under its own name is as it should be."""
    for name, content in tree(folder).items():
        base = os.path.basename(name)
        summary = name == "index.html" or base.startswith("poster.")
        if base.startswith(".") or base.endswith(".jsonl") or summary:
            continue
        if whole.get(name) != content:
            fail(f"{name} is torn or unknown")


def disturb(folder, count):
    """Kills `count` runs, up to four of which are at work at a time."""
    running, killed = [], 0
    while killed < count:
        while len(running) < chance.choice([1, 2, 4]):
            running.append(start(folder, chance.choice([None, None, 1, 2, 3])))
        time.sleep(chance.uniform(0.005, min(duration * 0.25, 0.5)))
        victim = running.pop(chance.randrange(len(running)))
        sent = chance.choice([signal.SIGKILL, signal.SIGKILL, signal.SIGTERM, signal.SIGINT])
        is_over = victim.poll() is not None
        if not is_over:
            victim.send_signal(sent)
            killed += 1
            if sent != signal.SIGKILL and chance.random() < 0.2:
                victim.send_signal(sent)
        # A signal that comes before there is a handler ends the program as well.
        if not is_over:
            end(victim, f"a run that got {sent.name}", [0, 130, 143, -sent])
            require_whole_files(folder)
            continue
        # Once all is made there is little to kill: look at it, and begin anew.
        for process in [victim] + running:
            end(process, "a run among killed ones", [0])
        running = []
        require_equal(folder, f"{killed} kills")
        shutil.rmtree(folder)
    for process in running:
        process.kill()
        process.communicate()


started = time.time()
end(start("whole"), "the undisturbed run", [0])
duration = time.time() - started
whole = tree("whole")
print(f"chaos, seed {seed}: {len(whole)} files, {duration:.1f} s undisturbed")

rounds = 10
for part in range(rounds):
    disturb("killed", kills // rounds)
    if part % 3 == 2 or part == rounds - 1:
        require_equal("killed", f"{(part + 1) * kills // rounds} kills")
        shutil.rmtree("killed", ignore_errors=True)
print(f"chaos: {kills} kills over whole runs and shards: the bytes of an undisturbed run")

for part in range(3):
    at_once = [start("together", shard) for shard in (None, 1, 2, None, 3, None)]
    for process in at_once:
        end(process, "one of six runs at a time", [0])
    if tree("together") != whole:
        fail("six runs at a time do not end with the bytes of one")
    shutil.rmtree("together")
print("chaos: three whole runs and three shards at a time: no failure, the bytes of an undisturbed run")

os.mkdir("disk")
if os.geteuid() == 0 and subprocess.call(["mount", "-t", "tmpfs", "-o", "size=200k", "none", "disk"]) == 0:
    errors = end(start("disk/g"), "a run on a full disk", [1])
    if "No space left" not in errors:
        fail(f"a full disk is not reported: {errors[:400]}")
    require_whole_files("disk/g")
    subprocess.check_call(["mount", "-o", "remount,size=100m", "disk"])
    require_equal("disk/g", "a full disk")
    subprocess.check_call(["umount", "disk"])
    print("chaos: a full disk is reported, and left behind")
else:
    print("skipped: a full disk (nothing can be mounted here)")


def limited(what, limit, value, as_nobody=False):
    folder = "limited"
    shutil.rmtree(folder, ignore_errors=True)
    os.mkdir(folder)
    os.chmod(folder, 0o777)

    def prepare():
        resource.setrlimit(limit, (value, value))
        if as_nobody:
            os.setgid(65534)
            os.setuid(65534)

    end(start(folder, preexec_fn=prepare), f"a run with {what} {value}", [0, 1])
    left = [name for name in tree(folder) if name.endswith(".tmp")]
    if left:
        fail(f"{what} {value} leaves {left}")
    require_whole_files(folder)
    require_equal(folder, f"{what} {value}")


for files in (6, 8, 12, 16, 24):
    limited("open files", resource.RLIMIT_NOFILE, files)
for size in (0, 100, 4096, 20_000):
    limited("bytes of a file", resource.RLIMIT_FSIZE, size)
for space in (64, 128, 256, 512):
    limited("MB of address space", resource.RLIMIT_AS, space << 20)
if os.geteuid() == 0:
    for processes in (1, 2, 4):
        limited("processes", resource.RLIMIT_NPROC, processes, as_nobody=True)
else:
    print("skipped: a limit of processes (needs another user)")
print("chaos: low limits end with a message or do not matter")
