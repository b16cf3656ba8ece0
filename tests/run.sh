#!/usr/bin/env bash
# Run all tests: install what they need, build everything that is built (the plugin for each host, the tests with asserts kept,
# the unit tests again under AddressSanitizer and UndefinedBehaviorSanitizer), and hand it to ctest. Exit 0 when all passed.
#
# usage: tests/run.sh [ARGUMENTS OF CTEST]     for example: tests/run.sh -R walk

set -euo pipefail
top=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
setup=$top/filter_textlabel/setup.sh
trees=$top/build/tests
jobs=$(nproc)
. "$top/filter_textlabel/cmake/configure_tree.sh"
unset TEXTLABEL_PLUGIN TEXTLABEL_BUILD  # the tests are about the plugins of this tree

"$setup" build run tests meshlab-2020 meshlab-2022 meshlab-2025 python

mkdir -p "$trees"
exec 9>"$trees/.lock"  # one at a time in these trees
flock 9

# Every generation of MeshLab compiles, warnings being errors; in trees of their own, as those of the user are for use.
for host in meshlab-2022 meshlab-2025; do
	echo "== plugin for $host"
	TEXTLABEL_BUILD=$trees "$top/filter_textlabel/build.sh" $host -DTEXTLABEL_WERROR=ON -DCMAKE_BUILD_TYPE=Debug >/dev/null
done
# The tests use these two as a user does.
echo "== plugin for meshlab-2020 and pymeshlab"
"$top/filter_textlabel/build.sh" >/dev/null
pymeshlab_plugin=$("$top/filter_textlabel/build.sh" pymeshlab)

build_tree() { # name, CMake's arguments
	local tree=$trees/$1
	echo "== tests, $1"
	shift
	mkdir -p "$tree"
	configure_tree "$tree" -DTEXTLABEL_WERROR=ON -DTEXTLABEL_ASSERTS=ON \
		-DMESHLAB_SOURCE="$("$setup" --where meshlab-2020)" "$@" >"$tree/configure.log" 2>&1 || {
		cat "$tree/configure.log" >&2
		return 1
	}
	cmake --build "$tree" -j "$jobs"
}
build_tree release -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS_RELEASE=-O2 \
	-DTEXTLABEL_PYTHON="$("$setup" --where python)/bin/python" -DTEXTLABEL_PYMESHLAB_PLUGIN="$pymeshlab_plugin"
build_tree sanitize -DCMAKE_BUILD_TYPE=Debug "-DCMAKE_CXX_FLAGS_DEBUG=-O1 -g1" -DTEXTLABEL_SANITIZE=ON \
	-DTEXTLABEL_PLUGIN=OFF -DTEXTLABEL_TEST_PREFIX=sanitize.

# Both trees in one run, so that there is one count.
echo 'subdirs(release sanitize)' >"$trees/CTestTestfile.cmake"
exec 9>&-
cd "$trees"
exec ctest --output-on-failure --no-tests=error -j "$jobs" "$@"
