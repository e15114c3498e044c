#!/usr/bin/env bash
# Builds Sikku in a root of Debian 13 (build/debian13) with its compiler and libraries, and runs the tests there.
# usage: tests/release/debian13.sh
set -euo pipefail
here=$(dirname "$(readlink -f "$0")")
. "$here/root.sh"
cd "$here/../.."
. tests/packages.sh
root=$PWD/build/debian13
if [ ! -d "$root" ]; then
    rm -rf "$root.new"
    # Codecs of HEIF are packages of their own.
    make_root trixie "$root.new" minbase "${build_packages[@]}" "${test_packages[@]}" libheif-plugins-all git
    mv "$root.new" "$root"
fi
# Files that did not change keep their times, so that a second run compiles little.
if [ -d "$root/sikku/.git" ]; then
    git -C "$root/sikku" fetch -q "$PWD" HEAD
    git -C "$root/sikku" reset -q --hard FETCH_HEAD
else
    git clone -q . "$root/sikku"
fi
# Warnings are those of another compiler.
in_root "$root" sh -euc 'cd /sikku
    cmake --preset dev -DSIKKU_WERROR=OFF -DSIKKU_PYTHON=OFF > /tmp/log 2>&1
    cmake --build --preset dev -j "$(nproc)" > /tmp/log 2>&1' || { tail -n 40 "$root/tmp/log"; fail "Debian 13: not built"; }
in_root "$root" sh -c 'cd /sikku && ctest --preset dev -j "$(nproc)" --label-exclude stress' > build/debian13.log 2>&1 ||
    { tail -n 40 build/debian13.log; fail "Debian 13: tests fail"; }
grep 'tests passed' build/debian13.log | sed 's/^/Debian 13: /'
