#!/usr/bin/env bash
# tools/setup.sh: installs what building yat needs and is not here, on Debian 12, Debian 13 and
# Ubuntu 24.04. Says nothing and changes nothing when all is there. Uses sudo when not root.
# YAT_SKIP_SETUP=1 skips it (libraries in other places: CMake names what it does not find).
#
# xsimd 13: where the distribution's own is older, the header-only libxsimd-dev and the xtl-dev that
# it depends on are downloaded from the distribution's next release, with a package list that lives
# in a temporary folder and is checked against the distribution's signing key. No source and no pin
# stays behind, so nothing else can ever come from that release.
set -euo pipefail

packages=(
  g++ cmake ninja-build ccache git
  libglm-dev libopenimageio-dev libtbb-dev libcli11-dev libfmt-dev nlohmann-json3-dev
  libgtest-dev libbenchmark-dev
)
xsimd_packages=(libxsimd-dev xtl-dev)
xsimd_least=13

say() { printf 'setup: %s\n' "$*" >&2; }
fail() {
  say "$*"
  exit 3
}

[ -z "${YAT_SKIP_SETUP:-}" ] || exit 0
if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
  say "no apt here: nothing installed; CMake names the libraries that it does not find"
  exit 0
fi

installed_version() {
  local state
  state=$(dpkg-query -W -f '${db:Status-Status} ${Version}' "$1" 2>/dev/null) || return 0
  case $state in "installed "*) printf '%s' "${state#installed }" ;; esac
}
new_enough() { [ -n "$1" ] && dpkg --compare-versions "$1" ge "$xsimd_least"; }

missing=()
for package in "${packages[@]}"; do
  [ -n "$(installed_version "$package")" ] || missing+=("$package")
done
xsimd_missing=
new_enough "$(installed_version libxsimd-dev)" || xsimd_missing=yes
[ ${#missing[@]} -gt 0 ] || [ -n "$xsimd_missing" ] || exit 0

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null ||
    fail "not root and no sudo; as root: apt-get install --no-install-recommends ${missing[*]}${xsimd_missing:+, and run tools/setup.sh for xsimd $xsimd_least}"
  as_root=(sudo)
fi
# Nobody is there to answer a question.
apt_get() {
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q -y -o Dpkg::Use-Pty=0 "$@" </dev/null
}

# Downloads the packages "$2"... of release "$1" into the folder $work, from the mirror that this
# machine takes its own release from.
download_from_release() {
  local release=$1 own mirror keyring component signed_by
  shift
  own=$(. /etc/os-release && printf '%s' "${VERSION_CODENAME:-}")
  # The main archive of this machine's own release: its name alone (no -security, no -updates).
  mirror=$(apt-get indextargets --format '$(RELEASE) $(REPO_URI)' 'Created-By: Packages' |
    sed -n "s/^$own //p" | head -n 1)
  [ -n "$mirror" ] || fail "no apt source of $own here to take $* of $release from"
  signed_by=
  for keyring in debian-archive-keyring ubuntu-archive-keyring; do
    keyring=/usr/share/keyrings/$keyring.gpg
    [ ! -r "$keyring" ] || signed_by="[signed-by=$keyring]"
  done
  component=main
  [ "$own" != noble ] || component="main universe"

  mkdir -p "$work/lists/partial" "$work/cache/archives/partial" "$work/none"
  printf 'deb %s %s %s %s\n' "$signed_by" "$mirror" "$release" "$component" >"$work/sources.list"
  # apt downloads as its own user, into folders of that user.
  if id _apt >/dev/null 2>&1; then "${as_root[@]}" chown -R _apt "$work"; fi
  "${as_root[@]}" chmod -R a+rX "$work"
  local options=(
    -o "Dir::Etc::SourceList=$work/sources.list" -o "Dir::Etc::SourceParts=$work/none"
    -o Dir::Etc::Preferences=/dev/null -o "Dir::Etc::PreferencesParts=$work/none"
    -o "Dir::State::Lists=$work/lists" -o "Dir::Cache=$work/cache"
    # The archive's lists of files, translations and applications are of no use here.
    -o Acquire::Languages=none -o Acquire::IndexTargets::deb::Contents-deb::DefaultEnabled=false
  )
  apt_get "${options[@]}" update >&2
  (cd "$work" && apt_get "${options[@]}" download "$@" >&2)
}

say "installing: ${missing[*]}${xsimd_missing:+ ${xsimd_packages[*]}}"
apt_get update >&2
if [ ${#missing[@]} -gt 0 ]; then
  apt_get install --no-install-recommends "${missing[@]}" >&2
fi

if [ -n "$xsimd_missing" ]; then
  candidate=$(LC_ALL=C apt-cache policy libxsimd-dev | sed -n 's/^ *Candidate: //p')
  if new_enough "${candidate#(none)}"; then
    apt_get install --no-install-recommends "${xsimd_packages[@]}" >&2
  else
    codename=$(. /etc/os-release && printf '%s' "${VERSION_CODENAME:-unknown}")
    case $codename in
      bookworm) next=trixie ;;
      noble) next=resolute ;;
      *) fail "xsimd here is ${candidate:-not packaged}, yat needs $xsimd_least; this script knows a newer release for Debian 12 (bookworm) and Ubuntu 24.04 (noble), not for $codename" ;;
    esac
    say "xsimd of $codename is ${candidate:-not packaged}: taking ${xsimd_packages[*]} from $next"
    work=$(mktemp -d)
    trap '"${as_root[@]}" rm -rf "$work"' EXIT
    download_from_release "$next" "${xsimd_packages[@]}"
    apt_get install --no-install-recommends "$work"/*.deb >&2
  fi
  version=$(installed_version libxsimd-dev)
  new_enough "$version" || fail "libxsimd-dev is ${version:-missing} after installing, yat needs $xsimd_least"
fi
say "all there"
