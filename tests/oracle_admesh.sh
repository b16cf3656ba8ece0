#!/usr/bin/env bash
# What admesh says about an STL file, as key=value lines: a judge for the tests that knows nothing of this project.
#
#   oracle_admesh.sh FILE.stl
#
# admesh merges equal points, then repairs in memory (nothing is written): edges_fixed, removed, added, reversed and backwards
# tell what it had to do, and are all 0 for a sound file. disconnected_N: faces with N open sides as they came.
# It does not see: faces without area but with three different points, edges of four faces, crossing faces.
# Exit: 0 whatever the mesh is like, 2 when the file can't be read, 77 without admesh.
set -euo pipefail
[ $# -eq 1 ] || { echo "usage: $0 FILE.stl" >&2; exit 2; }
command -v admesh >/dev/null || { echo "admesh is not installed" >&2; exit 77; }
report=$(LC_ALL=C admesh "$1" 2>&1) && [[ $report == *"Number of facets"* ]] || { echo "admesh can't read $1" >&2; exit 2; }

# LABEL KEY [COLUMN]: the COLUMN-th number after "LABEL ... :"
value() {
	awk -v label="$1" -v key="$2" -v column="${3:-1}" '
		(at = index($0, label)) {
			rest = substr($0, at + length(label)); sub(/^ *:/, "", rest); split(rest, words, " ")
			print key "=" words[column]; found = 1; exit
		}
		END { if (!found) exit 1 }' <<<"$report"
}
value "Number of facets" faces
value "Number of facets" faces_left 2
value "Facets with 1 disconnected edge" disconnected_1
value "Facets with 2 disconnected edges" disconnected_2
value "Facets with 3 disconnected edges" disconnected_3
value "Number of parts" parts
value "Volume" volume
value "Degenerate facets" degenerate
value "Edges fixed" edges_fixed
value "Facets removed" removed
value "Facets added" added
value "Facets reversed" reversed
value "Backwards edges" backwards
value "Normals fixed" normals_fixed
