"""A building as Filament keeps it: its parts, its lights, and which parts are shown."""

from collections.abc import Generator
from contextlib import contextmanager
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from memorymaze.pictures.rendering.filament_engine import Engine
from memorymaze.pictures.rendering.visual_scene import CEILING, VisualScene

LIGHTS = """
<mujoco>
  <custom>
    <text name="filament.cg.tone_mapping" data="linear"/>
    <numeric name="filament.phong.emissive_multiplier" data="0.3"/>
  </custom>
  <asset>
    <texture name="around" type="cube" builtin="gradient" width="64" height="64"
             rgb1="1 1 1" rgb2="0.75 0.75 0.75"/>
  </asset>
  <worldbody>
    <light type="image" texture="around" intensity="22000"/>
    <light type="directional" dir="0.45 0.30 -0.80" intensity="11000"
           castshadow="false"/>
  </worldbody>
</mujoco>
"""
"""Light from all round, a bit more from above, and a lamp that tells sides apart. The
pools of light under lamps are painted already, so there are no lamps for them."""


class FilamentScene:
    """Everything of a `VisualScene` on the side of Filament."""

    def __init__(self, engine: Engine, looks: VisualScene, multisamples: int) -> None:
        """Copy a building; takes seconds."""
        library, context = engine.library, engine.context
        lights = mujoco.MjModel.from_xml_string(LIGHTS)
        lit = mujoco.MjData(lights)
        mujoco.mj_forward(lights, lit)
        drawn = context.create_scene(library.SceneParams())
        drawn.configure_from_model(lights)
        drawn.set_msaa(multisamples)
        light_resources = library.ModelResources(context, lights)
        model_lights = library.ModelLights(drawn, light_resources)
        model_lights.update(lit)
        with _model_for_filament(looks) as model:
            resources = library.ModelResources(context, model)
            renderables = library.ModelRenderables(drawn, resources)
            renderables.update(looks.data)
        geom = mujoco.mjtObj.mjOBJ_GEOM
        self._parts: list[Any] = [
            renderables.get_renderable(geom, number)
            for number in range(looks.model.ngeom)
        ]
        self._looks = looks
        self._shown = np.ones(looks.model.ngeom, dtype=np.bool_)
        self._moving = np.concatenate([
            *looks.movable_geoms.values(),
            np.arange(looks.first_sky, looks.model.ngeom),
        ]).astype(np.intp)
        self.handle: Any = drawn
        # In the order in which they must go: users before what they use.
        self._owned: list[Any] = [
            renderables,
            resources,
            model_lights,
            light_resources,
            drawn,
        ]

    def show(self, seen: NDArray[np.bool_], x: float, y: float, z: float) -> None:
        """Leave in the scene only what may be seen, where it is now."""
        for number in np.flatnonzero(seen & ~self._shown):
            self.handle.add_renderable(self._parts[number])
        for number in np.flatnonzero(self._shown & ~seen):
            self.handle.remove_renderable(self._parts[number])
        self._shown = seen
        self._looks.put_sky_around(x, y, z)
        data = self._looks.data
        for number in self._moving[seen[self._moving]]:
            place, turn = data.geom_xpos[number], data.geom_xmat[number]
            self._parts[number].set_pose(place, turn)

    def close(self) -> None:
        """Give back its memory."""
        self._parts.clear()
        self.handle = None
        while self._owned:
            del self._owned[0]


@contextmanager
def _model_for_filament(scene: VisualScene) -> Generator[Any]:
    """Let the model say what Filament wants to hear, while it reads it.

    It takes pictures for linear colours unless told otherwise, which bleaches them, and
    what shines for white: of what shines, only lamps do not suffer from it.
    """
    model: Any = scene.model
    spaces, glow = model.tex_colorspace.copy(), model.mat_emission.copy()
    lamps = model.geom_matid[scene.geom_objects == CEILING]
    try:
        model.tex_colorspace[:] = mujoco.mjtColorSpace.mjCOLORSPACE_SRGB
        model.mat_emission[:] = 0.0
        model.mat_emission[lamps] = glow[lamps]
        yield model
    finally:
        model.tex_colorspace[:], model.mat_emission[:] = spaces, glow
