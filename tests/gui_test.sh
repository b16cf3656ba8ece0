#!/usr/bin/env bash
# Drive the window of the real MeshLab 2020.09: open a part, menu, dialog, turn the part, Apply, export; then save the filter
# script, run it with meshlabserver and compare. With TEXTLABEL_SCREENSHOTS=FOLDER the pictures of the way go there.
set -uo pipefail
for tool in meshlab meshlabserver Xvfb xdotool import admesh; do
	command -v $tool >/dev/null || { echo "skipped: $tool is not installed"; exit 77; }
done
. "$TEXTLABEL_SOURCE_DIR/filter_textlabel/meshlab_tree.sh"
work=$(mktemp -d)
meshlab_pid=
trap 'kill $meshlab_pid $display_pid 2>/dev/null; rm -rf "$work"' EXIT
cd "$work" || exit 1
shots=${TEXTLABEL_SCREENSHOTS:-$work/shots}
mkdir -p "$shots"

die() {
	shot failed
	echo "FAILED: $*" >&2
	tail -n 20 errors >&2
	exit 1
}
shot() { import -window root "$shots/$1.png"; }
click() { xdotool mousemove "$1" "$2" sleep 0.1 click 1 sleep 0.5; }

# wait_for "WHAT" COMMAND...: until the command succeeds
wait_for() {
	local what=$1 i
	shift
	for ((i = 0; i < 900; i++)); do
		"$@" >/dev/null 2>&1 && return
		kill -0 "$meshlab_pid" 2>/dev/null || die "MeshLab has ended while the test waited for: $what"
		sleep 0.1
	done
	die "waited in vain for: $what"
}
window() { xdotool search --onlyvisible --name "$1" | tail -n 1; }
height() { xdotool getwindowgeometry "$1" | sed -n 's/.*Geometry: .*x//p'; }

# A box of 60 x 40 x 10 as ASCII STL.
awk 'BEGIN {
	split("0 0 0 60 0 0 60 40 0 0 40 0 0 0 10 60 0 10 60 40 10 0 40 10", c, " ")
	split("0 2 1 0 3 2 4 5 6 4 6 7 0 1 5 0 5 4 1 2 6 1 6 5 2 3 7 2 7 6 3 0 4 3 4 7", f, " ")
	print "solid box"
	for (i = 1; i <= 36; i += 3) {
		print "facet normal 0 0 0\nouter loop"
		for (k = 0; k < 3; k++) print "vertex", c[3 * f[i + k] + 1], c[3 * f[i + k] + 2], c[3 * f[i + k] + 3]
		print "endloop\nendfacet"
	}
	print "endsolid box"
}' >box.stl
cp box.stl part.stl

# With few other plugins the menus are short: Text Label is alone in its submenu.
make_meshlab_tree "$work/tree" meshlab "$TEXTLABEL_PLUGIN" 'lib[di]*_*.so'
start_display "$work" 1600x1000x24 || exit 1
HOME=$work XDG_RUNTIME_DIR=$work LC_ALL=C.UTF-8 tree/bin/meshlab part.stl >log 2>errors &
meshlab_pid=$!
wait_for "the part to be open" grep -q "All files opened" errors
wait_for "the main window" window '^MeshLab 2020'
main=$(window '^MeshLab 2020')
xdotool windowmove --sync "$main" 0 0 windowsize --sync "$main" 1600 1000 sleep 1
shot 1-open

# Filters > Remeshing, Simplification and Reconstruction > Text Label
click 117 11
click 262 168
shot 2-menu
click 543 168
wait_for "the dialog" window '^Text Label$'
dialog=$(window '^Text Label$')
xdotool windowmove --sync "$dialog" 1060 60 windowfocus "$dialog" sleep 0.5
bottom=$((60 + $(height "$dialog")))  # its rows are counted from below: the text above depends on the fonts
[ $bottom -le 1000 ] || die "the dialog is $((bottom - 60)) pixels high: too high for a screen"
click 1425 $((bottom - 679))
xdotool key ctrl+a type 'B7'
shot 3-dialog

