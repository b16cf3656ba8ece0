#!/usr/bin/env bash
# Cut a text into a mesh file, by MeshLab 2020.09's meshlabserver and the Text Label filter. Needs no window and no root.

set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
# shellcheck source=filter_textlabel/meshlab_tree.sh
. "$here/meshlab_tree.sh"

usage() {
	cat <<'END'
usage: label.sh [options] [--] INPUT OUTPUT TEXT
       label.sh [options] --drawing FILE.svg [--] INPUT OUTPUT
       label.sh --parameters    list the filter's parameters, for --set

INPUT           a mesh file: STL, PLY, OFF and what else MeshLab reads, but no OBJ, at which Debian's meshlabserver aborts
OUTPUT          a mesh file: .stl, .ply, .obj, .off, .dae, .x3d or .wrl
TEXT            the text; \n breaks a line

Where, by default the largest flat region that holds the text:
  --at X,Y,Z            at this point of the surface, seen in parallel from the direction
  --direction X,Y,Z     with --at: from the surface towards the viewer (default 0,0,1)
  --up X,Y,Z            where the top of the letters points (default: chosen)
  --camera FILE         in the centre of this view: what MeshLab's "Copy camera settings to clipboard" gives
  --offset U,V          shift to the right and upwards, mesh units
  --rotate DEG          turn counter-clockwise
  --wrap                with --at or --camera: round the part, as on a bottle or a ring
How:
  --style emboss|engrave|flat
  --size H              height of a capital letter, mesh units (default: chosen to fit)
  --depth D             mesh units (default: chosen from the size)
  --along viewpoint|label|surface
  --font F              family ("DejaVu Sans:Bold"), font file, or either with axes ("Inter:wght=650")
  --code KIND           a code instead of letters, --size is its height: "data matrix", "gs1 data matrix", "qr code",
                        "micro qr code", "aztec code" or "code 128"
  --drawing FILE.svg    a drawing instead of text, as a logo; --size is its height; TEXT is left out
  --tolerance T         largest distance between the font's curves and what is cut, mesh units
  --color RRGGBB        of the letters' faces, raised and sunk ones too
  --set NAME=VALUE      any parameter; position or camera say where, as above
What else to write:
  --report FILE.json    the report of the run
  --picture FILE.png    a picture of the result
  --outline FILE.svg    the flat label

exit: 0 labelled; 1 refused, with the reason on stderr and no OUTPUT; 2 wrong usage
END
}

wrong() {
	echo "label.sh: $1 (label.sh --help shows the usage)" >&2
	exit 2
}

refuse() {
	echo "label.sh: $1" >&2
	exit 1
}

# ---- the command line

parameters=()
files=()
at=
direction=
camera=

# A path that stays right when MeshLab changes its folder.
absolute() { realpath -ms -- "$1"; }

# The same of a font, which may be a family; behind a file's name a face or axes may stand: font.ttc#1, font.ttf:wght=650.
absolute_font() {
	local file=$1
	while [ ! -f "$file" ] && [[ $file == *[:#]* ]]; do file=${file%[:#]*}; done
	if [ -f "$file" ]; then printf '%s%s' "$(absolute "$file")" "${1#"$file"}"; else printf '%s' "$1"; fi
}

# find_plugin: plugin is the filter's library, script_program the program beside it that knows the parameters.
find_plugin() {
	plugin=$("$here/build.sh") || refuse "The plugin could not be built (see above)."
	script_program=$(dirname -- "$plugin")/textlabel_script
	[ -x "$script_program" ] ||
		refuse "'$script_program' is missing, which build.sh makes beside the plugin. Copy it too, or unset TEXTLABEL_PLUGIN."
}

while [ $# -gt 0 ]; do
	option=$1
	shift
	case $option in
	--help | -h) usage; exit 0 ;;
	--parameters)
		find_plugin
		exec "$script_program" --parameters
		;;
	--) files+=("$@"); break ;;
	--at | --direction | --up | --camera | --offset | --rotate | --style | --size | --depth | --along | --font | --tolerance | \
		--code | --drawing | --color | --set | --report | --picture | --outline)
		[ $# -gt 0 ] || wrong "$option needs a value"
		value=$1
		shift
		;;
	--wrap) parameters+=("wrap=true") ;;
	-?*) wrong "there is no option $option; write -- before a text that begins with a dash" ;;
	*) files+=("$option") ;;
	esac
	case $option in
	--at) at=$value ;;
	--direction) direction=$value ;;
	--up) parameters+=("up=$value") ;;
	--camera) camera=$value ;;
	--offset)
		[[ $value == *,* ]] || wrong "--offset needs two numbers, as in --offset 1.5,0"
		parameters+=("offset_u=${value%%,*}" "offset_v=${value#*,}")
		;;
	--rotate) parameters+=("rotation=$value") ;;
	--along) parameters+=("extrude_along=$value") ;;
	--size | --depth | --tolerance | --font | --code | --drawing | --color | --style | --report | --picture | --outline)
		parameters+=("${option#--}=$value")
		;;
	--set)
		[[ $value == *=* ]] || wrong "--set needs NAME=VALUE, not '$value'"
		parameters+=("$value")
		;;
	esac
