#!/usr/bin/env bash
# Unpacks the portable archive of a release in a root that has nothing but the C library and sh, and runs it.
# usage: tests/release/portable.sh DIST
set -euo pipefail
[ $# -eq 1 ] || { echo "usage: tests/release/portable.sh DIST" >&2; exit 2; }
here=$(dirname "$(readlink -f "$0")")
. "$here/root.sh"
archive=$(echo "$(realpath "$1")"/sikku-*-linux-x86_64.tar.gz)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
root=$work/root
make_root bookworm "$root" extract base-files libc6 dash
mkdir -p "$root/opt" "$root/tmp"
tar -xzf "$archive" -C "$root/opt"
name=$(basename "$archive" .tar.gz)
size=$(du -sm "$root/opt/$name" | cut -f1)
[ "$size" -le 60 ] || fail "$size MB unpacked; at most 60 are wanted"
[ -s "$root/opt/$name/share/doc/sikku/licences/components.tsv" ] || fail "no licences"
(cd "$root/opt/$name/share/doc/sikku/licences" && grep -h -o '/usr/share/common-licenses/[A-Za-z0-9.-]*[A-Za-z0-9]' ./*.txt) | sort -u |
    while read -r licence; do [ -s "$root/opt/$name/share/doc/sikku/licences/$(basename "$licence")" ] || fail "no $licence"; done
while IFS=$'\t' read -r component _; do
    [ -s "$root/opt/$name/share/doc/sikku/licences/$component.txt" ] || fail "no licence of $component"
done < "$root/opt/$name/share/doc/sikku/licences/components.tsv"

use() {
    local sikku=$1/bin/sikku
    cat > "$root/tmp/use.sh" <<END
set -eu
cd /tmp
for ending in svg pdf eps png tif jpg exr gif dxf plt gcode; do
    case \$ending in gif) more='--generations 1:3' ;; *) more='-n 3' ;; esac
    $sikku -q draw hilbert --size 40x40mm --dpi 60 \$more -o out.\$ending
    [ -s out.\$ending ]
done
for ending in mid ly musicxml html; do $sikku -q play hilbert -o out.\$ending; [ -s out.\$ending ]; done
$sikku -q draw bush-3d -o out.glb
$sikku -q kolam --grid 3x3 --seed 2 -o kolam.lsys
for ending in png jpg tif; do
    $sikku -q draw kolam.lsys --dots --size 60x60mm --dpi 150 -o kolam.\$ending
    $sikku -q kolam --read kolam.\$ending -o read.lsys
done
$sikku -q studio -o studio.html
$sikku show out.png > shown.lsys
$sikku --version
END
    in_root "$root" /bin/dash /tmp/use.sh > "$work/log" 2>&1 || { cat "$work/log"; fail "the program fails in $1"; }
}
use "/opt/$name"
mv "$root/opt/$name" "$root/opt/a folder"
ln -s 'a folder' "$root/opt/moved"
use /opt/moved
# HEIF is left out, and the message says so.
printf '\0\0\0\030ftypheic\0\0\0\0heicmif1' > "$root/tmp/photo.heic"
if in_root "$root" /opt/moved/bin/sikku kolam --read /tmp/photo.heic -o /tmp/x.lsys 2> "$work/message"; then fail "HEIF was read"; fi
grep -q "decodes HEIF" "$work/message" || { cat "$work/message"; fail "the message does not name HEIF"; }

# Damaged installations say what is missing.
broken() {
    local what=$1 message=$2
    shift 2
    mv "$root/opt/a folder/$what" "$root/aside"
    if in_root "$root" /opt/moved/bin/sikku "$@" 2> "$work/message"; then fail "works without $what"; fi
    grep -q -i "$message" "$work/message" || { cat "$work/message"; fail "without $what the message should contain '$message'"; }
    [ "$(wc -l < "$work/message")" -le 2 ] || { cat "$work/message"; fail "a long message without $what"; }
    mv "$root/aside" "$root/opt/a folder/$what"
}
broken share/sikku/patterns '/opt/a folder/share/sikku/patterns contains no patterns' draw hilbert -o /tmp/x.svg
broken lib/sikku/sikku_image.so sikku_image draw hilbert -o /tmp/x.tif
broken lib/sikku/sikku_font.so sikku_font draw hilbert --title-line=x --font Nonesuch -o /tmp/x.svg
broken lib/sikku/sikku_decoder sikku_decoder kolam --read /tmp/kolam.png -o /tmp/x.lsys
broken share/sikku/sikku-studio.html studio studio -o /tmp/x.html
echo "portable archive: $size MB unpacked; runs with only the C library, also after it was moved"
