# common.sh - what the long checks share; each is a bash script that includes it and speaks TAP (tests/run).
#
# They use the program as a person does: $SPLATLAB (./splatlab), on small sample scenes in a scratch folder.
set -u
cd "$(dirname "${BASH_SOURCE[0]}")/../.." || exit 1
SPLATLAB=${SPLATLAB:-./splatlab}
scratch=$(mktemp -d) || exit 1
trap 'rm -rf "$scratch"' EXIT

number=0
# check NAME COMMAND...: one test; it passes when the command does. What a failed one printed is shown.
check() {
    local name=$1; shift
    number=$((number + 1))
    if "$@" >"$scratch/said" 2>&1; then
        echo "ok $number - $name"
    else
        echo "not ok $number - $name"
        tail -n 40 "$scratch/said" | sed 's/^/# /'
    fi
}