# Turn the part after the dialog was opened: the view at Apply counts.
xdotool mousemove 600 500 mousedown 1
for i in 1 2 3 4 5 6 7 8 9 10; do xdotool mousemove $((600 + 4 * i)) $((500 - 6 * i)) sleep 0.05; done
xdotool mouseup 1 sleep 0.5
xdotool windowraise "$dialog" windowfocus "$dialog" sleep 0.3
click 1455 $((bottom - 23))
wait_for "the label" grep -q "Applied filter Text Label\|Filter failed" errors
shot 4-labelled
grep -q "Applied filter Text Label" errors || die "the filter failed"
report=$(sed -n 's/^Text Label: \({.*\)/\1/p' errors | head -n 1)
click 1160 $((bottom - 23))

# Export (over part.stl; the dialog's OK is its default)
xdotool windowfocus "$main" key ctrl+e
wait_for "the saving options" window 'Saving Options'
shot 5-export
xdotool key Return
wait_for "the saved mesh" grep -q "Saved Mesh" errors

# Filters > Show current filter script > Save Script
click 117 11
click 200 62
wait_for "the script window" window '^Dialog$'
read -r x y < <(xdotool getwindowgeometry "$(window '^Dialog$')" | sed -n 's/.*Position: \([0-9]*\),\([0-9]*\).*/\1 \2/p')
click $((x + 50)) $((y + 378))
wait_for "the file window" window 'Save Filter Script'
xdotool windowfocus "$(window 'Save Filter Script')" sleep 0.5 key ctrl+a type "$work/saved.mlx"
shot 6-script
xdotool key Return
wait_for "the saved script" test -s saved.mlx
kill -0 $meshlab_pid || die "MeshLab has ended"

# ---- what came out

failures=0
check() { # "WHAT" COMMAND...
	local what=$1
	shift
	"$@" || { echo "FAILED: $what" >&2; failures=$((failures + 1)); }
}
triple() { sed -n "s/.*\"$1\":\[\([^]]*\)\].*/\1/p" <<<"$report" | tr ',' ' '; }
number() { sed -n "s/.*\"$1\":\([-+.0-9e]*\).*/\1/p" <<<"$report"; }

# The window shows its log as HTML: tags that are not escaped would vanish from it.
check "the log window shows the script" grep -q '&lt;FilterScript&gt;' errors
check "the text in the dialog is the label's" grep -q '"text":"B7"' <<<"$report"
# The axis of the view, from its viewpoint and direction, meets the top (z = 10) in the anchor; and the view had been
# turned, by less on a slow machine, where MeshLab sees but a few steps of the mouse.
check "the label is in the centre of the turned view" awk -v c="$(triple viewpoint)" -v d="$(triple direction)" -v a="$(triple anchor)" 'BEGIN {
	split(c, C); split(d, D); split(a, A)
	t = (C[3] - 10) / D[3]
	x = C[1] - t * D[1] - A[1]; y = C[2] - t * D[2] - A[2]
	exit !(A[3] > 9.9999 && A[3] < 10.0001 && x * x + y * y < 1e-6 && D[1] * D[1] + D[2] * D[2] > 0.0001) }'
bash "$TEXTLABEL_SOURCE_DIR/tests/oracle_admesh.sh" part.stl >judged || die "admesh cannot read the exported mesh"
check "admesh had nothing to repair: $(tr '\n' ' ' <judged)" awk -F= '!/^(faces|faces_left|parts|volume)=/ && $2 != 0 { bad = 1 } END { exit bad }' judged
check "the letters have the volume that is reported" awk -F= -v v="$(number volume_after)" '/^volume=/ { d = $2 - v; exit !(v > 24001 && d * d < 0.0001) }' judged

kill $meshlab_pid
wait $meshlab_pid 2>/dev/null
make_meshlab_tree "$work/server" meshlabserver "$TEXTLABEL_PLUGIN" 'libio_*.so'
LC_ALL=C.UTF-8 XDG_RUNTIME_DIR=$work server/bin/meshlabserver -i box.stl -s saved.mlx -o replayed.stl >replay.log 2>&1
check "the script runs in meshlabserver: $(tail -n 3 replay.log)" test -s replayed.stl
check "the script saved in the window gives the same bytes" cmp replayed.stl part.stl
[ $failures -eq 0 ] && echo "all as it should be"
exit $((failures > 0))
