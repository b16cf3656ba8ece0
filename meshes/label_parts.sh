#!/usr/bin/env bash
# Label the parts of this folder as parts.tsv says, with the real MeshLab: the labelled meshes, their reports and pictures go to a
# folder, and the table of README to standard output. The pictures of README were made so.
#
# usage: meshes/label_parts.sh FOLDER

set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
[ $# -eq 1 ] || { echo "usage: meshes/label_parts.sh FOLDER" >&2; exit 2; }
mkdir -p "$1"

# A value of a report, which is one line of JSON.
value() { sed -E "s/.*\"$2\":\"?([^,}\"]*).*/\1/" "$1"; }
same() { [ "$(value "$1" "$2_before")" = "$(value "$1" "$2_after")" ]; }

echo "| part | label | triangles | in the paper | label made in | valid |"
echo "|---|---|---|---|---|---|"
while IFS=$'\t' read -r file text style size depth position direction up along color _ _ _ _ figure before after views; do
	case $file in '' | '#'* | file) continue ;; esac
	name=${file%.stl} output=$1/${file%.stl}-labelled.stl
	options=(--style "$style" --size "$size" --at "$position" --direction "$direction" --up "$up" --along "$along")
	[ "$style" = flat ] || options+=(--depth "$depth")
	[ "$color" = - ] || { options+=(--color "$color"); output=${output%.stl}.ply; }  # few programs read the colours of an STL
	"$here/../filter_textlabel/label.sh" "${options[@]}" --report "$1/$name.json" --picture "$1/$name.png" -- \
		"$here/$file" "$output" "$text"
	if [[ $views == *\;* ]]; then  # an open surface has a back
		"$here/../filter_textlabel/label.sh" "${options[@]}" --set picture_back=true --picture "$1/$name-back.png" -- \
			"$here/$file" "$output" "$text"
	fi
	report=$1/$name.json valid=no
	if [ "$(value "$report" non_manifold_edges_after)" = 0 ] && same "$report" border_edges && same "$report" components &&
		same "$report" genus; then valid=yes; fi
	paper="figure $figure"
	[ "$before" = - ] || paper="$paper: $before → $after"
	# The times have points, whatever the user's locale writes.
	LC_ALL=C printf '| `%s` | %s, %s | %s → %s | %s | %.1f ms | %s |\n' "$file" "$text" "$style" "$(value "$report" triangles_before)" \
		"$(value "$report" triangles_after)" "$paper" "$(value "$report" label)" "$valid"
done <"$here/parts.tsv"
