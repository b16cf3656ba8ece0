#!/usr/bin/env bash
# The table of labels on real parts from all sides, judged by our report, by admesh and by CGAL (view_table_main.cpp).
# About five minutes. The meshes are the arguments, else those of the folder that TEXTLABEL_REAL_MESHES names (real_meshes.tsv says
# where they come from), else those in ../shared/meshes beside the project.
#
# usage: tests/view_table.sh [--log FILE] [--keep FOLDER] [--quick] [MESH...]

set -euo pipefail
top=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
setup=$top/filter_textlabel/setup.sh
tree=$top/build/view_table
. "$top/filter_textlabel/cmake/configure_tree.sh"

"$setup" build tests meshlab-2020
mkdir -p "$tree"
configure_tree "$tree" -DCMAKE_BUILD_TYPE=Release -DTEXTLABEL_PLUGIN=OFF \
	-DMESHLAB_SOURCE="$("$setup" --where meshlab-2020)" >/dev/null
cmake --build "$tree" --target view_table oracle_cgal >/dev/null
exec "$tree/tests/view_table" "$@"
