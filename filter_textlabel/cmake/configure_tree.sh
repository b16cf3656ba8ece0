# configure_tree FOLDER ARGUMENT...: configure a CMake build tree of this project, unless it was with the same arguments.
# A tree from other arguments, or from another place on the disk, starts afresh. To be sourced; needs $top.
configure_tree() {
	local tree=$1 wish
	shift
	wish=$(printf '%s\n' "$top" "$tree" "$@")
	if [ -f "$tree/build.ninja" ] && [ "$(cat "$tree/.arguments" 2>/dev/null)" = "$wish" ]; then return 0; fi
	rm -rf "$tree/CMakeCache.txt" "$tree/CMakeFiles"
	cmake -S "$top" -B "$tree" -G Ninja "$@" && printf '%s\n' "$wish" >"$tree/.arguments"
}
