#!/usr/bin/env bash
# Examines the desktop files of an installed Sikku, and makes a thumbnail as a file manager does.
# usage: tests/release/desktop.sh DIST
set -euo pipefail
[ $# -eq 1 ] || { echo "usage: tests/release/desktop.sh DIST" >&2; exit 2; }
here=$(dirname "$(readlink -f "$0")")
. "$here/root.sh"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
root=$work/root
make_root bookworm "$root" minbase desktop-file-utils shared-mime-info xdg-utils libglib2.0-bin python3-gi \
    gir1.2-gnomedesktop-3.0 librsvg2-common bubblewrap
cp "$1"/sikku_*.deb "$root/tmp"
in_root "$root" sh -euc '
    apt-get -qq update > /dev/null
    apt-get -qq install -y --no-install-recommends /tmp/sikku_*.deb > /dev/null 2>&1
    [ -z "$(desktop-file-validate /usr/share/applications/sikku.desktop 2>&1 | tee /dev/stderr)" ]
    cp /usr/share/sikku/patterns/*/hilbert.lsys /tmp/a.lsys
    [ "$(xdg-mime query filetype /tmp/a.lsys)" = text/x-lsystem ]
    gio mime text/x-lsystem | grep -q sikku.desktop
    cat > /tmp/thumbnail.py <<END
import gi
gi.require_version("GnomeDesktop", "3.0")
from gi.repository import GnomeDesktop
factory = GnomeDesktop.DesktopThumbnailFactory.new(GnomeDesktop.DesktopThumbnailSize.NORMAL)
address, kind = "file:///tmp/a.lsys", "text/x-lsystem"
assert factory.can_thumbnail(address, kind, 0), "no thumbnailer"
picture = factory.generate_thumbnail(address, kind, None)
print(picture.get_width(), picture.get_height())
END
    python3 /tmp/thumbnail.py' > "$work/log" 2>&1 || { cat "$work/log"; fail "the desktop files fail"; }
echo "desktop: valid, opens patterns; thumbnail of $(tail -n 1 "$work/log" | tr ' ' x) pixels"
