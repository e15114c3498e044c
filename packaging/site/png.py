"""Makes PNG pictures smaller: halves them, reduces them to a palette of at most 256 colours."""

import struct
import zlib
from collections import Counter

SIGNATURE = b"\x89PNG\r\n\x1a\n"


def chunks(data: bytes):
    at = len(SIGNATURE)
    while at < len(data):
        (length,) = struct.unpack(">I", data[at : at + 4])
        yield data[at + 4 : at + 8], data[at + 8 : at + 8 + length]
        at += 12 + length


def size_of(data: bytes) -> tuple[int, int]:
    return struct.unpack(">II", data[16:24])


def paeth(left: int, above: int, corner: int) -> int:
    ahead = left + above - corner
    to_left, to_above, to_corner = abs(ahead - left), abs(ahead - above), abs(ahead - corner)
    if to_left <= to_above and to_left <= to_corner:
        return left
    return above if to_above <= to_corner else corner


def unfiltered(filter_type: int, line: bytearray, above: bytes, step: int) -> bytes:
    """A line of bytes; `step` is the number of bytes of a pixel."""
    if filter_type == 0:
        return bytes(line)
    if filter_type == 2:
        return bytes([(a + b) & 255 for a, b in zip(line, above)])
    for i in range(len(line)):
        left = line[i - step] if i >= step else 0
        if filter_type == 1:
            line[i] = (line[i] + left) & 255
        elif filter_type == 3:
            line[i] = (line[i] + (left + above[i]) // 2) & 255
        else:
            line[i] = (line[i] + paeth(left, above[i], above[i - step] if i >= step else 0)) & 255
    return bytes(line)


def rows_of(data: bytes) -> list[bytes]:
    """Rows of RGB pixels. Raises ValueError for other kinds of PNG than 8 bits RGB, RGBA or with a palette; alpha is
    left out."""
    if not data.startswith(SIGNATURE):
        raise ValueError("not a PNG")
    packed = b""
    for kind, contents in chunks(data):
        if kind == b"IHDR":
            width, height, depth, colour, _, _, interlace = struct.unpack(">IIBBBBB", contents)
        elif kind == b"PLTE":
            palette = [contents[at : at + 3] for at in range(0, len(contents), 3)]
        elif kind == b"IDAT":
            packed += contents
    if depth != 8 or colour not in (2, 3, 6) or interlace:
        raise ValueError("expected a PNG with colours and 8 bits for each channel")
    step = {2: 3, 3: 1, 6: 4}[colour]
    length = width * step
    raw = zlib.decompress(packed)
    rows, above = [], bytes(length)
    for y in range(height):
        start = y * (length + 1)
        above = unfiltered(raw[start], bytearray(raw[start + 1 : start + 1 + length]), above, step)
        row = above
        if step == 4:
            row = bytes(byte for i in range(0, length, 4) for byte in row[i : i + 3])
        elif step == 1:
            row = b"".join([palette[number] for number in row])
        rows.append(row)
    return rows


def halved(rows: list[bytes]) -> list[bytes]:
    """Half the width and height, each pixel the mean of four."""
    width = len(rows[0]) // 6 * 6
    made = []
    for upper, lower in zip(rows[0::2], rows[1::2]):
        row = bytearray(width // 2)
        for channel in range(3):
            sums = [
                (a + b + c + d + 2) >> 2
                for a, b, c, d in zip(
                    upper[channel:width:6], upper[channel + 3 : width : 6],
                    lower[channel:width:6], lower[channel + 3 : width : 6],
                )
            ]  # fmt: skip
            row[channel::3] = bytes(sums)
        made.append(bytes(row))
    return made


def palette_of(counts: Counter, most: int) -> dict[int, int]:
    """Median cut: which of at most `most` boxes each colour is in, boxes numbered from 0; the mean of each box is in
    the key -1 - number. Colours are 0xRRGGBB."""
    boxes = [sorted(counts.items())]

    def spread(box: list) -> tuple[int, int]:
        """The widest channel of a box, and its width times the number of pixels."""
        widths = []
        for shift in (16, 8, 0):
            values = [(colour >> shift) & 255 for colour, _ in box]
            widths.append(max(values) - min(values))
        widest = max(range(3), key=lambda channel: widths[channel])
        return (16, 8, 0)[widest], widths[widest] * sum(count for _, count in box)

    measured = [spread(boxes[0])]
    while len(boxes) < most:
        chosen = max(range(len(boxes)), key=lambda each: (measured[each][1], -each))
        shift, weight = measured[chosen]
        if weight == 0:
            break
        box = sorted(boxes[chosen], key=lambda each: ((each[0] >> shift) & 255, each[0]))
        half, total, at = 0, sum(count for _, count in box), 0
        while at < len(box) - 1 and (at == 0 or half + box[at][1] <= total / 2):
            half += box[at][1]
            at += 1
        boxes[chosen : chosen + 1] = [box[:at], box[at:]]
        measured[chosen : chosen + 1] = [spread(box[:at]), spread(box[at:])]
    found = {}
    for number, box in enumerate(boxes):
        total = sum(count for _, count in box)
        mean = 0
        for shift in (16, 8, 0):
            mean |= round(sum(((colour >> shift) & 255) * count for colour, count in box) / total) << shift
        found[-1 - number] = mean
        for colour, _ in box:
            found[colour] = number
    return found


def chunk(kind: bytes, contents: bytes) -> bytes:
    return struct.pack(">I", len(contents)) + kind + contents + struct.pack(">I", zlib.crc32(kind + contents))


def encoded(rows: list[bytes], most_colours: int = 256) -> bytes:
    """A PNG with a palette. Beyond `most_colours`, similar colours become one, first those with equal upper bits."""
    width = len(rows[0]) // 3
    pixels = []
    counts: Counter = Counter()
    for row in rows:
        line = [r << 16 | g << 8 | b for r, g, b in zip(row[0::3], row[1::3], row[2::3])]
        pixels.append(line)
        counts.update(line)
    mask = 0xFFFFFF
    for bits in (0xFEFEFE, 0xFCFCFC, 0xF8F8F8):
        if len(counts) <= 8192:
            break
        mask = bits
        counts = Counter()
        for line in pixels:
            counts.update([colour & mask for colour in line])
    table = palette_of(counts, most_colours)
    size = sum(1 for key in table if key < 0)
    colours = b"".join(table[-1 - number].to_bytes(3, "big") for number in range(size))
    depth = next(each for each in (1, 2, 4, 8) if size <= 1 << each)
    packed = bytearray()
    for line in pixels:
        numbers = [table[colour & mask] for colour in line]
        packed.append(0)
        if depth == 8:
            packed += bytes(numbers)
            continue
        each = 8 // depth
        numbers += [0] * (-len(numbers) % each)
        for at in range(0, len(numbers), each):
            byte = 0
            for number in numbers[at : at + each]:
                byte = byte << depth | number
            packed.append(byte)
    header = struct.pack(">IIBBBBB", width, len(rows), depth, 3, 0, 0, 0)
    return (
        SIGNATURE + chunk(b"IHDR", header) + chunk(b"PLTE", colours) + chunk(b"IDAT", zlib.compress(bytes(packed), 9))
        + chunk(b"IEND", b"")
    )  # fmt: skip


def reduced(data: bytes, most_bytes: int, most_colours: int = 256) -> bytes:
    """A smaller PNG of the same picture: with a palette, then at half the size until it has at most `most_bytes`."""
    rows = rows_of(data)
    made = encoded(rows, most_colours)
    while len(made) > most_bytes and len(rows) > 200:
        rows = halved(rows)
        made = encoded(rows, most_colours)
    return made if len(made) < len(data) or len(data) > most_bytes else data
