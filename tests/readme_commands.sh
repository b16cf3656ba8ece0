#!/usr/bin/env bash
# Every command of README works as it stands there: each fenced block marked `sh` runs in a shell of its own, from the top of
# the project. Blocks for another system or that take hours carry another mark (`text`, `sh-long`, `bat`); running all tests, of
# which this is one, and cloning the project are left out. A command must leave the project's own files alone.

set -euo pipefail
cd "${TEXTLABEL_SOURCE_DIR:-$(dirname "${BASH_SOURCE[0]}")/..}"
[ -f README.md ] || {
	echo "no README.md"
	exit 1
}

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
awk -v folder="$work" '
	/^```sh$/ { file = sprintf("%s/%03d.sh", folder, NR); printf "" > file; next }
	/^```/    { file = ""; next }
	file && !/^(git clone|cd |(time )?tests\/run\.sh|\.ci\/run)/ { print > file }' README.md

unset TEXTLABEL_PLUGIN  # a newcomer has none
rm -rf build/serials build/coded  # or the commands would find all done
before=$(git status --porcelain 2>/dev/null || true)
failed=0 count=0
for block in "$work"/*.sh; do
	[ -s "$block" ] || continue
	count=$((count + 1))
	echo "== README.md line $((10#$(basename "$block" .sh)))"
	cat "$block"
	if ! bash -euo pipefail "$block" </dev/null; then
		echo "FAILED"
		failed=1
	fi
done
[ "$count" -gt 0 ] || {
	echo "README.md has no block marked sh"
	exit 1
}
if [ "$(git status --porcelain 2>/dev/null || true)" != "$before" ]; then
	echo "the commands left new or changed files in the project:"
	git status --porcelain
	failed=1
fi
exit $failed
