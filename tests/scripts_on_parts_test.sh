#!/usr/bin/env bash
# Texts in six scripts on a curved part come out as one closed mesh, judged by admesh; a capital letter is as high as asked for,
# measured on the saved mesh. Where fonts are missing, the others are judged, and the test counts as skipped.
set -euo pipefail
cd "${TEXTLABEL_SOURCE_DIR:-$(dirname "${BASH_SOURCE[0]}")/..}"
command -v admesh >/dev/null || { echo "skipped: no admesh"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

missing=() judged=0
while IFS='|' read -r family text; do
	if [ -z "$(fc-list "$family")" ]; then
		missing+=("$family")
		continue
	fi
	filter_textlabel/label.sh --style emboss --size 3 --depth 0.6 --at 1,2,4.4 --direction 0,0,1 --up 0,1,0 --font "$family" \
		meshes/earmould.stl "$work/out.stl" "$text"
	tests/oracle_admesh.sh "$work/out.stl" >"$work/facts"
	for fact in disconnected_1=0 disconnected_2=0 disconnected_3=0 degenerate=0 edges_fixed=0 reversed=0 parts=1; do
		grep -qx "$fact" "$work/facts" || { echo "$text in $family: not $fact"; cat "$work/facts"; exit 1; }
	done
	judged=$((judged + 1))
done <<'END'
Amiri|سلام ۲۷
DejaVu Sans|שלום 27
Noto Sans Devanagari|नमस्ते
Noto Sans Thai|สวัสดี
Noto Sans CJK JP|日本語
DejaVu Sans|A ש 1
END
[ $judged -gt 0 ] || { echo "none of the fonts is there: ${missing[*]}"; exit 1; }

# Vertices above the plate are those of the top of the H: their extent in y is the capital height.
filter_textlabel/label.sh --style emboss --size 14 --depth 1.5 --at 0,-20,8 --direction 0,0,1 --up 0,1,0 meshes/bracket.stl \
	"$work/h.stl" H
python3 - "$work/h.stl" <<'END'
import struct
import sys

data = open(sys.argv[1], "rb").read()
ys = []
for i in range(struct.unpack_from("<I", data, 80)[0]):
    for corner in range(3):
        x, y, z = struct.unpack_from("<3f", data, 84 + 50 * i + 12 + 12 * corner)
        if abs(z - 9.5) < 1e-5 and abs(x) < 10 and abs(y + 20) < 10:
            ys.append(y)
height = max(ys) - min(ys)
assert abs(height - 14) < 14 / 400, height
END

if [ ${#missing[@]} -gt 0 ]; then
	printf 'skipped: no font %s\n' "${missing[@]}"
	exit 77
fi
