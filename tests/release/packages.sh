#!/usr/bin/env bash
# Installs the Debian packages of a release in minimal roots of Debian 12, uses them, and removes them.
# usage: tests/release/packages.sh DIST
set -euo pipefail
[ $# -eq 1 ] || { echo "usage: tests/release/packages.sh DIST" >&2; exit 2; }
dist=$(realpath "$1")
here=$(dirname "$(readlink -f "$0")")
. "$here/root.sh"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
root=$work/root

lintian --fail-on error --suppress-tags bad-distribution-in-changes-file "$dist"/*.deb > "$work/lintian" 2>&1 ||
    { cat "$work/lintian"; fail "lintian finds errors"; }
echo "lintian: no errors, $(grep -c '^W:' "$work/lintian" || true) warnings"

make_root bookworm "$root" minbase
files() { (cd "$root" && find . -xdev \( -path ./var/lib -o -path ./var/cache -o -path ./var/log -o -path ./tmp -o -path ./proc \) -prune -o -print | LC_ALL=C sort); }
cp "$dist"/*.deb "$root/tmp"
in_root "$root" apt-get -qq update > /dev/null
install_deb() { in_root "$root" apt-get -qq install -y --no-install-recommends "$@" > "$work/log" 2>&1 || { cat "$work/log"; fail "apt refuses $*"; }; }
shopt -s nullglob
deb() { local found=("$root/tmp/$1"_*.deb); echo "/tmp/$(basename "${found[0]}")"; }

# The program alone, without OpenImageIO.
install_deb "$(deb sikku)"
size=$(in_root "$root" dpkg-query -W -f '${Installed-Size}' sikku)
[ "$size" -lt 25000 ] || fail "sikku takes $size kB installed"
start=$(date +%s%N)
in_root "$root" sh -c 'cd /tmp && sikku draw hilbert -o first.svg && sikku draw hilbert --dpi 100 -o first.png && times' > "$work/times"
echo "sikku: $size kB installed; first prints after $(( ($(date +%s%N) - start) / 1000000 )) ms; $(tail -n 1 "$work/times") of processor time"
[ -s "$root/tmp/first.svg" ] && [ -s "$root/tmp/first.png" ] || fail "no prints"
# TIFF needs the recommended libraries, and the message names what is missing.
if in_root "$root" sikku draw hilbert -o /tmp/first.tif 2> "$work/message"; then fail "TIFF without OpenImageIO"; fi
grep -q -i 'openimageio' "$work/message" || { cat "$work/message"; fail "the message does not name OpenImageIO"; }
[ ! -e "$root/tmp/first.tif" ] || fail "a refused picture is there"

if in_root "$root" sikku draw hilbert --title-line=x --font Nonesuch -o /tmp/none.svg 2> "$work/message"; then fail "a font without HarfBuzz"; fi
grep -q libharfbuzz0b "$work/message" || { cat "$work/message"; fail "the message does not name HarfBuzz"; }

for package in libopenimageio2.4 libheif1 liblcms2-2 libharfbuzz0b libfribidi0 libfontconfig1 sikku-studio; do
    dpkg-deb -f "$dist"/sikku_*.deb Recommends | grep -q "$package" || fail "sikku does not recommend $package"
done

# Two versions side by side do not mix: a copy elsewhere uses its own patterns, and only those of its version.
mkdir -p "$root/opt/other/bin" "$root/opt/other/share/sikku"
cp "$root/usr/bin/sikku" "$root/opt/other/bin"
refused() {
    if in_root "$root" "$@" draw hilbert -o /tmp/none.svg 2> "$work/message"; then fail "patterns of another installation were used"; fi
    [ ! -e "$root/tmp/none.svg" ] || fail "a refused print is there"
    grep -q -F "$expected" "$work/message" || { cat "$work/message"; fail "the message does not say: $expected"; }
}
expected='/opt/other/share/sikku/patterns contains no patterns' refused /opt/other/bin/sikku
cp -r "$root/usr/share/sikku/patterns" "$root/opt/other/share/sikku"
echo 0.1.0 > "$root/opt/other/share/sikku/version"
expected='/opt/other/share/sikku belong to sikku 0.1.0' refused /opt/other/bin/sikku
expected='/opt/other/share/sikku (SIKKU_DATA) belong to sikku 0.1.0' refused env SIKKU_DATA=/opt/other/share/sikku sikku
rm -r "$root/opt/other"
echo "two versions side by side: only the patterns of its own version are used"

# Everything, as README says.
install_deb libopenimageio2.4 libheif1 man-db zsh fish bash-completion cmake ninja-build g++ pkg-config python3-pip \
    fluidsynth timgm6mb-soundfont lilypond
in_root "$root" apt-get -qq purge -y sikku > /dev/null 2>&1
files > "$work/without"
install_deb "$(deb sikku)" "$(deb libsikku-dev)" "$(deb python3-sikku)" "$(deb sikku-studio)"

mkdir -p "$root/tmp/readme"
"$here/readme.sh" "$here/../../README.md" > "$root/tmp/readme/run.sh"
in_root "$root" bash -euo pipefail -c 'cd /tmp/readme && . ./run.sh' > "$work/log" 2>&1 || { cat "$work/log"; fail "an example of README fails"; }
[ "$(grep -c '^sikku' "$root/tmp/readme/run.sh")" -ge 12 ] || fail "README has fewer examples than expected"
echo "README: $(grep -c '^sikku' "$root/tmp/readme/run.sh") commands work"

in_root "$root" sh -c 'man -w sikku && man -w sikku-draw' > /dev/null || fail "no man pages"
[ "$(in_root "$root" bash -c '. /usr/share/bash-completion/bash_completion; _completion_loader sikku; complete -p sikku')" ] || fail "no completion in bash"
in_root "$root" zsh -fc 'autoload -U compinit; compinit -u; [[ -n $_comps[sikku] ]]' || fail "no completion in zsh"
in_root "$root" fish -c 'complete -C "sikku dr" | string match -q "draw*"' || fail "no completion in fish"
echo "man pages; completion in bash, zsh and fish"

cp -r "$here/../../docs" "$here/../install" "$root/tmp"
in_root "$root" sh -euc '
    mkdir /tmp/programs
    awk -v folder=/tmp/programs "/^\`\`\`cpp\$/ { file = folder \"/program-\" ++count \".cpp\"; next } /^\`\`\`/ { file = \"\" } file { print > file }" /tmp/docs/library.md
    cmake -G Ninja -S /tmp/install -B /tmp/consumers -DPROGRAMS=/tmp/programs -DCMAKE_RUNTIME_OUTPUT_DIRECTORY=/tmp/consumers/bin
    cmake --build /tmp/consumers
    cd /tmp/programs
    /tmp/consumers/bin/consumer
    for source in program-*.cpp; do /tmp/consumers/bin/${source%.cpp}; done
    c++ -std=c++20 program-1.cpp -o by-hand $(pkg-config --cflags --libs sikku)
    ./by-hand' > "$work/log" 2>&1 || { tail -n 40 "$work/log"; fail "a program of docs/library.md fails"; }
echo "programs of docs/library.md work by CMake and by pkg-config"

cp "$here/manual.py" "$root/tmp"
in_root "$root" sh -c 'cd /tmp/programs && python3 /tmp/manual.py /tmp/docs/python.md' > "$work/log" 2>&1 || { tail -n 40 "$work/log"; fail "docs/python.md fails"; }
tail -n 1 "$work/log"

rm -rf "$root"/tmp/*
in_root "$root" apt-get -qq purge -y sikku libsikku-dev python3-sikku sikku-studio > "$work/log" 2>&1 || { cat "$work/log"; fail "apt does not remove"; }
in_root "$root" apt-get -qq autoremove -y --purge > /dev/null 2>&1 || true
files > "$work/after"
left=$(comm -13 "$work/without" "$work/after" | grep -i sikku || true)
[ -z "$left" ] || { echo "$left"; fail "removal leaves files"; }
echo "removal leaves no file whose path contains sikku"
