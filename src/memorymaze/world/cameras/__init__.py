"""Pictures of a building: a scene for the eye, and cameras that draw it with OpenGL.

Holds no looks of single things, and nothing of how a robot moves. No OpenGL is loaded
until someone asks for a camera.
"""

from memorymaze.world.cameras.camera import CameraFrame, RenderedCamera
from memorymaze.world.cameras.visual_scene import (
    VisualScene,
    build_visual_scene,
)

__all__ = ["CameraFrame", "RenderedCamera", "VisualScene", "build_visual_scene"]