done
drawing=
for parameter in "${parameters[@]}"; do  # of several the last one counts, whichever option it came by
	[[ $parameter != drawing=* ]] || drawing=${parameter#*=}
done
if [ -n "$drawing" ] && [ ${#files[@]} -eq 2 ]; then files+=(""); fi
if [ ${#files[@]} -lt 3 ]; then
	wrong "INPUT, OUTPUT and TEXT, or --drawing instead of it, are needed; ${#files[@]} of the three are there"
elif [ ${#files[@]} -gt 3 ]; then
	wrong "INPUT, OUTPUT and TEXT are all that is needed, and '${files[3]}' is one more; write a text with blanks in quotes"
elif [ -n "$drawing" ] && [ -n "${files[2]}" ]; then
	wrong "a drawing is cut instead of TEXT, and both '$drawing' and '${files[2]}' are there; leave one of them out"
fi
input=${files[0]} output=${files[1]}
if [ -e "$output" ] && [ ! -f "$output" ] && [ ! -d "$output" ]; then
	refuse "The output '$output' is a pipe or a device. Give a file name."
fi
if [ -L "$output" ]; then output=$(realpath -m -- "$output"); fi  # what a link names is written, and the link stays
if [ -n "$at" ]; then
	parameters+=("position=$at" ${direction:+"direction=$direction"})
elif [ -n "$direction" ]; then
	wrong "--direction goes with --at"
fi
if [ -n "$camera" ]; then
	[ -z "$at" ] || wrong "--camera and --at say two different places"
	view=$(iconv -f UTF-8 -t UTF-8 -- "$camera" 2>/dev/null | tr -d '\0') ||
		refuse "The camera file '$camera' cannot be read as text. Give what MeshLab copied, as a file."
	parameters+=("camera=$view")
fi
parameters+=("text=${files[2]}")

# What the parameters mean for files, whichever option they came by.
declare -A streams=()  # parameter: the stream that gets a copy in the end, as the filter puts files in their places
declare -A ending_of=([report]=json [picture]=png [outline]=svg)
written=()
# refuse_over WHAT FILE: when that is read as well, or written already.
refuse_over() {
	local other
	for other in "${written[@]}"; do
		[ "$(realpath -m -- "$2")" != "$(realpath -m -- "$other")" ] ||
			refuse "The $1 would be written over '$other'. Give it a name of its own."
	done
}
if [ -n "$drawing" ]; then
	written+=("$(absolute "$drawing")")
	[ -z "$output" ] || refuse_over output "$output"
fi
written+=(${input:+"$(absolute "$input")"} ${output:+"$(absolute "$output")"})
for i in "${!parameters[@]}"; do
	name=${parameters[i]%%=*} value=${parameters[i]#*=}
	case $name in
	report | picture | outline)
		case $value in
		/dev/stdout) streams[$name]=1 && continue ;;
		/dev/stderr) streams[$name]=2 && continue ;;
		/dev/fd/[0-9] | /dev/fd/[0-9][0-9]) streams[$name]=${value##*/} && continue ;;
		esac
		unset "streams[$name]"  # of two the last one counts
		[ -n "$value" ] || continue
		value=$(absolute "$value")
		refuse_over "$name" "$value"
		written+=("$value")
		parameters[i]=$name=$value
		;;
	font) parameters[i]=$name=$(absolute_font "$value") ;;
	drawing) parameters[i]=$name=${value:+"$(absolute "$value")"} ;;
	esac
done

# ---- what can be refused before MeshLab starts

[ -f "$input" ] && [ -r "$input" ] || refuse "The mesh '$input' cannot be read. Check its name."
if [[ ${input,,} == *.obj ]]; then
	refuse "Debian's meshlabserver aborts at every OBJ file, so '$input' cannot be read here. Save it as .ply, or use python -m textlabel label (see README.md)."
fi
[ -n "$output" ] || refuse "The name of the output is empty. Give a file name."
[ ! -d "$output" ] || refuse "The output '$output' is a folder. Give a file name."
folder=$(dirname -- "$output")
[ -d "$folder" ] || refuse "The folder of '$output' does not exist. Make it first, or choose another one."
[ -w "$folder" ] || refuse "The folder of '$output' cannot be written to. Choose another one."
ending=${output##*.}
[[ $ending =~ ^[A-Za-z0-9]+$ && $(basename -- "$output") == *.* ]] || refuse "The output '$output' has no ending that says its format. Name it .stl, .ply, .obj or .off."
case ${ending,,} in
stl | ply | obj | off | x3d | dae | wrl) ;;
*)  # of some, as .3ds and .u3d, meshlabserver asks how in a window that nobody sees, and waits for ever; .ctm moves vertices
	refuse "The format '$ending' cannot be written here. Name the output .stl, .ply, .obj, .off, .dae, .x3d or .wrl."
	;;
esac

case ${ending,,} in  # text formats, of which MeshLab 2020.09 writes fewer digits than single precision has
obj) parameters=("file_digits=-6" "${parameters[@]}") ;;
off) parameters=("file_digits=7" "${parameters[@]}") ;;
dae | x3d | wrl) parameters=("file_digits=6" "${parameters[@]}") ;;
esac

