# refused EXPECTED COMMAND…: fails unless the command fails with a message that matches. Writes the file `refusal`.
refused() {
    local expected=$1
    shift
    if "$@" > refusal 2>&1; then echo "not refused: $*"; exit 1; fi
    grep -q -e "$expected" refusal || { cat refusal; echo "expected: $expected"; exit 1; }
}
