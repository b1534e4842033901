"""Which renderer draws pictures: the classic one, or Filament for quality."""

import os
from typing import Literal

from memorymaze.errors import SettingsError
from memorymaze.pictures.rendering.camera import RenderedCamera
from memorymaze.pictures.rendering.filament import FilamentCamera
from memorymaze.pictures.rendering.visual_scene import VisualScene

Renderer = Literal["classic", "filament"]

RENDERERS: tuple[Renderer, ...] = ("classic", "filament")

VARIABLE = "MEMORYMAZE_RENDERER"


def wanted_renderer() -> Renderer:
    """Return what the environment asks for: `MEMORYMAZE_RENDERER`, else `classic`.

    Raises:
        SettingsError: There is no renderer of that name.
    """
    name = os.environ.get(VARIABLE, "").strip().lower() or "classic"
    for each in RENDERERS:
        if name == each:
            return each
    raise SettingsError(
        f"{VARIABLE}: expected one of {', '.join(RENDERERS)}, got {name!r}"
    )


def open_camera(
    renderer: Renderer,
    scene: VisualScene,
    size: tuple[int, int],
    horizontal_fov: float,
    multisamples: int = 0,
) -> RenderedCamera | FilamentCamera:
    """Open a camera of a renderer.

    Args:
        renderer: Draws the colours.
        scene: The building.
        size: Width and height, pixels.
        horizontal_fov: Radians.
        multisamples: Samples per pixel that smooth edges.

    Raises:
        SettingsError: A setting has no meaning.
        RenderingError: This machine cannot draw so; says what to install.
    """
    camera = FilamentCamera if renderer == "filament" else RenderedCamera
    return camera(scene, *size, horizontal_fov, multisamples=multisamples)
