#!/usr/bin/env bash
# Install Chromium, with which tests look at pages and at exported buildings; only Debian,
# Ubuntu and their like, as root. Everything but those tests works without it.
set -euo pipefail

for name in chromium chromium-browser google-chrome; do
    if command -v "$name" >/dev/null; then
        exit 0
    fi
done
if ! command -v apt-get >/dev/null; then
    echo "browser: no apt-get here; tests of pages need Chromium" >&2
    exit 1
fi
if [ "$(id -u)" != 0 ]; then
    echo "browser: tests of pages need Chromium; type: sudo apt-get install chromium" >&2
    exit 1
fi
apt-get install --yes --no-install-recommends chromium >/dev/null 2>&1 || {
    apt-get update >/dev/null 2>&1 || true
    apt-get install --yes --no-install-recommends chromium >/dev/null || {
        echo "browser: apt-get could not install chromium; tests of reports will fail" >&2
        exit 1
    }
}
