import ctypes
import subprocess
import sys

import pytest

from memorymaze.basics.errors import RenderingError
from memorymaze.world.cameras import open_gl


def nothing_loads(name: str) -> None:
    raise OSError(f"{name}: cannot open shared object file")


@pytest.fixture(autouse=True)
def _no_wish(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("MUJOCO_GL", raising=False)


def test_egl_is_the_first_choice() -> None:
    assert open_gl.choose_backend() == "egl"


@pytest.mark.parametrize("wish", ["egl", "osmesa", "EGL "])
def test_the_environment_decides(wish: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("MUJOCO_GL", wish)
    assert open_gl.choose_backend() == wish.strip().lower()


def test_osmesa_stands_in_where_egl_is_missing(monkeypatch: pytest.MonkeyPatch) -> None:
    def only_osmesa(name: str) -> object:
        if "OSMesa" not in name:
            nothing_loads(name)
        return object()

    monkeypatch.setattr(ctypes, "CDLL", only_osmesa)
    assert open_gl.choose_backend() == "osmesa"


def test_without_any_opengl_the_error_says_what_to_type(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(ctypes, "CDLL", nothing_loads)
    with pytest.raises(RenderingError, match="apt-get install libegl1"):
        open_gl.open_context(8, 8)


def test_switched_off_opengl_is_not_used(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("MUJOCO_GL", "off")
    with pytest.raises(RenderingError, match="switches OpenGL off"):
        open_gl.choose_backend()


def test_a_process_bound_to_another_platform_says_so(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setenv("MUJOCO_GL", "egl")
    monkeypatch.setenv("PYOPENGL_PLATFORM", "glx")
    with pytest.raises(RenderingError, match="PYOPENGL_PLATFORM=glx"):
        open_gl.open_context(8, 8)


def test_a_process_forked_from_one_that_draws_says_that_it_cannot() -> None:
    # In an interpreter of its own: this one has threads, which a fork warns of.
    program = """
import os
from memorymaze.basics.errors import RenderingError
from memorymaze.world.cameras.open_gl import open_context

def draw():
    try:
        context = open_context(16, 16)
        context.make_current()
        context.free()
        return "drew"
    except RenderingError as error:
        return str(error)

print(draw(), flush=True)
child = os.fork()
if child == 0:
    print(draw(), flush=True)
    os._exit(0)
os.waitpid(child, 0)
print(draw(), flush=True)
"""
    done = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, check=True
    )
    first, forked, again = done.stdout.splitlines()
    assert (first, again) == ("drew", "drew")
    assert "'spawn'" in forked
