#!/usr/bin/env bash
# What needs heavy tools: the fuzz targets for a minute each (clang), an SVG through Inkscape, scores through LilyPond
# and MuseScore, random ones through MuseScore and Verovio, sound through FluidSynth, pages and an animated kolam in
# Chromium, models through the glTF validator, kolams enumerated, an array of Slurm, a signal to everything that takes
# long, a gallery under disturbance, plots in vpype and LibreCAD, the site in Chromium and Firefox, the book, the
# language server in Neovim and with the extension for VS Code.
# usage: tests/full/run.sh PROGRAM
set -euo pipefail
[ $# -eq 1 ] || { echo "usage: tests/full/run.sh PROGRAM" >&2; exit 2; }
program=$(realpath "$1")
cd "$(dirname "$0")/../.."
seconds=${FUZZ_SECONDS:-60}

targets=(pattern_fuzz derivation_fuzz import_fuzz surface_fuzz scl_fuzz kbm_fuzz gallery_toml_fuzz gallery_jsonl_fuzz show_fuzz
    midi_fuzz icc_fuzz font_fuzz link_fuzz grid_fuzz reading_fuzz svg_fuzz photograph_fuzz
    server_fuzz)
# One target for $seconds. What it finds is written to build/fuzz/; mend it and add the file to tests/corpus.
fuzz() {
    local target=$1 corpus=build/fuzz/corpus-$1 timeout=10 seeds
    mkdir -p "$corpus"
    case $target in
        show_fuzz) seeds=(tests/corpus/show tests/corpus/midi) ;;
        midi_fuzz) seeds=(tests/corpus/midi) ;;
        icc_fuzz) seeds=(tests/corpus/icc) ;;
        font_fuzz) seeds=(-max_len=100000 /usr/share/fonts/truetype/lohit-tamil) ;; # in fonts-lohit-taml
        link_fuzz) seeds=(tests/corpus/link) ;;
        grid_fuzz) seeds=(tests/corpus/grids) ;;
        reading_fuzz) seeds=(tests/corpus/reading) ;;
        svg_fuzz) seeds=(tests/corpus/svg) ;;
        photograph_fuzz) seeds=(tests/corpus/pictures) timeout=60 ;; # of a kolam, 4 s with sanitizers
        surface_fuzz) seeds=(tests/corpus/surfaces) ;;
        scl_fuzz | kbm_fuzz) seeds=(tests/corpus/scales) ;;
        server_fuzz) # a check takes up to 2 s, a measurement 0.5 s
            seeds=(-dict=tests/fuzz/words.dict tests/corpus/server tests/corpus/good tests/corpus/bad patterns/*/) timeout=30 ;;
        gallery_*) seeds=(tests/corpus/gallery patterns/posters) ;;
        *) seeds=(-dict=tests/fuzz/words.dict tests/corpus/good tests/corpus/bad tests/corpus/import patterns/*/) ;;
    esac
    build/fuzz/bin/"$target" -max_total_time="$seconds" -max_len=4096 -timeout="$timeout" -rss_limit_mb=2048 \
        -artifact_prefix="build/fuzz/$target-" "$corpus" "${seeds[@]}" > "build/fuzz/$target.log" 2>&1 ||
        { tail -n 60 "build/fuzz/$target.log"; echo "$target failed: see build/fuzz/"; exit 1; }
    echo "$target: $(tail -n 1 "build/fuzz/$target.log")"
}

if command -v clang++ > /dev/null; then
    mkdir -p build
    cmake --preset fuzz > build/fuzz.log 2>&1 || { cat build/fuzz.log; exit 1; }
    cmake --build --preset fuzz -j "$(nproc)" --target "${targets[@]}"
    echo "fuzzing: ${#targets[@]} targets for $seconds s each"
    export -f fuzz
    export seconds
    printf '%s\n' "${targets[@]}" | xargs -P "$(nproc)" -I {} bash -euo pipefail -c 'fuzz {}'
else
    echo "skipped: fuzzing (clang is not installed)"
fi

if command -v inkscape > /dev/null; then
    folder=$(mktemp -d)
    trap 'rm -rf "$folder"' EXIT
    for pattern in snake-kolam bag-of-candies hexagonal-tiling; do
        "$program" draw "$pattern" --size 100x100mm -o "$folder/$pattern.svg"
        inkscape "$folder/$pattern.svg" --export-dpi=96 --export-filename="$folder/$pattern.png" 2> "$folder/log" ||
            { cat "$folder/log"; echo "inkscape cannot export $pattern.svg"; exit 1; }
        # 100 mm at 96 dpi are 378 pixels; bytes 16 to 23 of a PNG are its width and height.
        size=$(od -An -t u1 -j 16 -N 8 "$folder/$pattern.png" | tr -s ' ')
        [ "$size" = " 0 0 1 122 0 0 1 122" ] || { echo "inkscape made $pattern.png of size$size"; exit 1; }
        echo "inkscape: $pattern.svg is 378 x 378 pixels"
    done
else
    echo "skipped: export through Inkscape (it is not installed)"
fi

for part in scores readers repeats sound page model kolam gallery slurm latency chaos vpype cad site book editors; do
    tests/full/"$part".sh "$program"
done
