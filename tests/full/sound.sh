#!/usr/bin/env bash
# What `sikku play` sounds like, measured: loudness, duration, and the pitch of every note of a microtonal scale.
# usage: tests/full/sound.sh PROGRAM
set -euo pipefail
[ $# -eq 1 ] || { echo "usage: tests/full/sound.sh PROGRAM" >&2; exit 2; }
program=$(realpath "$1")

skip() { echo "skipped: the sound of play ($1)"; exit 0; }
for needed in fluidsynth python3; do
    command -v "$needed" > /dev/null || skip "$needed is not installed"
done

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

cat > measure.py << 'END'
import array, json, math, struct, sys, wave


def samples_of(name):
    """The left channel and the loudest sample of both."""
    with wave.open(name) as sound:
        assert (sound.getnchannels(), sound.getsampwidth(), sound.getframerate()) == (2, 2, 44100)
        both = array.array("h")
        both.frombytes(sound.readframes(sound.getnframes()))
    return both[0::2], max(max(both), -min(both))


def score_of(name):
    """Notes (seconds, seconds, key) and the length of the score as the page beside the sound tells them."""
    text = open(name, encoding="utf-8").read()
    begin = text.index('id="score">') + len('id="score">')
    data = json.loads(text[begin:text.index("</script>", begin)])
    second = data["quarter"] * data["tempo"] / 60
    return [(note[0] / second, note[1] / second, note[2]) for note in data["notes"]], data["end"] / second


def write_sine_soundfont(name):
    """A soundfont whose only sample is a sine of exactly 440 Hz at key 69, so that pitch can be measured."""
    rate, period = 44000, 100
    wanted = [round(12000 * math.sin(2 * math.pi * i / period)) for i in range(4800)]
    chunk = lambda tag, body: tag + struct.pack("<I", len(body)) + body + b"\0" * (len(body) % 2)
    listed = lambda kind, *chunks: chunk(b"LIST", kind + b"".join(chunks))
    named = lambda text: text.ljust(20, b"\0")
    header = struct.pack("<20sHHHIII", named(b"Sine"), 0, 0, 0, 0, 0, 0)
    last = struct.pack("<20sHHHIII", named(b"EOP"), 0, 0, 1, 0, 0, 0)
    generators = struct.pack("<HH", 54, 1) + struct.pack("<HH", 53, 0)  # loops; sample 0
    sample = struct.pack("<20sIIIIIBbHH", named(b"Sine"), 0, 4800, 200, 4600, rate, 69, 0, 0, 1)
    end = struct.pack("<20sIIIIIBbHH", named(b"EOS"), 0, 0, 0, 0, 0, 0, 0, 0, 0)
    body = listed(b"INFO", chunk(b"ifil", struct.pack("<HH", 2, 1)), chunk(b"isng", b"EMU8000\0"),
                  chunk(b"INAM", b"Sine\0\0"))
    body += listed(b"sdta", chunk(b"smpl", struct.pack("<4800h", *wanted) + b"\0" * 92))
    body += listed(b"pdta", chunk(b"phdr", header + last), chunk(b"pbag", struct.pack("<HHHH", 0, 0, 1, 0)),
                   chunk(b"pmod", b"\0" * 10), chunk(b"pgen", struct.pack("<HHHH", 41, 0, 0, 0)),
                   chunk(b"inst", struct.pack("<20sH20sH", named(b"Sine"), 0, named(b"EOI"), 1)),
                   chunk(b"ibag", struct.pack("<HHHH", 0, 0, 2, 0)), chunk(b"imod", b"\0" * 10),
                   chunk(b"igen", generators + b"\0" * 4), chunk(b"shdr", sample + end))
    open(name, "wb").write(chunk(b"RIFF", b"sfbk" + body))


def frequency(samples, begin, finish):
    """Of a sine, from where it rises through zero."""
    first, last = int(begin * 44100), int(finish * 44100)
    rises = [i - samples[i] / (samples[i + 1] - samples[i]) for i in range(first, last)
             if samples[i] < 0 <= samples[i + 1]]
    return (len(rises) - 1) / (rises[-1] - rises[0]) * 44100


def loudness(name):
    samples, peak = samples_of(name + ".wav")
    decibels = 20 * math.log10(peak / 32768)
    assert abs(decibels + 1) <= 0.3, f"the peak is at {decibels:.2f} dBFS"
    _, expected = score_of(name + ".html")
    seconds = len(samples) / 44100
    assert expected <= seconds <= expected + 4, f"{seconds:.2f} s of sound for a score of {expected:.2f} s"
    print(f"sound: peak {decibels:.2f} dBFS, {seconds:.2f} s for a score of {expected:.2f} s")


def pitches(name, cents):
    samples, _ = samples_of(name + ".wav")
    notes, _ = score_of(name + ".html")
    degrees, worst = set(), 0
    for onset, duration, key in notes:
        # The steps of the scale, above C4.
        above = (key - 60) * 100 % 1200
        degree = min(range(len(cents)), key=lambda i: abs((above - cents[i] + 600) % 1200 - 600))
        assert abs((above - cents[degree] + 600) % 1200 - 600) < 0.01, f"key {key} is not in the scale"
        degrees.add(degree)
        heard = frequency(samples, onset + 0.2, onset + duration - 0.1)
        wrong = 1200 * math.log2(heard / (440 * 2 ** ((key - 69) / 12)))
        worst = max(worst, abs(wrong))
        assert abs(wrong) <= 3, f"key {key} sounds at {heard:.3f} Hz, {wrong:.1f} cents off"
    assert len(degrees) >= 5, "too few steps of the scale to tell"
    print(f"sound: {len(notes)} notes on {len(degrees)} steps, at most {worst:.2f} cents off ({name})")


if sys.argv[1] == "soundfont":
    write_sine_soundfont(sys.argv[2])
elif sys.argv[1] == "loudness":
    loudness(sys.argv[2])
else:
    pitches(sys.argv[2], [float(cents) for cents in sys.argv[3:]])
END

"$program" --quiet play hilbert -n 3 -o x.html
if ! "$program" --quiet play hilbert -n 3 -o x.wav 2> log; then
    grep -q "soundfont" log && skip "no soundfont is installed"
    cat log
    exit 1
fi
python3 measure.py loudness x
"$program" --quiet play hilbert -n 3 -o again.wav
cmp x.wav again.wav || { echo "the same score sounds differently each time"; exit 1; }
if command -v flac > /dev/null; then
    "$program" --quiet play hilbert -n 3 -o x.flac
    flac -s -t x.flac
    flac -s -d -o decoded.wav x.flac
    cmp x.wav decoded.wav || { echo "the FLAC holds other samples than the WAV"; exit 1; }
    echo "sound: the FLAC holds what the WAV holds"
fi

# Seven steps that are in no piano.
cents=(137.5 275.25 430.0 551.3 703.9 866.6 1013.7)
{
    printf '! test.scl\nA test\n 8\n'
    printf ' %s\n' "${cents[@]}"
    printf ' 2/1\n'
} > test.scl
python3 measure.py soundfont sine.sf2
for tuning in bend mts; do
    options=(hilbert -n 3 --scale test.scl --tonic C4 --tempo 60 --unit 1/4 --tuning "$tuning")
    "$program" --quiet play "${options[@]}" -o "$tuning.html"
    SIKKU_SOUNDFONT=$PWD/sine.sf2 "$program" --quiet play "${options[@]}" -o "$tuning.wav"
    python3 measure.py pitches "$tuning" 0 "${cents[@]}"
done
