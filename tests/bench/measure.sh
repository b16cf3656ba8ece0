#!/usr/bin/env bash
# Run one of the other benchmarks, built with all it needs.
#
# usage: tests/bench/measure.sh stages | scaling | memory [ARGUMENT...]
#
#   stages   the operation split into its stages (stage_bench.cpp; arguments of Google Benchmark)
#   scaling  how the time grows, with fitted exponents (scaling.cpp)
#   memory   peak memory beside the mesh's own (memory.cpp)

set -euo pipefail
top=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
setup=$top/filter_textlabel/setup.sh
. "$top/tests/bench/bench_tree.sh"

case ${1:-} in
stages) program=textlabel_bench ;;
scaling | memory) program=label_$1 ;;
*) echo "usage: measure.sh stages | scaling | memory [ARGUMENT...]" >&2 && exit 2 ;;
esac
shift
"$(build_bench $program)" "$@"
