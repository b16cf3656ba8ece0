#!/usr/bin/env bash
# Bring what TextLabel needs and this machine lacks. Quick when nothing is missing.
#
# usage: setup.sh WHAT...          install or fetch each WHAT
#        setup.sh --where WHAT     print the folder that a fetched WHAT is in
#
#   build   Debian packages to build the plugin for Debian's own MeshLab
#   run     Debian packages to run it without a screen (label.sh)
#   tests   Debian packages of tests/run.sh
#   fuzz    Debian packages of tests/fuzz.sh, beside those
#   meshlab-2020 | meshlab-2022 | meshlab-2025
#           MeshLab's headers of that version, by Debian's source client; the system's own source lists stay as they are
#   python  an environment with PyMeshLab and the other PyPI packages of tests/requirements.txt
#
# Packages are installed when root runs it; for others it says which are missing. What is fetched goes to
# $XDG_CACHE_HOME/textlabel (else ~/.cache/textlabel). TEXTLABEL_DEBIAN_MIRROR names another mirror.

set -euo pipefail
top=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cache=${XDG_CACHE_HOME:-~/.cache}/textlabel

# The mirror that this machine takes Debian's packages from; it has the sources as well.
debian_mirror() {
	local uris
	uris=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages')
	grep -m 1 -E '/debian/?$' <<<"$uris" || head -n 1 <<<"$uris"
}

build_packages=(g++ cmake ninja-build pkg-config xz-utils meshlab qtbase5-dev libqt5opengl5-dev libglew-dev
	libglu1-mesa-dev libeigen3-dev libfreetype-dev libharfbuzz-dev libfribidi-dev libfontconfig-dev
	libpolyclipping-dev libzint-dev libicu-dev libexpat1-dev)
run_packages=(xvfb xauth)
test_packages=(libgtest-dev libbenchmark-dev clang-format libcgal-dev admesh xdotool imagemagick libharfbuzz-bin
	git python3-venv ca-certificates fonts-dejavu fonts-liberation fonts-inter-variable fonts-hosny-amiri fonts-noto-core
	fonts-noto-cjk fonts-roboto-unhinted fonts-osifont fonts-routed-gothic fonts-dseg fonts-noto-color-emoji)
fuzz_packages=(clang libclang-rt-14-dev)

say() { printf 'textlabel: %s\n' "$*" >&2; }
die() {
	say "$@"
	exit 1
}

# Run a command with its output kept aside; show it only when the command fails.
quietly() {
	local log
	log=$(mktemp)
	if "$@" >"$log" 2>&1; then
		rm -f "$log"
	else
		local code=$?
		cat "$log" >&2
		rm -f "$log"
		return $code
	fi
}

# Wait for other runs of this script that do the same job. The lock lasts until this shell (a subshell) ends.
lock() {
	mkdir -p "$cache"
	exec 9>"$cache/$1.lock"
	flock 9
}

# ---- Debian packages

missing_packages() {
	local package
	declare -A installed=()
	while read -r package; do installed[${package%%:*}]=1; done < <(
		dpkg-query -W -f '${db:Status-Status} ${Package}\n' "$@" 2>/dev/null | sed -n 's/^installed //p')
	for package in "$@"; do
		[ -n "${installed[$package]:-}" ] || printf '%s ' "$package"
	done
}

apt_install() {
	DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=600 install -y -q --no-install-recommends "$@"
}

install_packages() {
	if ! command -v dpkg-query >/dev/null; then
		say "not a Debian system: taking it that these are there: $*"
		return
	fi
	local missing
	missing=$(missing_packages "$@")
	[ -n "$missing" ] || return 0
	[ "$(id -u)" = 0 ] || die "Debian packages are missing; as root run: apt-get install $missing"
	(
		lock packages
		missing=$(missing_packages "$@")  # another run may have brought them while we waited
		[ -n "$missing" ] || exit 0
		say "installing $missing"
		# shellcheck disable=SC2086  # a list of names
		if apt_install $missing >/dev/null 2>&1; then exit 0; fi
		quietly apt-get -q update || say "apt-get update failed; trying the package lists that are here"
		# shellcheck disable=SC2086
		quietly apt_install $missing || die "apt-get could not install $missing"
	)
}

# ---- MeshLab's headers

# apt-get with lists and settings of its own. $1: an existing folder for them; the rest goes to apt-get.
# The lists' age does not matter: what is taken from them is pinned by its hash.
private_apt() {
	local folder=$1
	shift
	apt-get -q \
		-o Dir::Etc::sourcelist="$folder/sources.list" -o Dir::Etc::sourceparts=/dev/null \
		-o Dir::State::Lists="$folder/lists" -o Dir::Cache="$folder/cache" \
		-o Dir::Cache::pkgcache= -o Dir::Cache::srcpkgcache= \
		-o Acquire::Languages=none -o Acquire::Check-Valid-Until=false -o Acquire::Check-Date=false \
		-o APT::Sandbox::User="$(id -un)" "$@"
}