work=$(mktemp -d) || refuse "No temporary folder can be made in '${TMPDIR:-/tmp}'. Make room there, or name another folder in TMPDIR."
meshlab_pid=
display_pid=
fresh=
clean_up() {
	# Killed, as it has nothing to save, and waited for, as it must not write any more into what is removed.
	if [ -n "$meshlab_pid" ]; then { kill -KILL "$meshlab_pid" && wait "$meshlab_pid"; } 2>/dev/null || true; fi
	if [ -n "$display_pid" ]; then kill "$display_pid" 2>/dev/null || true; fi
	rm -rf -- "$work" ${fresh:+"$fresh" "$fresh.mtl"}
}
trap clean_up EXIT

# meshlabserver does not always see that a write failed: what is in a folder that is full afterwards may be a part only.
check_room() { # SIZE
	if ! head -c "$1" /dev/zero 2>/dev/null >"$work/room" || grep -qsa "has NOT been saved" "$work/log"; then
		refuse "MeshLab cannot write the whole mesh to '$(dirname -- "$work")'. Make room there, or name another folder in TMPDIR."
	fi
	rm -- "$work/room"
}

for name in "${!streams[@]}"; do parameters+=("$name=$work/$name.${ending_of[$name]}"); done
find_plugin
check_room 512K  # a copy of meshlabserver comes first
"$script_program" "${parameters[@]}" >"$work/label.mlx" || wrong "a value cannot be used"

# NAME VALUE: whether the label has it, given or not.
has_value() { grep -q "<Param name=\"$1\" [^>]*value=\"$2\"" "$work/label.mlx"; }
flat=2  # of the styles
colors=
if has_value style $flat || has_value tint true; then colors='fc'; fi
if has_value style $flat && [[ ${ending,,} =~ ^(dae|wrl)$ ]]; then  # meshlabserver leaves the colours of faces away
	refuse "A flat label is a colour, which a .${ending,,} file would not hold. Name the output .ply or .obj."
fi

# ---- run MeshLab

# What the input carries beside its shape, so that the output keeps it: meshlabserver saves only what it is told to.
attributes() {
	local head
	case ${input,,} in
	*.ply)
		head=$(head -c 65536 -- "$input" | LC_ALL=C sed -n '/^end_header/q; p' | tr -d '\0\r')
		awk '$1 == "element" { in_element = substr($2, 1, 1) }
			$1 == "property" {
				name = $NF
				if (name == "red") print in_element "c"
				if (name == "quality") print in_element "q"
				if (name == "radius") print in_element "r"
				if (name == "texture_u" || name == "s") print in_element "t"
				if (name == "texcoord") print "wt"
			}' <<<"$head" | grep -xE 'vc|vq|vr|vt|wt|fc|fq' || true
		;;
	*.stl) if head -c 80 -- "$input" | grep -qa 'COLOR='; then echo fc; fi ;;
	*.off)
		LC_ALL=C awk '{ gsub(/#.*|\r/, "") }
			NF == 0 { next }
			!header { header = $1; if (header ~ /C.*OFF/) print "vc"; if (NF == 1) next; $1 = ""; $0 = $0 }
			!counted { counted = 1; vertices = $1; next }
			vertices > 0 { vertices--; next }
			NF == $1 + 4 || NF == $1 + 5 { print "fc"; exit }' "$(absolute "$input")"
		;;
	esac
}
mapfile -t carried < <({ attributes || true; echo "$colors"; } | sort -u | sed '/^$/d')

