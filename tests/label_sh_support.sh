#!/usr/bin/env bash
# For the tests of label.sh through the real meshlabserver, which source this: parts in a folder of their own, and what to ask of a run.
# shellcheck disable=SC2034  # names for those who source it
set -uo pipefail
for tool in meshlabserver Xvfb admesh; do
	command -v $tool >/dev/null || { echo "skipped: $tool is not installed"; exit 77; }
done
label=$TEXTLABEL_SOURCE_DIR/filter_textlabel/label.sh
judge=$TEXTLABEL_SOURCE_DIR/tests/oracle_admesh.sh
work=$(mktemp -d)
trap 'umount -l "$work/small" 2>/dev/null; rm -rf "$work"' EXIT
cd "$work" || exit 1
failures=0
fail() {
	echo "FAILED: $*" >&2
	[ ! -s said ] || sed 's/^/    /' said >&2
	failures=$((failures + 1))
}

# ---- meshes

box() { # NAME WIDTH DEPTH HEIGHT
	cat >"$1" <<-END
		OFF
		8 12 0
		0 0 0
		$2 0 0
		$2 $3 0
		0 $3 0
		0 0 $4
		$2 0 $4
		$2 $3 $4
		0 $3 $4
		3 0 2 1
		3 0 3 2
		3 4 5 6
		3 4 6 7
		3 0 1 5
		3 0 5 4
		3 1 2 6
		3 1 6 5
		3 2 3 7
		3 2 7 6
		3 3 0 4
		3 3 4 7
	END
}
box box.off 60 40 10
# A fin stands on the diagonal of the box's top: an edge of three faces.
sed -e '2s/.*/9 13 0/' -e '10a 30 20 15' box.off >fin.off && echo "3 4 6 8" >>fin.off
# The top is a frame around an open hole of 20 x 10.
cat >hole.off <<-END
	OFF
	12 18 0
	0 0 0
	60 0 0
	60 40 0
	0 40 0
	0 0 10
	60 0 10
	60 40 10
	0 40 10
	20 15 10
	40 15 10
	40 25 10
	20 25 10
	3 0 2 1
	3 0 3 2
	3 0 1 5
	3 0 5 4
	3 1 2 6
	3 1 6 5
	3 2 3 7
	3 2 7 6
	3 3 0 4
	3 3 4 7
	3 4 5 9
	3 4 9 8
	3 5 6 10
	3 5 10 9
	3 6 7 11
	3 6 11 10
	3 7 4 8
	3 7 8 11
END
# A block with a V-shaped groove along y: slopes from (0, 60) and (60, 60) down to (30, 5).
cat >groove.off <<-END
	OFF
	10 16 0
	0 0 0
	60 0 0
	60 0 60
	30 0 5
	0 0 60
	0 80 0
	60 80 0
	60 80 60
	30 80 5
	0 80 60
	3 0 1 3
	3 1 2 3
	3 0 3 4
	3 5 8 6
	3 6 8 7
	3 5 9 8
	3 0 5 6
	3 0 6 1
	3 1 6 7
	3 1 7 2
	3 2 7 8
	3 2 8 3
	3 3 8 9
	3 3 9 4
	3 4 9 5
	3 4 5 0
END
printf 'OFF\n8 6 0\n0 0 0\n60 0 0\n60 40 0\n0 40 0\n0 0 10\n60 0 10\n60 40 10\n0 40 10\n' >quads.off
printf '4 3 2 1 0\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n' >>quads.off
printf 'ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nend_header\n0 0 0\n1 0 0\n0 1 0\n' >cloud.ply
printf 'OFF\n0 0 0\n' >empty.off
printf 'this is no mesh\n' >nonsense.stl
printf 'this is no font\n' >nonsense.ttf
# A drawing: a frame whose ink is (800 - 200) / 20^2 = 1.5 times its height squared.
printf '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 40 20"><path fill-rule="evenodd" d="%s"/></svg>\n' \
	'M0 0h40v20h-40z M10 5h20v10h-20z' >logo.svg

# camera FILE X Y Z [TYPE]: a copied camera at (X, Y, Z) that looks down, as MeshLab writes it
camera() {
	cat >"$1" <<-END
		<!DOCTYPE ViewState>
		<project>
		 <VCGCamera TranslationVector="$(echo "$2 $3 $4" | awk '{ print -$1, -$2, -$3 }') 1" LensDistortion="0 0" ViewportPx="800 600" PixelSizeMm="0.0369161 0.0369161" CenterPx="400 300" FocalMm="19.1807" CameraType="${5:-0}" BinaryData="0" RotationMatrix="1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1 "/>
		 <ViewSettings NearPlane="0.1" TrackScale="0.03" FarPlane="10"/>
		</project>
	END
}
camera above.xml 30 20 110

at=(--at 30,20,10 --size 8 --depth 0.5)  # on the top of box.off

# ---- what to ask

# number KEY: a number of report.json
number() { sed -n "s/.*\"$1\":\([-+.0-9e]*\).*/\1/p" report.json; }

# about A B TOLERANCE: |A - B| <= TOLERANCE
about() { awk -v a="$1" -v b="$2" -v t="$3" 'BEGIN { d = a - b; exit !((d < 0 ? -d : d) <= t) }'; }

works() { # OUTPUT ARGUMENTS OF label.sh: run, and check the exit
	rm -f -- report.json "$1"
	"$label" --report report.json "${@:2}" >said 2>&1 || { fail "exit $? of label.sh ${*:2}"; return 1; }
	[ -s "$1" ] || { fail "no $1 from label.sh ${*:2}"; return 1; }
}

# sound FILE.stl: closed, nothing to repair, by admesh
sound() {
	bash "$judge" "$1" >judged || { fail "admesh cannot read $1"; return; }
	if grep -qvE '^(faces|faces_left|parts|volume)=|=0$' judged; then
		fail "admesh had to repair $1: $(tr '\n' ' ' <judged)"
	fi
}

# refused STATUS "PATTERN" ARGUMENTS: the exit status, a message that matches, and nothing written or changed
refused() {
	local status=$1 pattern=$2 before after code
	shift 2
	rm -f out.stl
	before=$(find . -type f ! -name said -exec cksum {} + | sort)
	"$label" "$@" >said 2>&1
	code=$?
	after=$(find . -type f ! -name said -exec cksum {} + | sort)
	[ $code -eq "$status" ] || fail "exit $code instead of $status: label.sh $*"
	grep -qE -- "$pattern" said || fail "the message does not match '$pattern': label.sh $*"
	[ "$before" = "$after" ] || fail "files changed: label.sh $*"
}

# conclude: the end of a test
conclude() {
	[ $failures -eq 0 ] && echo "all as it should be"
	exit $((failures > 0))
}
