# Roots of other systems, for tests of a release; sourced.

mirror=http://deb.debian.org/debian

# make_root SUITE FOLDER VARIANT [PACKAGE…]: makes a root by mmdebstrap, with apt's sources in it.
make_root() {
    local suite=$1 folder=$2 variant=$3
    shift 3
    local list log
    list=$(IFS=,; echo "$*")
    log=$(mktemp)
    mmdebstrap --quiet --variant="$variant" ${list:+--include="$list"} ${architecture:+--architectures="$architecture"} \
        "$suite" "$folder" "$mirror" > "$log" 2>&1 || { cat "$log" >&2; rm -f "$log"; return 1; }
    rm -f "$log"
    mkdir -p "$folder/proc" "$folder/dev" "$folder/tmp"
}

# kept_root SUITE FOLDER VARIANT [PACKAGE…]: makes a root that other runs use, until its packages change.
kept_root() {
    local suite=$1 folder=$2 variant=$3
    shift 3
    if [ "$(cat "$folder.made" 2> /dev/null)" = "$suite $*" ]; then return; fi
    rm -rf "$folder" "$folder.new"
    make_root "$suite" "$folder.new" "$variant" "$@"
    mv "$folder.new" "$folder"
    echo "$suite $*" > "$folder.made"
}

# in_root FOLDER COMMAND…: runs a command in a root, as a fresh login would, with /proc and /dev for the command only.
in_root() {
    local folder=$1
    shift
    env -i PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 \
        DEBIAN_FRONTEND=noninteractive unshare --mount --pid --fork --mount-proc="$folder/proc" \
        sh -c 'mount --rbind /dev "$0/dev" && exec chroot "$0" "$@"' "$folder" "$@"
}

fail() { echo "$0: $*" >&2; exit 1; }
