#!/usr/bin/env bash
# Installs the system packages that building and checking need beside the Rust toolchain; asks for nothing when all are there.
set -euo pipefail

packages=(
    gcc       # the linker; no C is compiled
    libc6-dev # what every program is linked with
    chromium  # opens the reports that the check has made
    git       # `cargo xtask check` looks at the files git knows
)

if ! command -v dpkg-query >/dev/null; then
    echo "packages.sh: not a Debian system; needed here are a linker and git"
    exit 0
fi

missing=()
for package in "${packages[@]}"; do
    status=$(dpkg-query --show --showformat='${db:Status-Status}' "$package" 2>/dev/null || true)
    [ "$status" = installed ] || missing+=("$package")
done
if [ "${#missing[@]}" -eq 0 ]; then
    exit 0
fi

as_root=()
[ "$(id -u)" -eq 0 ] || as_root=(sudo)
export DEBIAN_FRONTEND=noninteractive
"${as_root[@]}" apt-get update --quiet
"${as_root[@]}" apt-get install --yes --quiet --no-install-recommends "${missing[@]}"
