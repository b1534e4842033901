#!/usr/bin/env bash
# Make the virtual environment and install the project, pinned.
# usage: setup.sh PYTHON VENV run|develop
set -euo pipefail
python=$1
venv=$2
purpose=$3

version=$("$python" -c 'import sys; print("%d.%d" % sys.version_info[:2])') || {
    echo "setup: '$python' does not run; install Python 3.11 or newer, or give one: make PYTHON=python3.12 …" >&2
    exit 1
}
"$python" -c 'import sys; sys.exit(sys.version_info < (3, 11))' || {
    echo "setup: memorymaze needs Python 3.11 or newer, '$python' is $version; give one: make PYTHON=python3.12 …" >&2
    exit 1
}
# uv does the same in a fraction of the time, but does not read pip's configuration.
make_environment() {
    if command -v uv >/dev/null; then
        uv venv --quiet --seed --python "$(command -v "$python")" "$venv" && return
    fi
    "$python" -m venv "$venv"
}
install() {
    if command -v uv >/dev/null; then
        uv pip install --quiet --python "$venv/bin/python" "$@" && return
        echo "setup: uv could not; going on with pip" >&2
    fi
    "$venv/bin/python" -m pip install --quiet --disable-pip-version-check "$@"
}
[ -x "$venv/bin/python" ] || make_environment || {
    echo "setup: could not make a virtual environment; on Debian and Ubuntu: apt-get install python3-venv" >&2
    exit 1
}
if [ "$purpose" = run ]; then
    # Python compiles what a run imports; compiling all that is installed takes longer.
    install --no-compile --constraint constraints.txt --editable .
    exit 0
fi
# Groups of dependencies need a newer pip than some Pythons bring along.
install --compile --upgrade "pip>=25.1"
# The tests try every extra but the local language models, which have to be compiled.
install --compile --constraint constraints.txt --editable . --group dev
# Only cameras need OpenGL; whatever keeps it out must not keep the rest from working.
bash scripts/setup_graphics.sh || echo "setup: going on without graphics" >&2
# Only tests of exported buildings need them.
bash scripts/setup_node_packages.sh "$venv" || echo "setup: going on without node packages" >&2
# Only tests of pages and of exported buildings need a browser.
bash scripts/setup_browser.sh || echo "setup: going on without a browser" >&2
