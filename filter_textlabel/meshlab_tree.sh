# shellcheck shell=bash
# Functions to run Debian's MeshLab 2020.09 with a plugin that is not installed, on a display of its own. To be sourced.
#
# MeshLab finds its plugins beside its program (../lib/<triplet>/meshlab/plugins), and no variable changes that: so a copy of the
# program is put in a private tree whose other parts are links.

# make_meshlab_tree FOLDER PROGRAM PLUGIN [PATTERN]: FOLDER/bin/PROGRAM runs with PLUGIN and with those of MeshLab's own plugins
# whose names match PATTERN (default: all of them).
make_meshlab_tree() {
	local tree=$1 program=$2 plugin=$3 pattern=${4:-lib*.so} installed library
	[ -f "$plugin" ] || { echo "There is no plugin '$plugin'." >&2; return 1; }
	for installed in /usr/lib/*/meshlab; do break; done
	library=$tree${installed#/usr}
	mkdir -p "$tree/bin" "$tree/share" "$library/plugins"
	cp "/usr/bin/$program" "$tree/bin/"
	ln -sf "$installed/libmeshlab-common.so" "$library/"
	# shellcheck disable=SC2086  # the pattern is to be expanded
	ln -sf "$installed"/plugins/$pattern "$(realpath -s -- "$plugin")" "$library/plugins/"
	ln -sfn /usr/share/meshlab "$tree/share/meshlab"
}

# start_display FOLDER SIZE: start a virtual display; DISPLAY is set, display_pid is the process to end. FOLDER is for its files.
start_display() {
	local folder=$1 size=$2 waited=0
	: >"$folder/display"
	Xvfb -displayfd 9 -screen 0 "$size" +extension GLX -nolisten tcp 9>"$folder/display" >"$folder/display.log" 2>&1 &
	display_pid=$!
	until [ -s "$folder/display" ]; do
		if ! kill -0 "$display_pid" 2>/dev/null || [ $((waited += 1)) -gt 1500 ]; then
			echo "Xvfb, the virtual display that MeshLab needs, did not start:" >&2
			cat "$folder/display.log" >&2
			return 1
		fi
		sleep 0.02
	done
	DISPLAY=:$(cat "$folder/display")
	export DISPLAY QT_QPA_PLATFORM=xcb LIBGL_ALWAYS_SOFTWARE=1
	unset WAYLAND_DISPLAY XAUTHORITY
}
