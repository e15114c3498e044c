"""Draws the notes of a Standard MIDI file as a piano roll."""

import struct

# Of tracks on light and on dark ground.
COLOURS = ("#8c3b24", "#1d5d63", "#b0791a", "#6f4a8e", "#4f7a3a", "#2f5f8f", "#a0456b", "#5c5047")
DARK_COLOURS = ("#e8977a", "#6fb6bd", "#e0b35c", "#b995d6", "#9cc384", "#8bb6e0", "#e08fae", "#c4b6a7")
MOST_NOTES = 2500


def variable(data: bytes, at: int) -> tuple[int, int]:
    value = 0
    while True:
        byte = data[at]
        at += 1
        value = value << 7 | byte & 127
        if byte < 128:
            return value, at


def notes_of(data: bytes) -> tuple[list[tuple[int, int, int, int]], int]:
    """Notes as start and end in ticks, key and track, in order of their starts; and the end of the file in ticks."""
    count = struct.unpack(">H", data[10:12])[0]
    at, notes, last = 14, [], 0
    for track in range(count):
        (length,) = struct.unpack(">I", data[at + 4 : at + 8])
        at += 8
        end, tick, status = at + length, 0, 0
        sounding: dict[tuple[int, int], list[int]] = {}
        while at < end:
            delta, at = variable(data, at)
            tick += delta
            if data[at] >= 128:
                status = data[at]
                at += 1
            if status == 0xFF:
                size, at = variable(data, at + 1)
                at += size
            elif status in (0xF0, 0xF7):
                size, at = variable(data, at)
                at += size
            else:
                kind, channel = status >> 4, status & 15
                if kind in (8, 9):
                    key = (channel, data[at])
                    if kind == 9 and data[at + 1] > 0:
                        sounding.setdefault(key, []).append(tick)
                    elif sounding.get(key):
                        notes.append((sounding[key].pop(0), tick, data[at], track))
                at += 1 if kind in (12, 13) else 2
        last = max(last, tick)
    return sorted(notes), last


def piano_roll(data: bytes) -> str | None:
    """An SVG of 1000 x 240 units; None without notes, or with more than a picture can show."""
    notes, end = notes_of(data)
    if not 0 < len(notes) <= MOST_NOTES:
        return None
    low, high = min(note[2] for note in notes), max(note[2] for note in notes)
    height = min(224 / (high - low + 1), 14)
    top = (240 - height * (high - low + 1)) / 2
    tracks = sorted({note[3] for note in notes})
    shapes = []
    for number, track in enumerate(tracks):
        path = ""
        for start, stop, key, _ in (note for note in notes if note[3] == track):
            x, width = 1000 * start / end, max(1000 * (stop - start) / end - 0.6, 0.8)
            y = top + height * (high - key)
            path += f"M{x:.1f} {y + height * 0.1:.1f}h{width:.1f}v{height * 0.8:.1f}h-{width:.1f}z"
        shapes.append(f'<path class="c{number % len(COLOURS)}" d="{path}"/>')
    used = range(min(len(tracks), len(COLOURS)))
    light = "".join(f".c{number}{{fill:{COLOURS[number]}}}" for number in used)
    dark = "".join(f".c{number}{{fill:{DARK_COLOURS[number]}}}" for number in used)
    return (
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 1000 240" width="1000" height="240" '
        f'preserveAspectRatio="none"><style>rect{{fill:#fbf6ea}}{light}@media(prefers-color-scheme:dark){{rect{{fill:#27201c}}{dark}}}</style>'
        f'<rect width="1000" height="240"/>{"".join(shapes)}</svg>\n'
    )
