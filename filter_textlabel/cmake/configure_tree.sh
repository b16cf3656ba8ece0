# configure_tree FOLDER ARGUMENT...: configure a CMake build tree of this project, unless that is done already.
# With other arguments, other CMake files or in another place on the disk it starts afresh, so that nothing stale is kept
# but objects. To be sourced; needs $top.
configure_tree() {
	local tree=$1 state
	shift
	state=$(
		printf '%s\n' "$top" "$tree" "$@"
		cat "$top"/CMakeLists.txt "$top"/*/CMakeLists.txt "$top"/filter_textlabel/cmake/*.cmake | sha256sum
	)
	if [ -f "$tree/build.ninja" ] && [ "$(cat "$tree/.configured" 2>/dev/null)" = "$state" ]; then return 0; fi
	rm -rf "$tree/CMakeCache.txt" "$tree/CMakeFiles"
	cmake -S "$top" -B "$tree" -G Ninja "$@" && printf '%s\n' "$state" >"$tree/.configured"
}
