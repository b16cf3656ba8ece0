#!/usr/bin/env bash
# label.sh through the real meshlabserver: labels are measured, refusals say why and leave everything as it was.
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

# ---- what should work

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

for style in emboss engrave; do
	sign=1
	[ $style = emboss ] || sign=-1
	if works out.stl --style $style --size 8 --depth 0.5 --at 30,20,10 box.off out.stl 'A43 %&@'; then
		sound out.stl
		wanted=$(awk -v a="$(number label_area)" -v s=$sign 'BEGIN { print 60 * 40 * 10 + s * a * 0.5 }')
		volume=$(sed -n 's/^volume=//p' judged)
		about "$volume" "$wanted" 0.05 || fail "$style: volume $volume by admesh, $wanted from the letters' area"
		about "$(number volume_after)" "$wanted" 0.01 || fail "$style: volume $(number volume_after) in the report"
	fi
done

if works out.obj --style flat --color 12ab34 --size 8 --at 30,20,10 box.off out.obj 'A43'; then
	# area of the faces that have the label's colour, from the two files alone
	area=$(awk '
		FNR == NR { if ($1 == "newmtl") name = $2; if ($1 == "Kd") color[name] = $2 " " $3 " " $4; next }
		$1 == "v" { n++; x[n] = $2; y[n] = $3; z[n] = $4 }
		$1 == "usemtl" { now = color[$2] }
		$1 == "f" {
			split($2, a, "/"); split($3, b, "/"); split($4, c, "/"); i = a[1]; j = b[1]; k = c[1]
			twice = (x[j] - x[i]) * (y[k] - y[i]) - (x[k] - x[i]) * (y[j] - y[i])
			if (now == wanted && z[i] == 10 && z[j] == 10 && z[k] == 10) sum += twice / 2
		}
		END { print sum + 0 }' wanted="0.070588 0.670588 0.203922" out.obj.mtl out.obj)
	about "$area" "$(number label_area)" 0.001 || fail "flat: $area is coloured, the letters have $(number label_area)"
	about "$(number volume_after)" 24000 0.001 || fail "flat: the volume became $(number volume_after)"
fi

camera above.xml 30 20 110
if works out.stl --camera above.xml --size 8 --depth 0.5 box.off out.stl 'A43'; then
	sound out.stl
	grep -q '"anchor":\[30,20,10\]' report.json || fail "the camera looks at (30, 20, 10), the report says $(grep -o '"anchor":[^]]*' report.json)"
	# Towards a viewpoint 100 above, letters of height h lose (1 - h' / 100)^2 of their area on the way up; h' is the height along z.
	added=$(awk -v a="$(number label_area)" 'BEGIN { print a * 0.5 }')
	about "$(number volume_after)" "$(awk -v v="$added" 'BEGIN { print 24000 + v }')" "$(awk -v v="$added" 'BEGIN { print v * 0.02 }')" ||
		fail "camera: volume $(number volume_after)"
fi

# The same request gives the same bytes, and no placement at all is one.
works out.stl box.off out.stl 'A43' && cp out.stl first.stl && works out.stl box.off out.stl 'A43' && sound out.stl
cmp -s first.stl out.stl || fail "two runs differ"

# --set says where as the options do, and relative names of files are meant from here, also with a font's face or axes behind them.
font=$(fc-match -f '%{file}' 'DejaVu Sans')
if [ -f "$font" ] && cp "$font" own.ttf && works out.stl --at 30,20,10 --size 8 --font own.ttf box.off out.stl A43; then
	cp out.stl first.stl
	mkdir -p files
	if works out.stl --set position=30,20,10 --set size=8 --set font=own.ttf#0 --set report=files/r.json --set outline=files/o.svg \
		box.off out.stl A43; then
		cmp -s first.stl out.stl || fail "--set position is not --at"
		[ -s files/r.json ] && [ -s files/o.svg ] || fail "files of --set went elsewhere: $(ls files)"
	fi
fi
works out.stl --set placement=automatic --set direction=0,0,1 box.off out.stl A43 || fail "an explicit placement says where"
works out.stl --set placement=automatic --set position=1,2,3 box.off out.stl A43 && grep -q '"placement":"Automatic"' report.json ||
	fail "a placement that is given counts"

# Colours that few programs find in the file: it says so. What says a colour in --set counts as well.
works out.stl --style flat box.off out.stl A43 && grep -q 'few programs' said || fail "a flat label in an STL file, and no word about it"
works out.ply --set style=flat box.off out.ply A43 && [ ! -s said ] && head -c 400 out.ply | grep -qa 'property uchar red' ||
	fail "--set style=flat: no colours in the PLY file"

# Every parameter is listed.
"$label" --parameters >parameters || fail "exit $? of label.sh --parameters"
for name in text style max_stretch outline; do
	grep -q "^$name  .*default" parameters || fail "--parameters without $name"
done

# Names and texts are taken as they are.
mkdir "a \"b\" <&>'c' ä漢"
odd="a \"b\" <&>'c' ä漢/-p \$x;#.off"
cp box.off "$odd"
if works "${odd%.off} 2.stl" --size 5 -- "$odd" "${odd%.off} 2.stl" $'<&>"\'Äß\\n€ --x'; then
	sound "${odd%.off} 2.stl"
	grep -qF '"text":"<&>\"'"'"'Äß\\n€ --x"' report.json || fail "the text arrived as $(grep -o '"text":.*"font"' report.json)"
fi
for text in 'Text Label: A43' $'A\nText Label: B' 'LOG: 2 Text Label: C'; do
	works out.stl --size 3 -- box.off out.stl "$text" && sound out.stl
done
mkdir -- -r  # also as an option of rm
if works -r/out.obj --size 5 --color 12ab34 -- box.off -r/out.obj A; then
	[ "$(ls -A -- -r | sort | tr '\n' ' ')" = 'out.obj out.obj.mtl ' ] || fail "left in the folder -r: $(ls -A -- -r)"
fi
[ ! -s said ] || fail "a folder -r, and something to say about it"
works out.ply --size 5 --outline flat.svg --picture picture.png box.off out.ply -- '-5'
grep -q '<svg' flat.svg 2>/dev/null || fail "no outline"
[ "$(head -c 8 picture.png 2>/dev/null | od -An -tx1 | tr -d ' \n')" = 89504e470d0a1a0a ] || fail "no picture"

# A report for a pipe, and an output that is a link: what it names is written.
rm -f out.stl
"$label" --report /dev/stdout --size 5 box.off out.stl A43 2>said | grep -q '^{.*"text":"A43".*}$' ||
	fail "no report on standard output: $(cat said)"
echo before >reports
"$label" --report report.json --report /dev/stdout --size 5 box.off out.stl A43 >>reports && [ "$(grep -c . reports)" = 2 ] && grep -qx before reports ||
	fail "a report at the end of a file: $(cat reports)"
mkdir -p files && ln -s files/real.stl link.stl
"$label" --size 5 box.off link.stl A43 && [ -L link.stl ] && sound files/real.stl || fail "the link was replaced"
"$label" --size 5 --report link.stl box.off link.stl A43 2>said && fail "a report over the output, by a link"

# Polygons with more than three corners.
works out.stl --at 30,20,10 --size 8 --depth 0.5 quads.off out.stl A43 && sound out.stl

# Colours of the input are still there.
sed -e 's/^OFF/COFF/' -e '3,10s/$/ 10 20 30 255/' box.off >colored.off
works colored.ply --size 5 colored.off colored.ply 'A' && head -c 400 colored.ply | grep -qa 'property uchar red' || fail "vertex colours are lost"
colored_faces() { # FILE.ply: a colour is declared behind the faces
	sed '/^end_header/q' "$1" | tr -d '\0' | sed '1,/^element face/d' | grep -qa 'property uchar red'
}
for color in '10 20 30' '10 20 30 255' '0.1 0.2 0.3 1.0'; do
	sed "11,\$s/\$/ $color/" box.off >faces.off
	works colored.ply --size 5 faces.off colored.ply 'A' && colored_faces colored.ply || fail "face colours '$color' are lost"
done
sed -e 's/^OFF/# a comment\n\nCOFF/' -e '3,10s/$/ 10 20 30 255/' -e 's/$/\r/' box.off >colored.off
works colored.ply --size 5 colored.off colored.ply 'A' && head -c 400 colored.ply | grep -qa 'property uchar red' ||
	fail "vertex colours behind a comment are lost"
sed '11,$s/$/ 10 20 30 255/' box.off >faces.off
works colored.ply --size 5 --picture vertices.png colored.off colored.ply 'A'
works colored.ply --size 5 --picture faces.png faces.off colored.ply 'A'
works plain.ply --size 5 --picture plain.png box.off plain.ply 'A'
cmp -s vertices.png faces.png || fail "the picture shows vertex colours and face colours differently"
! cmp -s vertices.png plain.png || fail "the picture does not show the part's colours"
works plain.ply --size 5 box.off plain.ply 'A' && ! grep -qa 'property uchar red' plain.ply || fail "colours came from nowhere"
{
	printf 'ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n'
	printf 'property uchar blue\nproperty uchar green\nproperty uchar red\n'
	printf 'element face 12\nproperty list uchar int vertex_indices\nend_header\n'
	sed -n -e '3,10s/$/ 30 20 10/p' -e '11,$p' box.off
} | sed 's/$/\r/' >crlf.ply
works colored.ply --size 5 crlf.ply colored.ply 'A' && head -c 400 colored.ply | grep -qa 'property uchar red' ||
	fail "colours of a PLY file with CRLF are lost"

# The part that has colours keeps them: those of faces in an STL file; those of vertices become those of the faces beside the letters.
works red.stl --style flat --color ff0000 --size 5 box.off red.stl A && works twice.stl --size 5 red.stl twice.stl B &&
	head -c 80 twice.stl | grep -qa 'COLOR=' || fail "colours of an STL file are lost"
works flat.obj --style flat --color 0000ff --size 5 crlf.ply flat.obj A
grep -q '^Kd 0.03[0-9]* 0.07[0-9]* 0.11[0-9]*' flat.obj.mtl || fail "beside a flat label the colours of the vertices are lost"
! grep -q '^Tr' flat.obj.mtl || fail "materials say that they are transparent, or are not"

# A texture comes along to another folder, and replaces no other.
mkdir -p skinned/pictures skinless
cp picture.png skinned/pictures/skin.png
{
	printf 'ply\nformat ascii 1.0\ncomment TextureFile pictures/skin.png\n'
	printf 'element vertex 8\nproperty float x\nproperty float y\nproperty float z\n'
	printf 'element face 12\nproperty list uchar int vertex_indices\nproperty list uchar float texcoord\nend_header\n'
	sed -n -e '3,10p' -e '11,$s/$/ 6 0 0 1 0 0 1/p' box.off
} >skinned/box.ply
for ending in ply obj; do
	rm -rf skinless/pictures
	works skinless/out.$ending --size 5 skinned/box.ply skinless/out.$ending A
	cmp -s picture.png skinless/pictures/skin.png || fail "the texture of a .$ending file did not come along"
	cp box.off skinless/pictures/skin.png
	"$label" --size 5 skinned/box.ply skinless/other.$ending A >said 2>&1 && fail "a texture was replaced"
	grep -q 'would replace another' said && [ ! -e skinless/other.$ending ] && cmp -s box.off skinless/pictures/skin.png ||
		fail "a texture of the same name: $(cat said)"
done
works skinless/out.stl --size 5 skinned/box.ply skinless/out.stl A  # has no textures
inode=$(stat -c %i skinned/pictures/skin.png)
works skinned/out.ply --size 5 skinned/box.ply skinned/out.ply A && [ "$(stat -c %i skinned/pictures/skin.png)" = "$inode" ] ||
	fail "the part's own texture was written anew"
sed 's|pictures/skin|../pictures/skin|' skinned/box.ply >skinned/up.ply
mkdir -p pictures && cp picture.png pictures/skin.png
works skinless/up.ply --size 5 skinned/up.ply skinless/up.ply A || fail "a texture beside both folders"
mkdir -p deeper/skinless
"$label" --size 5 skinned/up.ply deeper/skinless/up.ply A >said 2>&1 && fail "a texture outside was left behind"
grep -q "outside the mesh's folder" said || fail "a texture outside: $(cat said)"

for order in '--color ff0000 --set tint=false' '--set tint=false --color ff0000'; do
	# shellcheck disable=SC2086  # several arguments
	"$label" $order --size 5 box.off grey.stl A >said 2>&1 && ! grep -q "colour is in" said || fail "a colour is told that is not there: $order"
done

# What --help says can be written, can.
for ending in ply off dae x3d wrl STL; do
	works "out.$ending" --size 5 box.off "out.$ending" A
	"$label" --help | grep -qE "\.${ending,,}\b" || fail "--help without .$ending"
done

# ---- what must be refused

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

refused 2 'INPUT, OUTPUT and TEXT' box.off out.stl
refused 2 "'43' is one more" box.off out.stl A 43
refused 2 "NAME=VALUE, not 'slant'" --set slant box.off out.stl A
refused 2 "one of Emboss, Engrave, Flat" --set style=raised box.off out.stl A
refused 2 'no option --sise' --sise 3 box.off out.stl A
refused 2 'needs a value' box.off out.stl A --size
refused 2 "'abc' of size" --size abc box.off out.stl A
refused 2 "'1,2' of position" --at 1,2 box.off out.stl A
refused 2 'goes with --at' --direction 0,0,1 box.off out.stl A
refused 2 'direction alone says no place' --set direction=0,0,1 box.off out.stl A
refused 2 'direction alone says no place' --set direction=0,0,1 --camera above.xml box.off out.stl A
refused 2 'two different places' --at 1,2,3 --camera above.xml box.off out.stl A
refused 2 "'bold' of style" --style bold box.off out.stl A
refused 2 "no parameter 'colour'" --set colour=red box.off out.stl A

refused 1 'cannot be read' no.off out.stl A
refused 1 'cannot read the mesh' nonsense.stl out.stl A
refused 1 'does not exist' box.off nowhere/out.stl A
refused 1 'cannot be (written|made)' box.off /proc/out.stl A
refused 1 'is a folder' box.off "$work" A
refused 1 'null' --report /dev/null box.off out.stl A
[ -c /dev/null ] || fail '/dev/null was replaced'
mkfifo pipe.stl && refused 1 'is a pipe' box.off pipe.stl A
[ -p pipe.stl ] || fail 'a pipe was replaced'
refused 1 'output is empty' box.off '' A
refused 1 'flat label is a colour.*\.ply' --style flat box.off out.dae A
refused 1 'picture would be written over' --picture box.off box.off out.stl A
refused 1 'report would be written over' --outline a.x --report a.x box.off out.stl A
awk 'NF == 3 && NR > 2 { $1 *= 1e-5; $2 *= 1e-5; $3 *= 1e-5 } { print }' box.off >tiny.off
refused 1 "spoilt in 'out.obj'.*six decimals.*\.stl" tiny.off out.obj A
awk 'NF == 3 && NR > 2 { $1 = 10 * $1 + 3e6; $2 *= 10; $3 *= 10 } { print }' box.off >far.off
refused 1 "spoilt in 'out.off'.*six digits" --size 120 --depth 30 far.off out.off A
for ending in xyzzy 3ds u3d; do
	refused 1 "format '$ending' cannot be written here.*\.stl, \.ply, .*\.wrl" box.off out.$ending A
done
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >some.obj
refused 1 'every OBJ file.*\.ply.*python -m textlabel label' some.obj out.stl A

# A copy of the plugin alone.
if [ -n "${TEXTLABEL_PLUGIN:-}" ]; then built=$TEXTLABEL_PLUGIN; else built=$("$TEXTLABEL_SOURCE_DIR/filter_textlabel/build.sh"); fi
mkdir alone && cp "$built" alone/plugin.so
for arguments in 'box.off out.stl A' --parameters; do
	# shellcheck disable=SC2086  # several arguments
	TEXTLABEL_PLUGIN=alone/plugin.so refused 1 "'/.*/alone/textlabel_script' is missing.*unset TEXTLABEL_PLUGIN" $arguments
done

# A full temporary folder: no part of a mesh.
mkdir small
if mount -t tmpfs -o size=600k tmpfs small 2>mounted; then
	for ending in stl ply; do
		TMPDIR=$work/small refused 1 "whole mesh to '$work/small'.*TMPDIR" --size 14 "$TEXTLABEL_SOURCE_DIR/meshes/bracket.stl" out.$ending A43
	done
	umount -l small  # lazily: the display may be ending still
else
	echo "not checked: a full temporary folder, as none can be mounted ($(cat mounted))"
fi

# A signal ends meshlabserver too, also one that hangs, and leaves nothing in the temporary folder.
mkdir signalled
awk 'BEGIN {  # a large one, so that meshlabserver is seen at work
	n = 400; print "OFF"; print n * n, 2 * (n - 1) * (n - 1), 0
	for (i = 0; i < n; i++) for (j = 0; j < n; j++) print i, j, 0
	for (i = 0; i < n - 1; i++) for (j = 0; j < n - 1; j++) { a = i * n + j; print 3, a, a + n, a + 1; print 3, a + n, a + n + 1, a + 1 }
}' >large.off
meshlab_of() { # FOLDER: the process that runs from a tree in it
	find /proc -maxdepth 2 -path '/proc/[0-9]*/exe' -lname "$1/*/meshlabserver" 2>/dev/null | cut -d/ -f3
}
for signal in TERM HUP INT; do
	TMPDIR=$work/signalled env --default-signal=$signal "$label" --size 5 large.off out.stl A >said 2>&1 &
	running=$!
	meshlab=
	while [ -z "$meshlab" ] && kill -0 $running 2>/dev/null; do meshlab=$(meshlab_of "$work/signalled"); done
	[ -n "$meshlab" ] && kill -STOP "$meshlab" || { fail "no meshlabserver seen"; continue; }
	kill -$signal $running
	for _ in $(seq 100); do kill -0 $running || break; sleep 0.1; done 2>/dev/null  # here the shell also says how it ended
	if kill -0 "$meshlab" 2>/dev/null; then
		fail "meshlabserver outlives label.sh after SIG$signal"
		kill -KILL "$meshlab"
	fi
	{ wait $running; } 2>/dev/null && fail "exit 0 after SIG$signal"
	[ -z "$(ls -A signalled)" ] || fail "left after SIG$signal: $(ls signalled)"
