#!/usr/bin/env bash
# Build the plugin for a MeshLab, with all it needs (setup.sh), and print the plugin's path. Quick when it is up to date.
#
# usage: build.sh [meshlab-2020 | meshlab-2022 | meshlab-2025 | pymeshlab] [ARGUMENT OF CMAKE...]
#
#   meshlab-2020   Debian 12's MeshLab and meshlabserver (the default)
#   meshlab-2022   MeshLab 2022.02
#   meshlab-2025   MeshLab 2025.07, single precision (the usual download)
#   pymeshlab      PyMeshLab 2025.7 from PyPI (double precision)
#
# With TEXTLABEL_PLUGIN set, that plugin is taken as it is and nothing is built. TEXTLABEL_BUILD is the folder of the build
# trees, if not build/.

set -euo pipefail
top=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
setup=$top/filter_textlabel/setup.sh
. "$top/filter_textlabel/cmake/configure_tree.sh"

if [ -n "${TEXTLABEL_PLUGIN:-}" ]; then
	[ -f "$TEXTLABEL_PLUGIN" ] || {
		echo "textlabel: TEXTLABEL_PLUGIN names no file: '$TEXTLABEL_PLUGIN'. Correct it, or unset it to have the plugin built." >&2
		exit 1
	}
	realpath -ms -- "$TEXTLABEL_PLUGIN"
	exit
fi

host=${1:-meshlab-2020}
shift || true
build=$(realpath -ms -- "${TEXTLABEL_BUILD:-$top/build}")/$host
arguments=(-DCMAKE_BUILD_TYPE=Release -DTEXTLABEL_TESTS=OFF "$@")
case $host in
meshlab-2020)
	"$setup" build run meshlab-2020
	arguments+=(-DMESHLAB_SOURCE="$("$setup" --where meshlab-2020)")
	;;
meshlab-2022 | meshlab-2025)
	"$setup" build "$host"
	arguments+=(-DMESHLAB_SOURCE="$("$setup" --where "$host")")
	;;
pymeshlab)
	"$setup" build meshlab-2025 python
	arguments+=(-DMESHLAB_SOURCE="$("$setup" --where meshlab-2025)" -DMESHLAB_SCALAR=double
		-DMESHLAB_LIBRARY="$(echo "$("$setup" --where python)"/lib/python3*/site-packages/pymeshlab/lib/libmeshlab-common.so)")
	;;
*)
	echo "textlabel: build.sh knows meshlab-2020, meshlab-2022, meshlab-2025 and pymeshlab, not '$host'" >&2
	exit 2
	;;
esac

if ! { mkdir -p "$build" && [ -w "$build" ] && { [ ! -e "$build/.lock" ] || [ -w "$build/.lock" ]; }; } 2>/dev/null; then
	echo "textlabel: '$build' cannot be written to. Name a folder of your own in TEXTLABEL_BUILD." >&2
	exit 1
fi
exec 9>"$build/.lock"  # one at a time in this tree
flock 9
[ -f "$build/.configured" ] || echo "textlabel: building the plugin for $host" >&2
{ configure_tree "$build" "${arguments[@]}" && cmake --build "$build" --target filter_textlabel; } >"$build/log" 2>&1 9>&- || {
	cat "$build/log" >&2
	echo "textlabel: the plugin for $host could not be built: the reason stands above, and in $build/log" >&2
	exit 1
}
echo "$build/filter_textlabel/libfilter_textlabel.so"
