#!/usr/bin/env bash
# Time ours beside CGAL's corefinement and Manifold, with all they need, and print the table of README.
#
# usage: tests/bench/side_by_side.sh [ARGUMENT OF side_by_side...]     for example: --sizes 10k,100k --turns 15
#
# The head of side_by_side.cpp says what is timed and lists the arguments. All four sizes take some minutes and 10 GB of memory.

set -euo pipefail
top=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
setup=$top/filter_textlabel/setup.sh
. "$top/tests/bench/bench_tree.sh"

program=$(build_bench side_by_side)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$program" --python "$("$setup" --where python)/bin/python" --folder "$work" "$@"
