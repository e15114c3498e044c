# For the tests of pages, which source it with their subject: sets `browser`, makes a folder with playwright-core in it
# the current one, or says what is skipped and ends.
# usage: . browser.sh SUBJECT

skip() { echo "skipped: $1 ($2)"; exit 0; }
browser=$(command -v chromium || command -v chromium-browser || command -v google-chrome) ||
    skip "$1" "chromium is not installed"
command -v npm > /dev/null || skip "$1" "npm is not installed"

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
npm install --silent --no-audit --no-fund --no-save playwright-core > npm.log 2>&1 ||
    skip "$1" "npm cannot install playwright-core: $(tail -n 1 npm.log)"
