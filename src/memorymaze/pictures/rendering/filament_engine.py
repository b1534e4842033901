"""The engine behind the quality mode: MuJoCo's Filament renderer, drawing by Vulkan.

No display is needed. Without a graphics card Mesa's lavapipe draws in software. Nothing
of it is loaded until someone asks for it.
"""

import ctypes
import importlib
import os
import sys
import tempfile
import threading
from collections.abc import Callable, Generator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

from memorymaze.errors import RenderingError

HOW_TO_INSTALL = (
    "on Debian and Ubuntu type: apt-get install mesa-vulkan-drivers libvulkan1 "
    "(or: bash scripts/setup_graphics.sh filament); the classic renderer needs neither"
)

_INSTANCE_CREATE_INFO = 1
_VULKAN_SUCCESS = 0


@dataclass(frozen=True)
class Engine:
    """Filament in this process; one at most, for each takes much memory."""

    library: Any
    """The module `mujoco.mjrf`, which brings no types."""
    context: Any
    process: int
    thread: int
    """The only one that may call it."""

    def check_owner(self) -> None:
        """Refuse calls that would crash it.

        Raises:
            RenderingError: It belongs to another thread or process.
        """
        if (self.process, self.thread) != (os.getpid(), threading.get_ident()):
            raise RenderingError(
                "cannot draw with Filament: expected the thread and process that first "
                "drew with it, got another one; start processes by the method 'spawn' "
                "and draw in one thread of each"
            )


def engine_of_this_process() -> Engine:
    """Return the engine; the first call starts it.

    Raises:
        RenderingError: Vulkan or MuJoCo's modules are missing, or it belongs to another
            thread.
    """
    engine = _started_engine()
    engine.check_owner()
    return engine


@lru_cache(maxsize=1)
def _started_engine() -> Engine:
    # Without Vulkan the engine would end the process instead of raising.
    check_vulkan()
    try:
        # It brings the engine's own files, without which the engine ends the process.
        importlib.import_module("mujoco.studio.window")
        library = importlib.import_module("mujoco.mjrf")
    except ImportError as error:
        raise RenderingError(
            f"cannot draw with Filament: {error}; expected the whole package mujoco, "
            "type: pip install --force-reinstall mujoco"
        ) from error
    config = library.ContextConfig()
    config.graphics_api = library.GraphicsApi.GRAPHICS_API_VULKAN
    with without_chatter():
        context = library.Context(config)
    return Engine(library, context, os.getpid(), threading.get_ident())


def check_vulkan() -> None:
    """Find out whether Vulkan has something to draw with.

    Raises:
        RenderingError: It has not; says what to install.
    """
    try:
        vulkan = ctypes.CDLL("libvulkan.so.1")
    except OSError as error:
        raise RenderingError(
            f"cannot draw with Filament: no Vulkan here ({error}); {HOW_TO_INSTALL}"
        ) from error
    if not _device_count(vulkan):
        raise RenderingError(
            "cannot draw with Filament: Vulkan has no driver for anything here; "
            + HOW_TO_INSTALL
        )


class _InstanceCreateInfo(ctypes.Structure):
    """`VkInstanceCreateInfo` of the Vulkan specification."""

    _fields_ = (
        ("kind", ctypes.c_int),
        ("next", ctypes.c_void_p),
        ("flags", ctypes.c_uint32),
        ("application", ctypes.c_void_p),
        ("layer_count", ctypes.c_uint32),
        ("layers", ctypes.c_void_p),
        ("extension_count", ctypes.c_uint32),
        ("extensions", ctypes.c_void_p),
    )


def _device_count(vulkan: ctypes.CDLL) -> int:
    """Return how many devices Vulkan can draw with."""
    wish = _InstanceCreateInfo(_INSTANCE_CREATE_INFO)
    instance, count = ctypes.c_void_p(), ctypes.c_uint32(0)
    made = vulkan.vkCreateInstance(ctypes.byref(wish), None, ctypes.byref(instance))
    if made != _VULKAN_SUCCESS:
        return 0
    found = vulkan.vkEnumeratePhysicalDevices(instance, ctypes.byref(count), None)
    vulkan.vkDestroyInstance(instance, None)
    return count.value if found == _VULKAN_SUCCESS else 0


@contextmanager
def without_chatter() -> Generator[None]:
    """Keep what the engine prints about itself away from a command's results.

    Raises:
        RenderingError: The engine failed; tells what it printed.
    """
    _flush()
    kept = os.dup(1), os.dup(2)
    with tempfile.TemporaryFile() as said:
        try:
            os.dup2(said.fileno(), 1)
            os.dup2(said.fileno(), 2)
            yield
        except (RuntimeError, ValueError) as error:
            said.seek(0)
            words = said.read()[-500:].decode(errors="replace").strip()
            raise RenderingError(
                f"cannot draw with Filament: {error}; it said: {words}"
            ) from error
        finally:
            _flush()
            for number, copy in enumerate(kept, start=1):
                os.dup2(copy, number)
                os.close(copy)


def _flush() -> None:
    streams: tuple[Callable[[], None], ...] = (sys.stdout.flush, sys.stderr.flush)
    for flush in streams:
        flush()