# Download MeshLab's source archive into folder $1. $2: suite, $3: Debian's version, $4: sha256 of the archive.
download_meshlab() {
	local folder=$1 suite=$2 version=$3 hash=$4 archive
	mkdir -p "$folder/lists/partial" "$folder/cache/archives/partial"
	mirror=${TEXTLABEL_DEBIAN_MIRROR:-$(debian_mirror)}
	printf 'deb-src %s %s main\n' "$mirror" "$suite" >"$folder/sources.list"
	quietly private_apt "$folder" update || return 1
	cd "$folder"
	# A later revision of Debian's packaging holds the same archive; the hash decides.
	quietly private_apt "$folder" source --download-only --tar-only "meshlab=$version" ||
		quietly private_apt "$folder" source --download-only --tar-only meshlab || return 1
	archive=$(echo meshlab_*.orig.tar.xz)
	echo "$hash  $archive" | sha256sum --quiet --check - >&2 ||
		die "$archive is not the one of meshlab $version that this project was made with: name another mirror in TEXTLABEL_DEBIAN_MIRROR"
	mv "$archive" meshlab.tar.xz
}

fetch_meshlab() {
	local name=$1 suite=$2 version=$3 hash=$4
	[ ! -d "$cache/$name" ] || return 0
	command -v apt-get >/dev/null || die "no apt-get here to fetch MeshLab's sources: see README on MESHLAB_SOURCE"
	(
		lock "$name"
		[ ! -d "$cache/$name" ] || exit 0
		say "fetching the headers of MeshLab $version"
		work=$(mktemp -d "$cache/$name.XXXXXX")
		trap 'rm -rf "$work"' EXIT
		download_meshlab "$work" "$suite" "$version" "$hash" ||
			die "could not fetch meshlab $version from $suite: check the network, or name another mirror in TEXTLABEL_DEBIAN_MIRROR"
		mkdir "$work/tree"
		tar -xf "$work/meshlab.tar.xz" -C "$work/tree" --strip-components=1 --wildcards \
			'*/ML_VERSION' '*/LICENSE.txt' '*/src/common' '*/vcglib/vcg' '*/vcglib/wrap'
		mv "$work/tree" "$cache/$name"
	)
}

# ---- Python

# One environment for each state of the requirements.
python_folder() { echo "$cache/python-$(sha256sum <"$top/tests/requirements.txt" | head -c 12)"; }

fetch_python() {
	local folder
	folder=$(python_folder)
	[ ! -e "$folder/complete" ] || return 0
	install_packages python3-venv ca-certificates
	(
		lock python
		[ ! -e "$folder/complete" ] || exit 0
		say "making a Python environment with PyMeshLab"
		rm -rf "$folder"
		quietly python3 -m venv "$folder" || die "could not make a Python environment in $folder"
		quietly "$folder/bin/pip" install --no-input --disable-pip-version-check -r "$top/tests/requirements.txt" ||
			die "could not install tests/requirements.txt from PyPI"
		touch "$folder/complete"
	)
}

# ----

where() {
	case $1 in
	meshlab-2020 | meshlab-2022 | meshlab-2025) echo "$cache/$1" ;;
	python) python_folder ;;
	*) die "nothing is fetched for '$1'" ;;
	esac
}

if [ "${1:-}" = --where ]; then
	where "${2:?setup.sh --where WHAT}"
	exit
fi
[ $# -gt 0 ] || die "usage: setup.sh build|run|tests|fuzz|meshlab-2020|meshlab-2022|meshlab-2025|python ..."
packages=()
for what in "$@"; do
	case $what in
	build) packages+=("${build_packages[@]}") ;;
	run) packages+=("${run_packages[@]}") ;;
	tests) packages+=("${test_packages[@]}") ;;
	fuzz) packages+=("${fuzz_packages[@]}") ;;
	meshlab-2020 | meshlab-2022 | meshlab-2025 | python) ;;
	*) die "unknown: '$what'; see the head of setup.sh" ;;
	esac
done
[ ${#packages[@]} = 0 ] || install_packages "${packages[@]}"
for what in "$@"; do
	case $what in
	meshlab-2020)
		fetch_meshlab "$what" bookworm 2020.09+dfsg1-2 \
			d6715352ff65caffdec0292858d4263eb0c3cbbf3b1e5c2e2bab218e3f234630 ;;
	meshlab-2022)
		fetch_meshlab "$what" trixie 2022.02+dfsg1-1 \
			11da26ec46c3fbbbc806d410a3221542ec21ec13fdcc55d624304600029435fd ;;
	meshlab-2025)
		fetch_meshlab "$what" sid 2025.07~dfsg-4 \
			d22c98d362f2a284e481af8dbfc272b2222f5b9c67b3cf8bec57d1c3161886f4 ;;
	python) fetch_python ;;
	esac
done
