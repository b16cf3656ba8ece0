#!/usr/bin/env bash
# label.sh through the real meshlabserver: labels are measured, and what belongs to a file comes out as it went in.
. "$TEXTLABEL_SOURCE_DIR/tests/label_sh_support.sh"

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

# A drawing in place of the text, which is left out or empty. Of two the last one counts, whichever option it came by.
for how in '--drawing logo.svg' '--set drawing=./logo.svg' '--drawing none.svg --set drawing=logo.svg' '--set drawing=none.svg --drawing logo.svg'; do
	# shellcheck disable=SC2086  # several arguments
	if works out.stl --style engrave "${at[@]}" $how box.off out.stl; then
		sound out.stl
		about "$(number label_area)" 96 1e-6 || fail "$how: $(number label_area) of ink instead of 1.5 * 8^2"
		about "$(sed -n 's/^volume=//p' judged)" $((24000 - 96 / 2)) 0.05 || fail "$how: volume $(sed -n 's/^volume=//p' judged) by admesh"
	fi
done
works out.stl "${at[@]}" --drawing logo.svg --outline logo-flat.svg box.off out.stl '' && [ -s logo-flat.svg ] || fail "a drawing and an empty text"
works out.stl "${at[@]}" box.off out.stl A43 && cp out.stl first.stl && works out.stl "${at[@]}" --drawing logo.svg --drawing '' box.off out.stl A43 &&
	cmp -s first.stl out.stl || fail "an empty drawing is none"

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

# Polygons with more than three corners.
works out.stl --at 30,20,10 --size 8 --depth 0.5 quads.off out.stl A43 && sound out.stl

# Round a part: a drum of 48 sides, from the side; the axis is found, or given.
awk 'BEGIN { n = 48; print "OFF"; print 2 * n + 2, 4 * n, 0
	for (i = 0; i < 2 * n; i++) { a = 6.283185307179586 * (i % n) / n; print 10 * cos(a), 10 * sin(a), i < n ? 0 : 20 }
	print 0, 0, 0; print 0, 0, 20
	for (i = 0; i < n; i++) { j = (i + 1) % n
		print 3, i, j, n + j; print 3, i, n + j, n + i; print 3, 2 * n, j, i; print 3, 2 * n + 1, n + i, n + j } }' >drum.off
around='ROUND AND ROUND AND ROUND'
for how in --wrap '--set wrap=true' '--set wrap_radius=10'; do
	# shellcheck disable=SC2086  # several arguments
	works out.stl --at 10,0,10 --direction 1,0,0 --size 2 --depth 0.4 $how drum.off out.stl "$around" && sound out.stl &&
		grep -qE '"wrap_radius":(10[,}]|10\.000|9\.999)' report.json || fail "$how: not round the drum"
done

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

# ---- the same font in every locale, also where any will do

"$label" "${at[@]}" --font sans-serif box.off plain.stl A || fail "sans-serif"
for language in ja fa; do
	FC_LANG=$language "$label" "${at[@]}" --font sans-serif box.off local.stl A && cmp plain.stl local.stl ||
		fail "another label where the language is $language"
done

conclude
