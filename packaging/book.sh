#!/usr/bin/env bash
# Makes the book: a PDF of the figures of five documents about L-systems, in their order. The same sources and program give
# the same bytes.
# usage: packaging/book.sh OUTPUT [PROGRAM] [OPTIONS]
# PROGRAM draws the figures (build/release/bin/sikku); OPTIONS are those of packaging/book/build.py.
set -euo pipefail
[ $# -ge 1 ] || { echo "usage: packaging/book.sh OUTPUT [PROGRAM] [OPTIONS]" >&2; exit 2; }
here=$(realpath "$(dirname "$0")")
root=$(dirname "$here")
output=$(realpath -m "$1")
program=${2:-$root/build/release/bin/sikku}
. "$root/tests/packages.sh"
install_packages "${book_packages[@]}"
export LC_ALL=C.UTF-8 TZ=UTC SOURCE_DATE_EPOCH=315532800 PYTHONDONTWRITEBYTECODE=1
# Debian's Python, which finds Debian's packages.
exec /usr/bin/python3 "$here/book/build.py" "$output" --program "$program" --version "$("$here/version.sh")" "${@:3}"