done

at=(--at 30,20,10 --size 8 --depth 0.5)
refused 1 '[Tt]ext' "${at[@]}" box.off out.stl ''
refused 1 '[Tt]ext' "${at[@]}" box.off out.stl '   '
refused 1 'U\+0B95.*U\+10CCC' "${at[@]}" box.off out.stl 'A க 𐳌'
refused 1 'nosuchfont' "${at[@]}" --font 'nosuchfont' box.off out.stl A
refused 1 'nonsense.ttf' "${at[@]}" --font nonsense.ttf box.off out.stl A
for value in 0 -2 nan inf; do
	refused 1 "size is (0|-2|nan|inf)\." --at 30,20,10 --size $value box.off out.stl A
	refused 1 "depth is (0|-2|nan|inf)\." --at 30,20,10 --depth $value box.off out.stl A
done
refused 1 'size is 500, larger than the part.*72\.8' --at 30,20,10 --size 500 box.off out.stl A
refused 1 'depth is 500, larger than the part.*72\.8' --at 30,20,10 --depth 500 box.off out.stl A
refused 1 'No face looks to the viewer' --at 300,20,10 box.off out.stl A
refused 1 "letter 'M' .*(horizon|beside the surface|border) .*\((60|6[0-9.]+|5[0-9.]+), [0-9.]+, 10\)" --at 50,20,10 --size 8 box.off out.stl WIM
refused 1 "border or a hole.*near \(.*, 10\)" --at 30,10,10 --size 12 hole.off out.stl A43
refused 1 'not manifold.*near \(.*, 10\)' "${at[@]}" fin.off out.stl A43
refused 1 'direction is zero' --at 30,20,10 --direction 0,0,0 box.off out.stl A
refused 1 'up points along the line of sight' --at 30,20,10 --direction 0,0,2 --up 0,0,-1 box.off out.stl A
refused 1 'no (faces|mesh)|cannot read' empty.off out.stl A
refused 1 'no faces' cloud.ply out.stl A
refused 1 'there is room for (9\.[0-9]+|10)[^0-9]' --at 30,20,10 --size 8 --style engrave --depth 12 box.off out.stl A
refused 1 'another part of the surface|fold' --at 15,40,32.5 --size 8 --depth 60 --along surface groove.off out.stl A

