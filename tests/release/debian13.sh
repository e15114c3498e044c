#!/usr/bin/env bash
# Builds Sikku in a root of Debian 13 (build/debian13) with its compiler and libraries, and runs the tests there.
# usage: tests/release/debian13.sh
set -euo pipefail
here=$(dirname "$(readlink -f "$0")")
. "$here/root.sh"
cd "$here/../.."
. tests/packages.sh
root=$PWD/build/debian13
# Codecs of HEIF are packages of their own.
kept_root trixie "$root" minbase "${build_packages[@]}" "${test_packages[@]}" libheif-plugins-all git
# Files that did not change keep their times, so that a second run compiles little.
if [ -d "$root/sikku/.git" ]; then
    git -C "$root/sikku" fetch -q "$PWD" HEAD
    git -C "$root/sikku" reset -q --hard FETCH_HEAD
else
    git clone -q . "$root/sikku"
fi
# Without -Werror, because another compiler has other warnings.
in_root "$root" sh -euc 'cd /sikku
    cmake --preset dev -DSIKKU_WERROR=OFF -DSIKKU_PYTHON=OFF > /tmp/log 2>&1
    cmake --build --preset dev -j "$(nproc)" > /tmp/log 2>&1' || { tail -n 40 "$root/tmp/log"; fail "Debian 13: not built"; }
in_root "$root" sh -c 'cd /sikku && ctest --preset dev -j "$(nproc)" --label-exclude stress' > build/debian13.log 2>&1 ||
    { tail -n 40 build/debian13.log; fail "Debian 13: tests fail"; }
grep 'tests passed' build/debian13.log | sed 's/^/Debian 13: /'
sed -n 's/.* - \(.*\) (Skipped)$/Debian 13: skipped: \1/p' build/debian13.log
