"""Called by latency.sh: measures how long commands work on after a SIGTERM."""
import os
import shutil
import signal
import subprocess
import sys
import time

program, folder = sys.argv[1:3]
MOST = float(os.environ.get("LATENCY_SECONDS", "1.0"))
os.chdir(folder)


def write_inputs():
    """Files that take long to read: a pattern with many variants, a collection with many entries."""
    with open("variants.lsys", "w") as file:
        file.write("angle factor: 4\nderivation length: 3\ndefine a = 1\n")
        file.writelines(f"define b{i} = {i}\n" for i in range(800))
        file.write("axiom: F(a)\nF(x) --> F(x*" + "+".join(f"b{i}" for i in range(800)) + ")F(x)\n")
        file.writelines(f"variant v{i}: a = {i}\n" for i in range(1500))
    with open("collection.l", "w") as file:
        for entry in range(4000):
            file.write(f"Entry{entry} {{ ; a curve\n  angle 4\n  axiom f\n  f=" + "f+f-f@.5f" * 30 + "\n}\n")


def commands():
    """Commands with the moments, in seconds, at which they are stopped."""
    n, o = "-n", "-o"
    yield ["draw", "hilbert", n, "12", o, "x.gcode"], (0.5, 2, 5, 9, 14)
    yield ["draw", "hilbert", n, "12", o, "x.hpgl"], (1, 4, 8)
    yield ["draw", "hilbert", n, "11", "--plotter", "--travel", o, "x.svg"], (1, 3)
    yield ["draw", "snake-kolam", n, "9", "--plotter", o, "x.svg"], (0.5, 2)
    yield ["draw", "bush-3d", n, "8", "--plotter", o, "x.svg"], (0.2, 0.4)
    yield ["kolam", "hilbert", n, "11"], (0.5, 2, 4, 8)
    yield ["kolam", "snake-kolam", n, "9"], (0.5, 2)
    yield ["kolam", "--grid", "2000x2000", "--single-line", o, "x.lsys"], (0.3, 0.6, 1.0)
    yield ["kolam", "--grid", "999x1000", "--single-line", o, "x.lsys"], (0.5, 1.5)
    yield ["kolam", "--grid", "300x300", "--symmetry", "C2", "--single-line", o, "x.lsys"], (0.3, 1)
    yield ["kolam", "--grid", "6x6", "--symmetry", "C2", "--enumerate"], (0.5,)
    yield ["draw", "hilbert", n, "11", o, "x.pdf"], (1, 3)
    yield ["draw", "hilbert", n, "11", "--set", "line=spline", o, "x.svg"], (1, 3)
    yield ["draw", "hilbert", n, "10", "--colour-by", "strand", o, "x.svg"], (0.5, 1.5)
    yield ["draw", "hilbert", n, "10", "--dots", o, "x.svg"], (0.5, 1.5)
    yield ["draw", "hilbert", n, "10", "--tile", "A6", "--size", "A0", o, "x.svg"], (0.5, 2)
    yield ["draw", "bush-3d", "--dpi", "1200", "--size", "A1", o, "x.png"], (0.8, 2)
    yield ["draw", "hilbert", n, "11", "--dpi", "1200", "--size", "A1", o, "x.tif"], (0.8, 2)
    yield ["draw", "bush-3d", n, "9", o, "x.glb"], (0.5, 1, 2.5)
    yield ["draw", "bush-3d", n, "9", o, "x.obj"], (1, 2.5)
    yield ["draw", "bush-3d", n, "9", o, "x.svg"], (0.2, 0.5)
    yield ["draw", "bush-3d", "--generations", "1:8", "--size", "A3", o, "x.gif"], (1, 3)
    yield ["play", "hilbert", n, "12", o, "x.mid"], (0.5, 2)
    yield ["play", "hilbert", n, "9", o, "x.musicxml"], (0.3, 0.8)
    yield ["play", "hilbert", n, "9", o, "x.ly"], (0.3, 0.8)
    yield ["play", "hilbert", n, "9", o, "x.html"], (0.3, 0.8)
    yield ["check", "variants.lsys"], (0.3, 1)
    yield ["import", "collection.l", "--list"], (0.3,)
    yield ["import", "collection.l", o, "imported"], (0.3,)
    yield ["measure", "koch-island", n, "12", "--budget", "1e12"], (0.2,)
    yield ["derive", "koch-island", n, "30"], (0.5,)
    yield ["gallery", "-f", "svg,png,pdf", "--size", "A1", o, "g"], (0.5, 1.5, 3)
    yield ["gallery", "hilbert", n, "1:11", "-f", "gcode,svg", o, "g"], (0.7, 2.5)
    yield ["gallery", n, "1:9", "-f", "svg", "--dry-run"], (0.1, 0.3)
    yield ["gallery", "kolams", "--poster", "A0", "-f", "png", o, "g"], (1, 4)
    yield ["gallery", "melodies", "-f", "mid,wav,musicxml", o, "g"], (1, 3)


def left_behind():
    """Temporary files below the folder."""
    return [name for _, _, names in os.walk(".") for name in names if ".tmp" in name]


def stop(arguments, delay):
    """True if a command stopped after `delay` seconds behaves correctly. A command that was about to end may succeed."""
    before = set(os.listdir("."))
    process = subprocess.Popen([program, "-q", *arguments], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    time.sleep(delay)
    if process.poll() is not None:
        print(f"  {' '.join(arguments)}: done before {delay} s, status {process.returncode}")
        return process.returncode in (0, 1, 2)
    process.send_signal(signal.SIGTERM)
    begin = time.monotonic()
    try:
        process.wait(30)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()
    took = time.monotonic() - begin
    completed = process.returncode == 0 and ("-o" not in arguments or set(os.listdir(".")) > before)
    good = (process.returncode == 143 or completed) and took <= MOST and not left_behind()
    if not good or os.environ.get("LATENCY_VERBOSE"):
        print(f"{'  ' if good else 'BAD '}{' '.join(arguments)}: SIGTERM at {delay} s, status {process.returncode} "
              f"after {took:.2f} s, left {left_behind()}")
    return good


write_inputs()
inputs = set(os.listdir("."))
bad = stopped = 0
for arguments, delays in commands():
    for delay in delays:
        stopped += 1
        bad += 0 if stop(arguments, delay) else 1
        for name in set(os.listdir(".")) - inputs:
            shutil.rmtree(name) if os.path.isdir(name) else os.unlink(name)
print(f"latency: {stopped} commands stopped, {bad} of them badly")
sys.exit(bad > 0)
