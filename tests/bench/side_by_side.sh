#!/usr/bin/env bash
# Time ours beside CGAL's corefinement and Manifold, with all they need, and print the table of README.
#
# usage: tests/bench/side_by_side.sh [ARGUMENT OF side_by_side...]     for example: --sizes 10k,100k --runs 15
#        tests/bench/side_by_side.sh --build                           only build, and print the program's path
#
# The head of side_by_side.cpp says what is timed and lists the arguments. All four sizes take about ten minutes.

set -euo pipefail
top=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
setup=$top/filter_textlabel/setup.sh
build=${TEXTLABEL_BENCH_BUILD:-$top/build/bench}
. "$top/filter_textlabel/cmake/configure_tree.sh"

"$setup" build tests meshlab-2020 python
mkdir -p "$build"
exec 9>"$build/.lock"  # one at a time in this tree
flock 9
{ configure_tree "$build" -DCMAKE_BUILD_TYPE=Release -DTEXTLABEL_PLUGIN=OFF \
	-DMESHLAB_SOURCE="$("$setup" --where meshlab-2020)" && cmake --build "$build" --target side_by_side; } >"$build/log" 2>&1 9>&- || {
	cat "$build/log" >&2
	exit 1
}
exec 9>&-
[ "${1:-}" != --build ] || { echo "$build/tests/bench/side_by_side" && exit; }

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$build/tests/bench/side_by_side" --python "$("$setup" --where python)/bin/python" --folder "$work" "$@"
