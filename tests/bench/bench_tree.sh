# shellcheck shell=bash
# The build tree of the benchmarks. To be sourced; needs $top and $setup.

# build_bench TARGET: build a benchmark as the plugin is built for its users, with all it needs, and print its path.
build_bench() {
	local build=${TEXTLABEL_BENCH_BUILD:-$top/build/bench}
	. "$top/filter_textlabel/cmake/configure_tree.sh"
	"$setup" build tests meshlab-2020 python
	mkdir -p "$build"
	(
		flock 9  # one at a time in this tree
		{ configure_tree "$build" -DCMAKE_BUILD_TYPE=Release -DTEXTLABEL_PLUGIN=OFF \
			-DMESHLAB_SOURCE="$("$setup" --where meshlab-2020)" && cmake --build "$build" --target "$1"; } >"$build/log" 2>&1 9>&- || {
			cat "$build/log" >&2
			exit 1
		}
	) 9>"$build/.lock"
	echo "$build/tests/bench/$1"
}
