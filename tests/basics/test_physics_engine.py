import ctypes
import os
import subprocess
import sys

import pytest


def imported_with(opengl: str) -> subprocess.CompletedProcess[str]:
    """Import the simulation in an interpreter of its own, where MuJoCo is new."""
    # What this process draws with is no wish of the new one's.
    others = {k: v for k, v in os.environ.items() if k != "PYOPENGL_PLATFORM"}
    return subprocess.run(
        [sys.executable, "-c", "import memorymaze.robot.simulation.scene"],
        env={**others, "MUJOCO_GL": opengl},
        capture_output=True,
        text=True,
        check=False,
    )


def test_an_opengl_that_does_not_exist_is_told_with_what_to_do() -> None:
    done = imported_with("webgl")
    assert done.returncode == 1
    assert "RenderingError: MuJoCo cannot be loaded with MUJOCO_GL=webgl" in done.stderr
    assert "unset MUJOCO_GL" in done.stderr


def test_an_opengl_that_is_not_installed_is_told_with_what_to_install() -> None:
    try:
        ctypes.CDLL("libOSMesa.so.8")
    except OSError:
        done = imported_with("osmesa")
        assert "RenderingError" in done.stderr
        assert "apt-get install libosmesa6" in done.stderr
    else:
        pytest.skip("OSMesa is installed here")
