#!/usr/bin/env bash
# Installs the system packages that building and checking need beside the Rust toolchain; asks for nothing when all are there.
set -euo pipefail

packages=(
    gcc       # the linker; no C is compiled
    libc6-dev # what every program is linked with
    git       # `cargo xtask check` looks at the files git knows
)
optional=(
    chromium # opens the reports that the check has made; the check says where it is absent
    python3 # for the tests of the Python package; the check says where it is absent
    python3-venv
)

if ! command -v dpkg-query >/dev/null; then
    echo "packages.sh: not a Debian system; needed here are a linker and git"
    exit 0
fi

is_there() {
    local status
    status=$(dpkg-query --show --showformat='${db:Status-Status}' "$1" 2>/dev/null || true)
    [ "$status" = installed ]
}
missing=()
for package in "${packages[@]}"; do
    is_there "$package" || missing+=("$package")
done
wanted=()
for package in "${optional[@]}"; do
    is_there "$package" || wanted+=("$package")
done
if [ "${#missing[@]}" -eq 0 ] && [ "${#wanted[@]}" -eq 0 ]; then
    exit 0
fi

as_root=()
[ "$(id -u)" -eq 0 ] || as_root=(sudo)
export DEBIAN_FRONTEND=noninteractive
install=("${as_root[@]}" apt-get install --yes --quiet --no-install-recommends)
if [ "${#missing[@]}" -gt 0 ]; then
    "${as_root[@]}" apt-get update --quiet
    "${install[@]}" "${missing[@]}"
fi
if [ "${#wanted[@]}" -gt 0 ]; then
    { "${as_root[@]}" apt-get update --quiet && "${install[@]}" "${wanted[@]}"; } ||
        echo "packages.sh: without ${wanted[*]}"
fi
