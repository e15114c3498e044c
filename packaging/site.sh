#!/usr/bin/env bash
# Makes the site: a folder of static files for any server, with the studio, the manual and a page for each bundled
# pattern. Its pages send no requests to other servers. The same sources, program and studio give the same bytes.
# usage: packaging/site.sh OUTPUT [PROGRAM] [STUDIO_FOLDER]
# PROGRAM draws and plays the patterns (build/release/bin/sikku); STUDIO_FOLDER contains sikku-studio.html (build/studio).
# Needs python3 and cmark-gfm. OUTPUT is replaced if it is a site that this script made.
set -euo pipefail
[ $# -ge 1 ] && [ $# -le 3 ] || { echo "usage: packaging/site.sh OUTPUT [PROGRAM] [STUDIO_FOLDER]" >&2; exit 2; }
here=$(realpath "$(dirname "$0")")
root=$(dirname "$here")
output=$(realpath -m "$1")
program=${2:-$root/build/release/bin/sikku}
studio=${3:-$root/build/studio}
. "$root/tests/packages.sh"
install_packages "${site_packages[@]}"
export LC_ALL=C.UTF-8 TZ=UTC PYTHONDONTWRITEBYTECODE=1
exec python3 "$here/site/build.py" "$output" --program "$program" --studio "$studio/sikku-studio.html" \
    --version "$("$here/version.sh")"
