#!/usr/bin/env bash
# Makes the same prints, plots, models, scores and reports with several builds of the program, and compares their bytes:
# every bundled pattern in one format, and some of each kind in every format.
# usage: tests/full/same_bytes.sh PROGRAM PROGRAM…
set -euo pipefail
[ $# -ge 2 ] || { echo "usage: tests/full/same_bytes.sh PROGRAM PROGRAM…" >&2; exit 2; }
programs=()
for program in "$@"; do programs+=("$(realpath "$program")"); done
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
# The first program as on a machine without fused multiply-add, where the C library's functions have other last bits.
cat > "$folder/without-fma" <<SCRIPT
#!/bin/sh
GLIBC_TUNABLES=glibc.cpu.hwcaps=-FMA,-FMA4,-AVX2 exec "${programs[0]}" "\$@"
SCRIPT
chmod +x "$folder/without-fma"
programs+=("$folder/without-fma")

flat=(hilbert dragon saupe-koch-island dekking-spline filled-fractal snake-kolam bag-of-candies kolam-11-to-1-b731bgbw
    penrose-rhombs hat pinwheel rauzy gourd plant-a stochastic-branches)
spatial=(bush-3d honda-trees lilac cordate-leaf flower-field)
melodies=(hilbert-kalyani dragon-drums tree-in-voices snowflake-shruti hilbert-chorale)
vectors=svg,pdf,eps,hpgl,gcode,dxf
pictures=png,tif,jpg,exr
scores=mid,musicxml,mxl,ly,abc,csd,sco,strudel,notes.svg,html
page=(--size 90x120mm --dpi 60 --margin 5mm)

# In an empty folder. If one program refuses an output, all of them do.
make_all() {
    local program=$1 pattern
    local gallery=("$program" --quiet gallery --keep-going --jobs "$(nproc)")
    {
        "${gallery[@]}" -o all "${page[@]}" -f svg || true
        "${gallery[@]}" -o arrangements -f mid arrangements || true
        "${gallery[@]}" -o flat "${page[@]}" -f "$vectors,$pictures,glb" "${flat[@]}" || true
        "${gallery[@]}" -o relief "${page[@]}" -f stl,glb --relief 2mm --groove 0.3mm "${flat[@]}" || true
        "${gallery[@]}" -o plots "${page[@]}" -f "hpgl,gcode,dxf" --hatch 0.8mm,30 "${flat[@]}" || true
        "${gallery[@]}" -o spatial "${page[@]}" -f "$vectors,$pictures,glb" "${spatial[@]}" || true
        "${gallery[@]}" -o light "${page[@]}" -f png,svg --light sky "${spatial[@]}" || true
        "${gallery[@]}" -o scores -f "$scores" "${melodies[@]}" hilbert peano || true
        "${gallery[@]}" -o humanised -f mid,notes.svg --humanise 0.5 --seed 5 "${melodies[@]}" || true
        for pattern in "${flat[@]}" "${spatial[@]}"; do
            "$program" --quiet draw "$pattern" "${page[@]}" -o "$pattern.obj" || true
        done
        "$program" --quiet draw hilbert --generations 1:4 --size 40x40mm --dpi 60 -o hilbert.gif || true
        for pattern in "${flat[@]}"; do
            for report in kolam measure tiling; do
                "$program" "$report" "$pattern" --json > "$pattern.$report.json" || true
            done
        done
    } > messages 2>&1
    # Times, and names of the program.
    rm -f messages ./*/gallery.jsonl
}

first=
for i in "${!programs[@]}"; do
    mkdir "$folder/$i"
    (cd "$folder/$i" && make_all "${programs[$i]}" && find . -type f | sort | xargs sha256sum > ../"$i.sums")
    count=$(wc -l < "$folder/$i.sums")
    if [ -z "$first" ]; then
        first=$i
        [ "$count" -gt 700 ] || { echo "${programs[$i]} made only $count files"; exit 1; }
        echo "${programs[$i]}: $count files"
        continue
    fi
    if ! cmp -s "$folder/$first.sums" "$folder/$i.sums"; then
        echo "${programs[$i]} and ${programs[$first]} differ in:"
        diff "$folder/$first.sums" "$folder/$i.sums" | awk '/^[<>]/ { print "    " $3 }' | sort -u | head -40
        exit 1
    fi
    echo "${programs[$i]}: the same bytes"
    rm -rf "${folder:?}/$i"
done
