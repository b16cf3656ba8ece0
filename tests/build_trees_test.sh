#!/usr/bin/env bash
# Which plugin the scripts take, and which build trees they touch. In a copy of the scripts, with programs that only write down how
# they were called instead of CMake and ctest.
set -euo pipefail
cd "${TEXTLABEL_SOURCE_DIR:-$(dirname "${BASH_SOURCE[0]}")/..}"
command -v dpkg-query >/dev/null || { echo "skipped: no Debian"; exit 77; }
plugin=${TEXTLABEL_PLUGIN:-}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
unset TEXTLABEL_PLUGIN TEXTLABEL_BUILD
fail() { echo "FAILED: $*" >&2; exit 1; }

copy=$work/copy
mkdir -p "$copy/tests" "$copy/vcg_ext" "$work/bin"
cp -r filter_textlabel CMakeLists.txt "$copy/"
cp vcg_ext/CMakeLists.txt "$copy/vcg_ext/"
cp tests/run.sh tests/CMakeLists.txt tests/requirements.txt "$copy/tests/"
# A line for each tree that is configured: its folder within build/, and its build type.
cat >"$work/bin/cmake" <<'END'
#!/usr/bin/env bash
[ "$1" = -S ] || exit 0
while [ $# -gt 0 ]; do
	case $1 in
	-B) tree=$2 ;;
	-DCMAKE_BUILD_TYPE=*) kind=${1#*=} ;;  # the last one counts
	esac
	shift
done
touch "$tree/build.ninja"
echo "${tree##*/build/} $kind" >>"$CALLS"
END
printf '#!/bin/sh\n' >"$work/bin/ctest"
chmod +x "$work/bin/"*
export CALLS=$work/calls PATH=$work/bin:$PATH

# The tests build for all versions, and leave the user's trees alone.
for host in meshlab-2020 meshlab-2022 meshlab-2025 pymeshlab; do
	"$copy/filter_textlabel/build.sh" $host >>"$work/plugins" 2>/dev/null
	echo "$host Release" >>"$work/expected"
	echo "$copy/build/$host/filter_textlabel/libfilter_textlabel.so" >>"$work/expected_plugins"
done
diff "$work/expected_plugins" "$work/plugins" || fail "build.sh printed other plugins"
diff "$work/expected" "$CALLS" || fail "build.sh built other trees"
TEXTLABEL_BUILD=$work/elsewhere "$copy/tests/run.sh" >"$work/log" 2>&1 || { cat "$work/log"; fail "exit $? of run.sh"; }
printf '%s\n' 'tests/meshlab-2022 Debug' 'tests/meshlab-2025 Debug' 'tests/release Release' 'tests/sanitize Debug' >>"$work/expected"
diff "$work/expected" "$CALLS" || fail "run.sh built other trees"
(cd "$work" && TEXTLABEL_BUILD=other "$copy/filter_textlabel/build.sh" 2>/dev/null) >"$work/printed"
[ "$(cat "$work/printed")" = "$work/other/meshlab-2020/filter_textlabel/libfilter_textlabel.so" ] || fail "TEXTLABEL_BUILD is not followed"

# A plugin by a relative name is meant from here; one that is not there is refused, and no mesh written.
if [ -f "$plugin" ] && command -v meshlabserver >/dev/null && command -v Xvfb >/dev/null; then
	top=$PWD
	cd "$(dirname "$plugin")"
	for name in "${plugin##*/}" "./${plugin##*/}"; do
		[ "$(TEXTLABEL_PLUGIN=$name "$top/filter_textlabel/build.sh")" = "$PWD/${plugin##*/}" ] ||
			fail "build.sh takes $name elsewhere"
		TEXTLABEL_PLUGIN=$name "$top/filter_textlabel/label.sh" "$top/meshes/bracket.stl" "$work/out.stl" A ||
			fail "label.sh with the plugin $name"
		[ -s "$work/out.stl" ] && rm "$work/out.stl" || fail "no mesh with the plugin $name"
	done
	. "$top/filter_textlabel/meshlab_tree.sh"
	make_meshlab_tree "$work/tree" meshlabserver "${plugin##*/}" none
	[ -e "$(find "$work/tree" -name "${plugin##*/}")" ] || fail "the private tree's link to the plugin leads nowhere"
	! make_meshlab_tree "$work/tree" meshlabserver missing.so none 2>/dev/null || fail "a private tree without a plugin"
	cd "$top"
fi
for script in build.sh label.sh; do
	if TEXTLABEL_PLUGIN=missing.so filter_textlabel/$script meshes/bracket.stl "$work/out.stl" A >"$work/printed" 2>"$work/log"; then
		fail "$script goes on without a plugin"
	fi
	grep -q "TEXTLABEL_PLUGIN names no file: 'missing.so'" "$work/log" || fail "$script: $(cat "$work/log")"
	[ ! -s "$work/printed" ] && [ ! -e "$work/out.stl" ] || fail "$script: something is left without a plugin"
done
