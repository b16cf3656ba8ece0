#!/usr/bin/env bash
# Every C++ file is laid out as .clang-format says (version 14, Debian 12's).
set -euo pipefail
cd "${TEXTLABEL_SOURCE_DIR:-$(dirname "${BASH_SOURCE[0]}")/..}"
find vcg_ext filter_textlabel tests meshes \( -name '*.h' -o -name '*.cpp' \) -print0 |
	xargs -0 clang-format --dry-run --Werror
