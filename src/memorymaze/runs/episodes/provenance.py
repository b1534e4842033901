"""With what code a run was made."""

import hashlib
import subprocess
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from platform import python_version

PACKAGES = ("mujoco", "numpy", "pydantic-monty", "scipy", "shapely")
"""Packages whose version can change a result."""
OPTIONAL_PACKAGES = ("navground",)
"""Those that may be missing."""


@dataclass(frozen=True, slots=True)
class CodeStamp:
    """The code that made a run."""

    version: str
    """Of memorymaze."""
    sha256: str
    """Fingerprint of all files of the package, so that edits are noticed."""
    commit: str | None
    """Commit of the checkout, ending in `+` when files differ from it."""
    python: str
    packages: Mapping[str, str]
    """Versions of the packages that results depend on."""

    def differences(self, new: "CodeStamp") -> list[str]:
        """Say in what other code differs that could change results."""
        found = [
            f"{name}: {self.packages.get(name)} there, {now} here"
            for name, now in new.packages.items()
            if self.packages.get(name) != now
        ]
        if self.sha256 != new.sha256:
            there, here = self._named(), new._named()
            found.insert(0, f"memorymaze's code: {there} there, {here} here")
        return found

    def _named(self) -> str:
        commit = "" if self.commit is None else f"commit {self.commit[:12]}"
        edited = "+" if self.commit and self.commit.endswith("+") else ""
        files = f"files {self.sha256[:12]}"
        return ", ".join(filter(None, [self.version, f"{commit}{edited}", files]))


@cache
def code_stamp() -> CodeStamp:
    """Return the stamp of the code that is running."""
    root = Path(__file__).parents[2]
    digest = hashlib.sha256()
    for path in sorted(root.rglob("*")):
        if path.is_file() and "__pycache__" not in path.parts:
            digest.update(str(path.relative_to(root)).encode() + b"\0")
            digest.update(hashlib.sha256(path.read_bytes()).digest())
    return CodeStamp(
        version=version("memorymaze"),
        sha256=digest.hexdigest(),
        commit=_commit(root),
        python=python_version(),
        packages=_versions(),
    )


def _versions() -> dict[str, str]:
    found = {name: version(name) for name in PACKAGES}
    for name in OPTIONAL_PACKAGES:
        with suppress(PackageNotFoundError):
            found[name] = version(name)
    return found


def _commit(root: Path) -> str | None:
    """Return the commit of the checkout the package lies in, if it does."""
    if _git(root, "ls-files", "--error-unmatch", "__init__.py") is None:
        return None
    commit = _git(root, "rev-parse", "HEAD")
    changed = _git(root, "status", "--porcelain", "--", ".")
    return f"{commit}{'+' if changed else ''}" if commit else None


def _git(root: Path, *arguments: str) -> str | None:
    try:
        done = subprocess.run(
            ["git", "-C", str(root), *arguments],
            capture_output=True,
            text=True,
            timeout=10,
            check=True,
        )
    except (OSError, subprocess.SubprocessError):
        return None
    return done.stdout.strip()