camera inside.xml 30 20 5
camera beside.xml 300 20 110
camera below.xml 30 20 -50
sed 's/<project>//' above.xml >broken.xml
sed 's/ RotationMatrix="[^"]*"//' above.xml >incomplete.xml
sed 's/RotationMatrix="1 0/RotationMatrix="3 0/' above.xml >scaled.xml
printf '<a/>' >other.xml
printf '\xff\xfe\x00<' >bytes.xml
refused 1 'inside' --camera inside.xml box.off out.stl A
refused 1 'meets no part' --camera beside.xml box.off out.stl A
refused 1 'meets no part' --camera below.xml box.off out.stl A
refused 1 'as text|not XML' --camera bytes.xml box.off out.stl A
refused 1 'VCGCamera|not XML' --camera other.xml box.off out.stl A
refused 1 'RotationMatrix is missing' --camera incomplete.xml box.off out.stl A
refused 1 'not a rotation' --camera scaled.xml box.off out.stl A
: >blank.xml
refused 2 'VCGCamera' --camera blank.xml box.off out.stl A
refused 1 'Current view needs' --set placement=current box.off out.stl A
refused 1 'not be written|cannot be written' "${at[@]}" --report nowhere/report.json box.off out.stl A

# ---- the same font in every locale, also where any will do

"$label" "${at[@]}" --font sans-serif box.off plain.stl A || fail "sans-serif"
for language in ja fa; do
	FC_LANG=$language "$label" "${at[@]}" --font sans-serif box.off local.stl A && cmp plain.stl local.stl ||
		fail "another label where the language is $language"
done

[ $failures -eq 0 ] && echo "all as it should be"
exit $((failures > 0))