make_meshlab_tree "$work/tree" meshlabserver "$plugin" 'libio_*.so'
start_display "$work" 64x64x24 || refuse "MeshLab needs a virtual display. Install Xvfb (Debian: xvfb)."
status=0
# The plain name of the output is for MeshLab; the true one may hold anything.
{
	LC_ALL=C.UTF-8 XDG_RUNTIME_DIR="$work" "$work/tree/bin/meshlabserver" -i "$(absolute "$input")" -s "$work/label.mlx" \
		-o "$work/labelled.$ending" ${carried[@]:+-m "${carried[@]}"} >"$work/log" 2>"$work/errors" &
	meshlab_pid=$!
	wait "$meshlab_pid" || status=$?  # in the background, as a signal would otherwise be heard only after its end
	meshlab_pid=
} 2>/dev/null  # what the shell says about a program that aborts
# The filter's lines and the log's, from their beginning: the report holds the text, which may say anything.
reason=$(sed -n 's/^\(LOG: [0-9]* \)\{0,1\}Text Label: \([^{]\)/\2/p' "$work/errors" | head -n 1)
[ -z "$reason" ] || refuse "$reason"
check_room 64K
if [ ! -s "$work/labelled.$ending" ] || [ $status -ne 0 ]; then
	cat "$work/log" "$work/errors" >&2
	if ! grep -qa "^Mesh .* loaded has" "$work/log"; then refuse "MeshLab cannot read the mesh '$input'. Check that it is what its ending says."; fi
	refuse "MeshLab ended unexpectedly (status $status, see above). Check the mesh by opening it in MeshLab; for a very large one, that there is memory enough."
fi

# Textures that the output names must lie beside it, as they do beside the input.
texture_names() {
	case ${ending,,} in
	ply) head -c 65536 -- "$work/labelled.$ending" | LC_ALL=C sed -n '/^end_header/q; s/^comment TextureFile //p' ;;
	obj) sed -n 's/^map_Kd //p' "$work/labelled.$ending.mtl" 2>/dev/null ;;
	esac | tr -d '\0\r' | sort -u
}
source_folder=$(dirname -- "$input")
textures=()
if ! [ "$folder" -ef "$source_folder" ]; then
	while IFS= read -r texture; do
		[ -f "$source_folder/$texture" ] || continue  # it is as missing there
		if cmp -s -- "$source_folder/$texture" "$folder/$texture"; then continue; fi
		[[ /$texture/ != //* && /$texture/ != */../* ]] ||
			refuse "The texture '$texture' of '$input' is outside the mesh's folder. Put it beside the mesh, and so in the file that names it."
		[ ! -e "$folder/$texture" ] || refuse "The texture '$texture' of '$input' would replace another one, '$folder/$texture'. Choose another folder."
		textures+=("$texture")
	done < <(texture_names)
fi

# ---- the output appears as a whole or not at all

for name in "${!streams[@]}"; do
	cat -- "$work/$name.${ending_of[$name]}" >&"${streams[$name]}" || refuse "The $name could not be written to where it should go."
done
fresh=$(mktemp -- "$folder/.textlabel-XXXXXX") || refuse "The folder of '$output' cannot be written to. Choose another one."
chmod --reference="$work/label.mlx" -- "$fresh"
materials=$work/labelled.$ending.mtl
if [ -f "$materials" ]; then
	name=$(basename -- "$output").mtl
	NAME=$name awk '/^mtllib / { $0 = "mtllib ./" ENVIRON["NAME"] } { print }' "$work/labelled.$ending" >"$work/renamed"
	mv -- "$work/renamed" "$work/labelled.$ending"
	sed -i '/^Tr 1\.0*$/d' "$materials"  # 1 for opaque, as it once was; today's readers would show nothing
	cp -- "$materials" "$fresh.mtl" && mv -f -- "$fresh.mtl" "$output.mtl" || refuse "'$output.mtl' could not be written. Is the disk full?"
fi
for texture in "${textures[@]}"; do
	mkdir -p -- "$(dirname -- "$folder/$texture")" && cp -- "$source_folder/$texture" "$fresh" && mv -f -- "$fresh" "$folder/$texture" ||
		refuse "'$folder/$texture' could not be written. Is the disk full?"
done
cp -- "$work/labelled.$ending" "$fresh" && mv -f -- "$fresh" "$output" || refuse "'$output' could not be written. Is the disk full?"
if [ -n "$colors" ] && [ "${ending,,}" = stl ]; then
	echo "label.sh: the letters' colour is in '$output', but few programs read colours from an STL file. Name it .ply or .obj instead." >&2
fi
