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
    export XDG_CURRENT_DESKTOP=GNOME
    xdg-mime query filetype /tmp/a.lsys
    xdg-mime query default text/x-lsystem' > "$work/log" 2>&1 || { cat "$work/log"; fail "the desktop files fail"; }
[ "$(cat "$work/log")" = $'text/x-lsystem\nsikku.desktop' ] || { cat "$work/log"; fail "the desktop does not open patterns"; }

cat > "$root/tmp/thumbnail.py" <<'END'
import gi
gi.require_version("GnomeDesktop", "3.0")
from gi.repository import GnomeDesktop
factory = GnomeDesktop.DesktopThumbnailFactory.new(GnomeDesktop.DesktopThumbnailSize.NORMAL)
address, kind = "file:///tmp/a.lsys", "text/x-lsystem"
assert factory.can_thumbnail(address, kind, 0), "no thumbnailer"
picture = factory.generate_thumbnail(address, kind, None)
values = picture.get_pixels()
assert len(set(values)) > 1, "an empty thumbnail"
print(f"{picture.get_width()}x{picture.get_height()}")
END
# The factory runs thumbnailers in a sandbox, which does not work in a chroot: use pivot_root.
env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 unshare --mount --pid --fork --propagation private \
    sh -c 'mount --bind "$0" "$0" && mount -t proc proc "$0/proc" && cd "$0" && pivot_root . mnt && umount -l /mnt &&
        exec "$@"' "$root" python3 /tmp/thumbnail.py > "$work/log" 2>&1 || { cat "$work/log"; fail "no thumbnail"; }
echo "desktop: valid, opens patterns; thumbnail of $(tail -n 1 "$work/log") pixels"
