#!/usr/bin/env bash
# Where numbers are written 1,5 the scripts read and write 1.5 as elsewhere: the table of README comes out the same.
set -euo pipefail
cd "${TEXTLABEL_SOURCE_DIR:-$(dirname "${BASH_SOURCE[0]}")/..}"
for tool in meshlabserver Xvfb localedef; do
	command -v $tool >/dev/null || { echo "skipped: $tool is not installed"; exit 77; }
done
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

printf 'LC_NUMERIC\ndecimal_point ","\nthousands_sep ""\ngrouping -1\nEND LC_NUMERIC\n' >"$work/numbers"
localedef -c -i "$work/numbers" "$work/comma" >"$work/log" 2>&1 || true  # it warns that all else is missing
export LOCPATH=$work
[ "$(LC_ALL=comma locale decimal_point)" = , ] || { echo "no locale with a comma:"; cat "$work/log"; exit 1; }

LC_ALL=comma meshes/label_parts.sh "$work/parts" >"$work/table"
# All but the times, which differ from run to run.
rows() { grep -E '^\| `' "$1" | sed -E 's/ [0-9]+\.[0-9] ms / ms /'; }
diff <(rows README.md | grep ' ms |') <(rows "$work/table") || { echo "the table is not README's"; exit 1; }
