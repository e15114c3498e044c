#!/usr/bin/env bash
# Builds a release twice, in different folders and at different times, compares the bytes, and tests what was built in
# systems without any files of Sikku. Takes up to three hours.
# usage: tests/release/run.sh
set -euo pipefail
cd "$(dirname "$0")/../.."
. tests/packages.sh
. tests/release/root.sh
[ "$(id -u)" -eq 0 ] || fail "roots of other systems need root"
install_packages "${build_packages[@]}" "${test_packages[@]}" "${root_packages[@]}" "${release_packages[@]}"
install_if_possible "${browser_packages[@]}"
version=$(packaging/version.sh)
first=$PWD/build/release-1
# On another file system, with another umask.
second=$(mktemp -d -p /dev/shm)/elsewhere
work=$(mktemp -d)
trap 'rm -rf "$(dirname "$second")" "$work"' EXIT
packaging/release.sh "$first" > build/release-1.log || { tail -n 40 build/release-1.log; exit 1; }
for test in packages portable wheel npm desktop; do tests/release/$test.sh "$first"; done
tests/release/vscode.sh "$first" build/dist/bin/sikku

# An sdist builds without the checkout.
/usr/bin/python3 -m venv --system-site-packages "$work/venv"
"$work/venv/bin/pip" install -q --no-index --no-build-isolation "$first/sikku-$version.tar.gz" > "$work/log" 2>&1 ||
    { tail -n 40 "$work/log"; fail "the sdist does not build"; }
(cd "$work" && venv/bin/python -c 'import sikku; assert sikku.load("hilbert").draw("svg")')
echo "sdist: builds and runs without the checkout"

(umask 077 && git clone -q . "$second")
(cd "$second" && packaging/release.sh "$second/out" > "$second.log") || { tail -n 40 "$second.log"; exit 1; }
diff "$first/SHA256SUMS" "$second/out/SHA256SUMS" || fail "the bytes of the second build differ"
echo "a second build elsewhere: the same bytes"
tests/release/debian13.sh
tests/release/bytes.sh build/dist/bin/sikku build/studio
