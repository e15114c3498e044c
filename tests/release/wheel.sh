#!/usr/bin/env bash
# Installs the wheel of a release beside Debian's NumPy, with and without OpenImageIO, and runs the tutorial.
# usage: tests/release/wheel.sh DIST
set -euo pipefail
[ $# -eq 1 ] || { echo "usage: tests/release/wheel.sh DIST" >&2; exit 2; }
here=$(dirname "$(readlink -f "$0")")
. "$here/root.sh"
dist=$(realpath "$1")
wheel=$(echo "$dist"/sikku-*.whl)
size=$(stat -c %s "$wheel")
[ "$size" -le 12000000 ] || fail "the wheel has $size bytes; at most 12,000,000 are wanted"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
root=$work/root
make_root bookworm "$root" minbase python3-venv python3-numpy
mkdir -p "$root/tmp/python"
cp "$wheel" "$root/tmp"
cp -r "$here/../../python/tutorial.py" "$here/../../docs" "$here/manual.py" "$root/tmp/python"
in_root "$root" sh -euc '
    python3 -m venv --system-site-packages /venv
    /venv/bin/pip install -q --no-index /tmp/*.whl
    cd /tmp/python && /venv/bin/python - <<END
import sikku
print(sikku.__version__)
open("a.png", "wb").write(sikku.load("hilbert").draw("png", dpi=50))
try:
    sikku.load("hilbert").draw("tif", dpi=50)
except Exception as error:
    print(error)
else:
    raise SystemExit("TIFF without OpenImageIO")
END' > "$work/log" 2>&1 || { cat "$work/log"; fail "the wheel fails"; }
grep -q OpenImageIO "$work/log" || { cat "$work/log"; fail "the message does not name OpenImageIO"; }
in_root "$root" sh -euc 'apt-get -qq update > /dev/null; apt-get -qq install -y --no-install-recommends libopenimageio2.4 liblcms2-2 > /dev/null 2>&1
    cd /tmp/python && /venv/bin/python -c "import sikku; assert sikku.load(\"hilbert\").draw(\"tif\", dpi=50)"
    /venv/bin/python tutorial.py && /venv/bin/python manual.py docs/python.md' > "$work/log" 2>&1 || { tail -n 30 "$work/log"; fail "the manual fails with the wheel"; }
# Other machines and older C libraries.
accepts() {
    /usr/bin/python3 -m pip download -q --no-deps --no-index --find-links "$dist" --only-binary :all: --platform "$1" \
        --python-version "$2" -d "$work/none" sikku > /dev/null 2>&1
}
accepts manylinux_2_36_x86_64 3.11 || fail "pip refuses the wheel for the system that it was built on"
for tag in linux_aarch64 manylinux_2_36_aarch64 manylinux_2_17_x86_64 musllinux_1_2_x86_64 macosx_11_0_arm64 win_amd64; do
    if accepts "$tag" 3.11; then fail "pip accepts the wheel for $tag"; fi
done
for version in 3.10 3.12; do
    if accepts manylinux_2_36_x86_64 "$version"; then fail "pip accepts the wheel for Python $version"; fi
done
echo "wheel: $(printf "%'d" "$size") bytes; PNG without OpenImageIO, TIFF with it; the manual's examples run; refused on other machines"
