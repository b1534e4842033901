"""Which OpenGL draws: EGL where it works, else OSMesa; nothing is loaded at import.

No display is needed. Without a graphics card Mesa draws in software.
"""

import ctypes
import os
from typing import Literal, Protocol

from memorymaze.basics.errors import RenderingError
from memorymaze.basics.physics_engine import mujoco

Backend = Literal["egl", "osmesa"]

HOW_TO_INSTALL = (
    "on Debian and Ubuntu type: apt-get install libegl1 libgl1 libgl1-mesa-dri "
    "(or: bash scripts/setup_graphics.sh)"
)

_EGL_PLATFORM_DEVICE = 0x313F
_MOST_DEVICES = 16

_drawing_processes: set[int] = set()
"""This process, once it has drawn; and those it was forked from that had."""


class DrawingContext(Protocol):
    """An OpenGL context without a window."""

    def make_current(self) -> None:
        """Let the calling thread's OpenGL calls go to this context."""
        ...

    def free(self) -> None:
        """Give its resources back."""
        ...


def choose_backend() -> Backend:
    """Tell which OpenGL to draw with.

    `MUJOCO_GL` decides where it says `egl` or `osmesa`. Otherwise it is EGL where it
    offers a device to draw with, else OSMesa.
    """
    wanted = os.environ.get("MUJOCO_GL", "").strip().lower()
    if wanted == "egl" or wanted == "osmesa":
        return wanted
    if wanted in {"disable", "disabled", "off", "false", "0"}:
        raise RenderingError(
            f"cannot draw: MUJOCO_GL={wanted} switches OpenGL off; unset it or set it "
            "to egl or osmesa"
        )
    if _egl_has_a_device():
        return "egl"
    if _library("libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so") is not None:
        return "osmesa"
    raise RenderingError(
        "cannot draw: neither EGL nor OSMesa works on this machine; " + HOW_TO_INSTALL
    )


def open_context(width: int, height: int) -> DrawingContext:
    """Open an OpenGL context without a window, to draw at up to so many pixels."""
    if _drawing_processes - {os.getpid()}:
        # The threads and connections of OpenGL do not come along; it would hang.
        raise RenderingError(
            "cannot draw: this process was forked from one that has drawn already, "
            "which OpenGL does not survive; start processes by the method 'spawn', or "
            "before the first picture"
        )
    backend = choose_backend()
    # Whoever loads PyOpenGL first decides its platform, by this variable.
    platform = os.environ.get("PYOPENGL_PLATFORM")
    if platform and platform != backend:
        raise RenderingError(
            f"cannot draw with {backend}: PYOPENGL_PLATFORM={platform} is set in this "
            f"process; unset it or set it to {backend}"
        )
    try:
        if backend == "egl":
            from mujoco.egl import GLContext
        else:
            from mujoco.osmesa import GLContext
        context = GLContext(width, height)
        _drawing_processes.add(os.getpid())
        return context
    except (ImportError, AttributeError, OSError, RuntimeError) as error:
        raise RenderingError(
            f"cannot draw with {backend}: {error}; {HOW_TO_INSTALL}"
        ) from error


def filter_fast(buffers: mujoco.MjrContext) -> None:
    """Read each texture from one of its sizes instead of mixing two.

    In software this takes an eighth off a picture's time, and hardly shows.
    """
    from OpenGL import GL

    for texture, kind in zip(
        buffers.texture[: buffers.ntexture],
        buffers.textureType[: buffers.ntexture],
        strict=True,
    ):
        if kind == mujoco.mjtTexture.mjTEXTURE_2D:
            GL.glBindTexture(GL.GL_TEXTURE_2D, int(texture))
            GL.glTexParameteri(
                GL.GL_TEXTURE_2D,
                GL.GL_TEXTURE_MIN_FILTER,
                GL.GL_LINEAR_MIPMAP_NEAREST,
            )


def _egl_has_a_device() -> bool:
    """Ask EGL for a device that can be drawn with, without loading PyOpenGL.

    PyOpenGL keeps to the first platform it is loaded for, so a failed try with EGL
    would spoil OSMesa for the rest of the process.
    """
    egl = _library("libEGL.so.1", "libEGL.so")
    if egl is None:
        return False
    egl.eglGetProcAddress.restype = ctypes.c_void_p
    egl.eglGetProcAddress.argtypes = [ctypes.c_char_p]
    query_address = egl.eglGetProcAddress(b"eglQueryDevicesEXT")
    display_address = egl.eglGetProcAddress(b"eglGetPlatformDisplayEXT")
    if not query_address or not display_address:
        return False
    query = ctypes.CFUNCTYPE(
        ctypes.c_uint,
        ctypes.c_int,
        ctypes.POINTER(ctypes.c_void_p),
        ctypes.POINTER(ctypes.c_int),
    )(query_address)
    display_of = ctypes.CFUNCTYPE(
        ctypes.c_void_p, ctypes.c_uint, ctypes.c_void_p, ctypes.c_void_p
    )(display_address)
    egl.eglInitialize.argtypes = [ctypes.c_void_p] * 3
    egl.eglInitialize.restype = ctypes.c_uint
    devices = (ctypes.c_void_p * _MOST_DEVICES)()
    count = ctypes.c_int(0)
    if not query(_MOST_DEVICES, devices, ctypes.byref(count)):
        return False
    for device in devices[: count.value]:
        display = display_of(_EGL_PLATFORM_DEVICE, device, None)
        if display and egl.eglInitialize(display, None, None):
            return True
    return False


def _library(*names: str) -> ctypes.CDLL | None:
    for name in names:
        try:
            return ctypes.CDLL(name)
        except OSError:
            continue
    return None
