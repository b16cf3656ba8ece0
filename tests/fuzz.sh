#!/usr/bin/env bash
# Build a coverage-guided fuzz target (tests/fuzz_NAME.cpp; Clang's libFuzzer with its sanitizers) and run it.
#
# usage: tests/fuzz.sh NAME [ARGUMENTS OF LIBFUZZER]     for example: tests/fuzz.sh walk -max_total_time=600
#
# What it learns is kept in build/fuzz/corpus-NAME, a failing input in build/fuzz/failure-NAME-*.

set -euo pipefail
top=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
setup=$top/filter_textlabel/setup.sh
tree=$top/build/fuzz
. "$top/filter_textlabel/cmake/configure_tree.sh"

name=${1:-}
[ -f "$top/tests/fuzz_$name.cpp" ] || {
	echo "usage: tests/fuzz.sh NAME [ARGUMENTS OF LIBFUZZER]; NAME is one of: $(
		find "$top/tests" -name 'fuzz_*.cpp' -printf '%f ' | sed 's/fuzz_//g; s/\.cpp//g')" >&2
	exit 2
}
shift

"$setup" build tests fuzz meshlab-2020
mkdir -p "$tree/corpus-$name"
configure_tree "$tree" -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_BUILD_TYPE=Release "-DCMAKE_CXX_FLAGS_RELEASE=-O1 -g1" \
	-DTEXTLABEL_ASSERTS=ON -DTEXTLABEL_SANITIZE=ON -DTEXTLABEL_PLUGIN=OFF \
	-DMESHLAB_SOURCE="$("$setup" --where meshlab-2020)" >/dev/null
cmake --build "$tree" --target "fuzz_$name"
exec "$tree/tests/fuzz_$name" -artifact_prefix="$tree/failure-$name-" "$@" "$tree/corpus-$name"
