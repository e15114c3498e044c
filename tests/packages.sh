# What Debian 12 packages the project needs; sourced by ./demo and ./check.

build_packages=(g++ cmake ninja-build libopenimageio-dev libglm-dev libboost-dev libfmt-dev libcli11-dev
    libpugixml-dev libtbb-dev zlib1g-dev)
# For tests: the framework, and independent readers of what the program writes.
test_packages=(libgtest-dev libxml2-utils librsvg2-bin openimageio-tools qpdf poppler-utils pngcheck
    midicsv python3-mido)
full_packages=(clang libclang-rt-14-dev inkscape lilypond musescore3 fluidsynth timgm6mb-soundfont flac chromium npm)

# Installs those of its arguments that are missing, saying which.
install_packages() {
    local missing=() package
    for package in "$@"; do
        case "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null)" in
            installed) ;;
            *) missing+=("$package") ;;
        esac
    done
    [ "${#missing[@]}" -gt 0 ] || return 0
    local root=()
    if [ "$(id -u)" -ne 0 ]; then
        if ! command -v sudo > /dev/null; then
            echo "These packages are missing, and neither root nor sudo is here to install them:" >&2
            echo "  apt-get install ${missing[*]}" >&2
            exit 1
        fi
        root=(sudo)
    fi
    echo "Installing: ${missing[*]}"
    local log
    log=$(mktemp)
    if ! { "${root[@]}" apt-get update &&
        "${root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends "${missing[@]}"; } \
        > "$log" 2>&1; then
        tail -n 20 "$log" >&2
        rm -f "$log"
        echo "These packages could not be installed: ${missing[*]}" >&2
        exit 1
    fi
    rm -f "$log"
}
