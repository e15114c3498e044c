#!/usr/bin/env bash
# Examines the book of packaging/book.sh: pages, fonts, every figure of its list, links, numbers of pages in the index,
# pictures. Two builds of some figures, one in another folder and on one processor, have the same bytes.
# usage: tests/full/book.sh PROGRAM [BOOK]
# BOOK is a book that was made before; it is examined instead of a new one.
set -euo pipefail
[ $# -ge 1 ] || { echo "usage: tests/full/book.sh PROGRAM [BOOK]" >&2; exit 2; }
program=$(realpath "$1")
here=$(realpath "$(dirname "$0")")
root=$(realpath "$here/../..")
. "$root/tests/packages.sh"
missing=$(missing_packages "${book_packages[@]}" poppler-utils)
[ -z "$missing" ] || { echo "skipped: the book ($(echo $missing) not installed)"; exit 0; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
book=$(realpath -m "${2:-$folder/book.pdf}")
cd "$folder"

if [ ! -f "$book" ]; then
    started=$(date +%s)
    "$root/packaging/book.sh" "$book" "$program" 2> warnings
    [ ! -s warnings ] || { cat warnings; echo "the book was made with warnings"; exit 1; }
    echo "book: built in $(($(date +%s) - started)) s"
fi
pages=$(pdfinfo "$book" | sed -n 's/^Pages: *//p')
[ "$pages" -ge 60 ] && [ "$pages" -le 120 ] || { echo "the book has $pages pages, not 60 to 120"; exit 1; }
pdfinfo "$book" | grep -q '^Page size:.*(A4)' || { echo "the pages are not A4"; exit 1; }
[ "$(stat -c %s "$book")" -le 40000000 ] || { echo "the book has more than 40 MB"; exit 1; }
# Name, type, encoding, then whether it is embedded.
pdffonts "$book" | tail -n +3 > fonts
[ -s fonts ] && ! awk '{print $(NF - 4)}' fonts | grep -qv yes || { cat fonts; echo "fonts are not embedded"; exit 1; }
! grep -qvE 'Libertine|Inconsolata' fonts || { cat fonts; echo "a glyph is missing in the fonts of the book"; exit 1; }
qpdf --check "$book" > qpdf.log 2>&1 || { tail -n 5 qpdf.log; exit 1; }
LC_ALL=C.UTF-8 /usr/bin/python3 "$here/book.py" "$book"

few="Figure 1.3,Figure 1.4,Figure 6.1,Figure 6.9,Figure 11"
mkdir other
"$root/packaging/book.sh" few.pdf "$program" --only "$few" > facts
(cd other && TMPDIR=$folder/other TZ=Asia/Kolkata taskset -c 0 "$root/packaging/book.sh" "$folder/other/again.pdf" "$program" --only "$few" > /dev/null)
cmp few.pdf other/again.pdf
echo "book: two builds of $few have the same bytes ($(cat facts))"

. "$here/refused.sh"
refused "is missing; ./demo builds it" "$root/packaging/book.sh" x.pdf ./nothing
refused "unknown figure 'Figure 0'" "$root/packaging/book.sh" x.pdf "$program" --only "Figure 0"
refused "cannot be drawn" "$root/packaging/book.sh" x.pdf /bin/false --only "Figure 2.4"
[ ! -e x.pdf ]
