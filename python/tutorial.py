# %% [markdown]
# # Sikku in Python
#
# Each `# %%` begins a cell. Jupyter (with jupytext), VS Code and Spyder run the cells one by one;
# `python3 python/tutorial.py` runs them all. A notebook displays the value of the last line of a cell.

# %%
import itertools
from collections import Counter

import numpy
import sikku

[pattern.name for pattern in sikku.patterns() if pattern.kind == "kolams"]

# %% [markdown]
# ## A kolam
#
# A notebook displays a pattern as a drawing. Options are those of `sikku draw`.

# %%
kolam = sikku.load("snake-kolam")
kolam

# %%
kolam.save("kolam.pdf", size="A3", dots=True, stroke="0.25 step navy")
svg = kolam.draw("svg", size="150x150mm", border="kaavi")
print(kolam.title, len(svg))

# %%
facts = kolam.kolam()
print(facts["symmetry"], "symmetry,", facts["lines"], "line,", len(facts["dots"]), "dots")

# %% [markdown]
# ## A pattern of your own
#
# Errors have places, which an editor can mark.

# %%
text = """
title: A curve of mine
axiom: X
X --> -YF+XFX+FY-
Y --> +XF-YFY-FX+
derivation length: 4
"""
curve = sikku.load("mine", text=text)

try:
    sikku.load("mine", text=text.replace("XFX", "X(FX"))
except sikku.PatternError as error:
    print(error.line, error.column, error.message)

# %% [markdown]
# ## Exact numbers
#
# Words that are too long to derive can be measured; integers are exact.

# %%
large = curve.with_settings(n=60).measure()
assert large["drawn"] == 4**60 - 1
print(large["drawn"], "segments in a box", large["box"])

# %% [markdown]
# A word is a stream of modules: read as many as you need.

# %%
beginning = itertools.islice(curve.word(60), 100_000)
print(Counter(str(module) for module in beginning).most_common(3))

# %% [markdown]
# ## Lines as arrays

# %%
points, strokes = curve.path(8)
print(points.shape, "points in", len(strokes) - 1, "stroke")

# %% [markdown]
# How evenly does the curve fill the square? The mean distance between points that are `gap` steps apart is
# proportional to the square root of the gap: the exponent is 1/2.

# %%
gaps = 4 ** numpy.arange(1, 7)
distances = [float(numpy.hypot(*(points[gap:] - points[:-gap]).T).mean()) for gap in gaps]
exponent = float(numpy.polyfit(numpy.log(gaps), numpy.log(distances), 1)[0])
print(f"exponent {exponent:.2f}")
assert abs(exponent - 0.5) < 0.02

# %% [markdown]
# ## Music
#
# A pattern with keys of melodies is displayed as a page that plays.

# %%
melody = curve.with_settings(scale="dorian", tempo=96, instrument="flute")
melody

# %%
melody.save("curve.mid", bars=16)
notes = melody.notes(bars=16)
print(len(notes), "notes,", notes.seconds(notes.end), "seconds, keys", notes.key.min(), "to", notes.key.max())

# %% [markdown]
# ## A family of plants
#
# The seed is a setting, too; the pattern is read and compiled only once.

# %%
plant = sikku.load("stochastic-branches")
heights = [plant.with_settings(seed=seed).path().points[:, 1].max() for seed in range(20)]
print(f"{numpy.mean(heights):.1f} ± {numpy.std(heights):.1f} steps high")
