#!/bin/sh
# Installs the Debian packages of packages.txt that are not there yet. Asks for no input.
set -eu
list=$(dirname "$0")/packages.txt

if ! command -v dpkg-query >/dev/null; then
  echo "This is no Debian system: if the build misses something, it is one of these:" >&2
  tr '\n' ' ' < "$list" >&2
  echo >&2
  exit 0
fi

installed=$(dpkg-query -W -f '${Package} ${db:Status-Status}\n' 2>/dev/null | sed -n 's/ installed$//p')
missing=$(printf '%s\n' "$installed" | sort -u | awk 'NR == FNR { there[$1] = 1; next } !($1 in there)' - "$list")
[ -z "$missing" ] && exit 0

as_root=
if [ "$(id -u)" -ne 0 ]; then
  if ! command -v sudo >/dev/null; then
    echo "Missing packages, and neither root nor sudo to install them. As root:" >&2
    echo "apt-get install --no-install-recommends" $missing >&2
    exit 1
  fi
  as_root=sudo
fi

apt() {
  $as_root env DEBIAN_FRONTEND=noninteractive apt-get -q -y -o DPkg::Lock::Timeout=300 \
    -o Dpkg::Use-Pty=0 -o Dpkg::Options::=--force-confdef -o Dpkg::Options::=--force-confold \
    "$@" </dev/null
}

echo "Installing:" $missing
# The package lists are fetched where there are none, or where they have grown too old to serve.
apt --simulate --no-install-recommends install $missing >/dev/null 2>&1 || apt update
apt --no-install-recommends install $missing || { apt update && apt --no-install-recommends install $missing; }
