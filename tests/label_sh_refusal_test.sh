#!/usr/bin/env bash
# label.sh through the real meshlabserver: refusals say why, and leave everything as it was.
. "$TEXTLABEL_SOURCE_DIR/tests/label_sh_support.sh"

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

# A drawing is cut instead of the text, and nothing is written over it.
refused 2 'INPUT, OUTPUT and TEXT, or --drawing.* 2 of the three' --drawing '' box.off out.stl
refused 2 '2 of the three' --drawing logo.svg --set drawing= box.off out.stl
refused 2 '1 of the three' --drawing logo.svg box.off
refused 2 "instead of TEXT, and both 'logo.svg' and 'A'" --drawing logo.svg box.off out.stl A
refused 2 "both 'logo.svg' and 'A'" --set drawing=logo.svg box.off out.stl A
refused 2 "'43' is one more" --drawing logo.svg box.off out.stl A 43
refused 1 'no\.svg.*no such file' --drawing no.svg box.off out.stl
refused 1 'code' --drawing logo.svg --code 'qr code' box.off out.stl
ln -s logo.svg drawn.svg
refused 1 "outline would be written over '.*/drawn.svg'" --set drawing=drawn.svg --outline logo.svg box.off out.stl
cp logo.svg logo.stl
refused 1 "output would be written over '.*/logo.stl'" --drawing ./logo.stl box.off logo.stl

refused 1 'wrapped needs a place' --wrap box.off out.stl A
refused 1 'no axis that can be measured' --wrap --at 30,20,10 box.off out.stl A
refused 1 'cannot be read' no.off out.stl A
refused 1 'cannot read the mesh' nonsense.stl out.stl A
refused 1 'does not exist' box.off nowhere/out.stl A
refused 1 'cannot be (written|made)' box.off /proc/out.stl A
refused 1 'is a folder' box.off "$work" A
refused 1 'null' --report /dev/null box.off out.stl A
[ -c /dev/null ] || fail '/dev/null was replaced'
ln -s linked.stl link.stl
refused 1 'report would be written over' --report link.stl box.off link.stl A
mkfifo pipe.stl && refused 1 'is a pipe' box.off pipe.stl A
[ -p pipe.stl ] || fail 'a pipe was replaced'
refused 1 'output is empty' box.off '' A
refused 1 'flat label is a colour.*\.ply' --style flat box.off out.dae A
refused 1 'picture would be written over' --picture box.off box.off out.stl A
refused 1 'report would be written over' --outline a.x --report a.x box.off out.stl A
awk 'NF == 3 && NR > 2 { $1 *= 1e-5; $2 *= 1e-5; $3 *= 1e-5 } { print }' box.off >tiny.off
refused 1 'finer than the coordinates .*more digits, as \.ply or \.stl' tiny.off out.obj A
awk 'NF == 3 && NR > 2 { $1 = 10 * $1 + 3e6; $2 *= 10; $3 *= 10 } { print }' box.off >far.off
refused 1 'finer than .*more digits, as \.ply or \.stl' --depth 0.5 far.off out.off A
awk 'NF == 3 && NR > 2 { $1 = $1 / 10 + 1005; $2 = $2 / 10 + 1005; $3 = $3 / 10 + 1005 } { print }' box.off >beside.off
refused 1 'finer than .*more digits' --depth 0.004 beside.off out.wrl A  # steps of 0.01
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
	for _ in $(seq 600); do kill -0 $running || break; sleep 0.1; done 2>/dev/null  # here the shell also says how it ended
	if kill -0 "$meshlab" 2>/dev/null; then
		fail "meshlabserver outlives label.sh after SIG$signal"
		kill -KILL "$meshlab"
	fi
	{ wait $running; } 2>/dev/null && fail "exit 0 after SIG$signal"
	[ -z "$(ls -A signalled)" ] || fail "left after SIG$signal: $(ls signalled)"
done

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

conclude
