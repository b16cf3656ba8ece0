#!/usr/bin/env bash
# Serial numbers on parts, by PyMeshLab and the Text Label filter. What they need is brought and built.
# serial.sh --help says how.

set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)

"$here/setup.sh" python
python=$("$here/setup.sh" --where python)/bin/python
export PYTHONPATH=$here/python${PYTHONPATH:+:$PYTHONPATH}
for argument in "$@"; do
	case $argument in
	-h | --help) exec "$python" -m textlabel serial --help ;;
	esac
done
if [ -z "${TEXTLABEL_PYMESHLAB_PLUGIN:-}" ]; then
	TEXTLABEL_PYMESHLAB_PLUGIN=$(unset TEXTLABEL_PLUGIN && "$here/build.sh" pymeshlab)
	export TEXTLABEL_PYMESHLAB_PLUGIN
fi
exec "$python" -m textlabel serial "$@"
