#!/usr/bin/env bash
# Every C++ file is laid out as .clang-format says (version 14, Debian 12's). With --fix: lay them out so.
set -euo pipefail
cd "${TEXTLABEL_SOURCE_DIR:-$(dirname "${BASH_SOURCE[0]}")/..}"
action=(--dry-run --Werror)
[ "${1:-}" != --fix ] || action=(-i)
find vcg_ext filter_textlabel tests meshes \( -name '*.h' -o -name '*.cpp' \) -print0 |
	xargs -0 clang-format "${action[@]}"
