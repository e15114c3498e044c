# What Debian 12 packages the project needs; sourced by ./demo and ./check.

build_packages=(g++ cmake ninja-build libopenimageio-dev libheif-dev libglm-dev libboost-dev libfmt-dev libcli11-dev
    libtbb-dev zlib1g-dev liblcms2-dev libtomlplusplus-dev nlohmann-json3-dev libpugixml-dev
    libasound2-dev liblo-dev libfontconfig-dev libfreetype-dev libfribidi-dev libharfbuzz-dev)
# For tests: the framework, independent readers of the program's outputs, the linters, and the Python module.
test_packages=(libgtest-dev libxml2-utils librsvg2-bin openimageio-tools qpdf poppler-utils pngcheck
    ghostscript libtiff-tools libimage-exiftool-perl libharfbuzz-bin fonts-lohit-taml fonts-noto-core
    midicsv python3-mido python3-ezdxf clang-format clang-tidy
    pybind11-dev python3-dev python3-numpy python3-pytest python3-setuptools python3-wheel python3-venv mypy)
# For the studio: the compiler to WebAssembly, a library for what its C++ library lacks, a compressor for the page, and
# browsers for the tests. npm may already be installed from elsewhere, with a newer version of node.
studio_packages=(emscripten libfast-float-dev xz-utils)
browser_packages=(chromium firefox-esr)
# For ./check --full, together with those of the studio.
full_packages=(clang libclang-rt-14-dev libc++-13-dev inkscape lilypond musescore3 abcmidi csound fluidsynth
    timgm6mb-soundfont flac slurm-wlm munge librecad neovim)
# For building packages and testing their contents.
packaging_packages=(debhelper dh-python fakeroot patchelf pybind11-dev python3-dev python3-numpy python3-setuptools
    python3-wheel python3-pip unzip)
# For packaging/site.sh.
site_packages=(cmark-gfm python3)
# For packaging/book.sh: for setting pages, for placing drawings on them, and the fonts.
book_packages=(weasyprint python3-pikepdf fonts-linuxlibertine fonts-inconsolata)
# For packaging/release.sh: these, and the packages that the slim OpenImageIO is built from.
release_packages=("${packaging_packages[@]}" libboost-thread-dev libopenexr-dev libtiff-dev libjpeg-dev libpng-dev
    libwebp-dev robin-map-dev)
# For ./check --release: roots of other systems and machines, and tools that examine packages and desktop files.
root_packages=(clang locales mmdebstrap lintian qemu-user-static g++-aarch64-linux-gnu g++-i686-linux-gnu desktop-file-utils
    shared-mime-info xdg-utils)
command -v npm > /dev/null || studio_packages+=(npm)

# Those of its arguments that are not installed, a line each.
missing_packages() {
    local package
    for package in "$@"; do
        [ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2> /dev/null)" = installed ] || echo "$package"
    done
}

# Installs those of its arguments that are missing, saying which.
install_packages() {
    local missing root=() log
    mapfile -t missing < <(missing_packages "$@")
    [ "${#missing[@]}" -gt 0 ] || return 0
    if [ "$(id -u)" -ne 0 ]; then
        if ! command -v sudo > /dev/null; then
            echo "These packages are missing, and neither root nor sudo is here to install them:" >&2
            echo "  apt-get install ${missing[*]}" >&2
            return 1
        fi
        root=(sudo)
    fi
    echo "Installing: ${missing[*]}"
    log=$(mktemp)
    if ! { "${root[@]}" apt-get update &&
        "${root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends "${missing[@]}"; } \
        > "$log" 2>&1; then
        tail -n 20 "$log" >&2
        rm -f "$log"
        echo "These packages could not be installed: ${missing[*]}" >&2
        return 1
    fi
    rm -f "$log"
}

# Installs what can be had; the tests say what they skip for want of the rest.
install_if_possible() {
    local package
    install_packages "$@" && return
    for package in $(missing_packages "$@"); do
        install_packages "$package" || echo "going on without $package"
    done
}
