#!/usr/bin/env bash
# What a label costs a whole process: load, label and save against load and save, through meshlabserver 2020.09 and PyMeshLab.
#
# usage: tests/bench/whole_process.sh [--runs 11] [--sizes 100000,1000000]
#
# Each run is a process of its own, the two kinds in turn; the table has medians and the median of the paired differences.

set -euo pipefail
top=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
setup=$top/filter_textlabel/setup.sh
. "$top/tests/bench/bench_tree.sh"
# shellcheck source=filter_textlabel/meshlab_tree.sh
. "$top/filter_textlabel/meshlab_tree.sh"

program=$(build_bench bench_part)
"$setup" run python
plugin=$("$top/filter_textlabel/build.sh")
pymeshlab_plugin=$("$top/filter_textlabel/build.sh" pymeshlab)
work=$(mktemp -d)
display_pid=
trap '[ -z "$display_pid" ] || kill "$display_pid"; rm -rf "$work"' EXIT

make_meshlab_tree "$work/tree" meshlabserver "$plugin" 'libio_*.so'
start_display "$work" 64x64x24
"$(dirname "$plugin")/textlabel_script" placement=point position=0,0,20 direction=0,0,1 up=0,1,0 size=10 depth=1 text=A43 \
	>"$work/label.mlx"
export XDG_RUNTIME_DIR=$work LC_ALL=C.UTF-8
"$("$setup" --where python)/bin/python" "$top/tests/bench/whole_process.py" \
	--part "$program" --server "$work/tree/bin/meshlabserver" --plugin "$pymeshlab_plugin" --folder "$work" "$@"
