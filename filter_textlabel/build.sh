#!/usr/bin/env bash
# Build the plugin for a MeshLab, with all it needs (setup.sh), and print the plugin's path. Quick when it is up to date.
#
# usage: build.sh [meshlab-2020 | meshlab-2022 | meshlab-2025 | pymeshlab]
#
#   meshlab-2020   Debian 12's MeshLab and meshlabserver (the default)
#   meshlab-2022   MeshLab 2022.02
#   meshlab-2025   MeshLab 2025.07, single precision (the usual download)
#   pymeshlab      PyMeshLab 2025.7 from PyPI (double precision)
#
# With TEXTLABEL_PLUGIN set, that plugin is taken as it is. With TEXTLABEL_CMAKE_ARGS, CMake gets them too.

set -euo pipefail
top=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
host=${1:-meshlab-2020}

if [ -n "${TEXTLABEL_PLUGIN:-}" ]; then
	echo "$TEXTLABEL_PLUGIN"
	exit
fi

sdk=$host
scalar=float
case $host in
meshlab-2020) "$top/filter_textlabel/setup.sh" build run "$sdk" ;;
meshlab-2022 | meshlab-2025) "$top/filter_textlabel/setup.sh" build "$sdk" ;;
pymeshlab)
	sdk=meshlab-2025
	scalar=double
	"$top/filter_textlabel/setup.sh" build "$sdk" python
	python=$("$top/filter_textlabel/setup.sh" --where python)
	library=$(echo "$python"/lib/python3*/site-packages/pymeshlab/lib/libmeshlab-common.so)
	;;
*)
	echo "textlabel: build.sh knows meshlab-2020, meshlab-2022, meshlab-2025 and pymeshlab, not '$host'" >&2
	exit 2
	;;
esac

build=$top/build/$host
mkdir -p "$build"
exec 9>"$build/.lock"  # one at a time in this build tree
flock 9
log=$build/build.log
# shellcheck disable=SC2086  # TEXTLABEL_CMAKE_ARGS is a list of words
configure() {
	cmake -S "$top" -B "$build" -G Ninja -DTEXTLABEL_TESTS=OFF -DMESHLAB_SCALAR=$scalar \
		-DMESHLAB_SOURCE="$("$top/filter_textlabel/setup.sh" --where "$sdk")" \
		${library:+-DMESHLAB_LIBRARY="$library"} ${TEXTLABEL_CMAKE_ARGS:-}
}
{
	if [ ! -f "$build/build.ninja" ] || [ -n "${TEXTLABEL_CMAKE_ARGS:-}" ]; then
		[ -f "$build/build.ninja" ] || echo "textlabel: building the plugin for $host in build/$host" >&2
		configure
	fi && cmake --build "$build" --target filter_textlabel
} >"$log" 2>&1 9>&- || {
	cat "$log" >&2
	echo "textlabel: the plugin for $host could not be built (see above, or $log)" >&2
	exit 1
}
echo "$build/filter_textlabel/libfilter_textlabel.so"
