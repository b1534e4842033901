#!/usr/bin/env bash
# Install software OpenGL, for cameras; only Debian, Ubuntu and their like, as root.
# Everything but pictures works without it.
set -euo pipefail

packages=(libegl1 libgl1 libgl1-mesa-dri)

can_load() {
    ldconfig -p 2>/dev/null | grep -q "$1"
}

if can_load 'libEGL\.so\.1' && can_load 'libGL\.so\.1'; then
    exit 0
fi
if ! command -v apt-get >/dev/null; then
    echo "graphics: no apt-get here; cameras need EGL or OSMesa (Mesa's libraries)" >&2
    exit 1
fi
if [ "$(id -u)" != 0 ]; then
    echo "graphics: cameras need software OpenGL; type: sudo apt-get install ${packages[*]}" >&2
    exit 1
fi
apt-get install --yes --no-install-recommends "${packages[@]}" >/dev/null 2>&1 || {
    apt-get update >/dev/null 2>&1 || true
    apt-get install --yes --no-install-recommends "${packages[@]}" >/dev/null || {
        echo "graphics: apt-get could not install ${packages[*]}; cameras will not work" >&2
        exit 1
    }
}
