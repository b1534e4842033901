"""The picture of docs/seeing.md: a site's own looks above, those of its mesh below."""

import math
import tempfile
from pathlib import Path

import numpy as np
from PIL import Image

from memorymaze.basics.geometry.pose import Pose
from memorymaze.world.cameras import RenderedCamera, build_visual_scene
from memorymaze.world.exporting import export_site
from memorymaze.world.sites import load_site

OUT = Path(__file__).parents[1] / "docs/images/mesh_looks.png"
COLOURS = 256
POSES = (Pose(7, 13, 0.0), Pose(30, 28, 0.0), Pose(58, 12, math.pi / 2))

with tempfile.TemporaryDirectory() as folder:
    own = load_site("university")
    mesh = Path(folder) / "university_mesh.glb"
    export_site(own, "gltf", mesh)
    plan = mesh.with_suffix(".geojson")
    plan.write_bytes(Path(own.source).read_bytes())
    rows = []
    for site, looks in ((own, "own"), (load_site(plan), "mesh")):
        scene = build_visual_scene(site, looks=looks)
        with RenderedCamera(
            scene, 400, 280, math.radians(80), multisamples=4
        ) as camera:
            rows.append(np.hstack([camera.picture(pose, 1.2) for pose in POSES]))
picture = Image.fromarray(np.vstack(rows)).quantize(COLOURS)
picture.save(OUT, optimize=True)
