#!/usr/bin/env bash
# Makes ARCHIVE of NAME in FOLDER, with the same bytes wherever and whenever it is made: files are sorted, of nobody, and
# as old as the commit.
# usage: packaging/archive.sh FOLDER NAME ARCHIVE
set -euo pipefail
[ $# -eq 3 ] || { echo "usage: packaging/archive.sh FOLDER NAME ARCHIVE" >&2; exit 2; }
tar --sort=name --owner=0 --group=0 --numeric-owner --mode=u=rwX,go=rX --mtime="@${SOURCE_DATE_EPOCH:-0}" \
    --format=gnu -C "$1" -cf - "$2" | gzip -9n > "$3"
