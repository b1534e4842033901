"""Draw contact sheets: one picture of every category that the shipped plans name.

Each thing is seen from 3 m, or from where all of it is in the picture, a little from
its left, lit as in the simulated buildings. Needs OpenGL (`MUJOCO_GL=egl` or `osmesa`
without a screen).

    MUJOCO_GL=egl python scripts/contact_sheet.py --out docs/images
"""

import argparse
import math
from pathlib import Path

import mujoco
import numpy as np
from memorymaze.simulation.looks.catalogue import model_for_landmark, model_of
from memorymaze.simulation.looks.object_model import MeshPart, ObjectModel
from memorymaze.sites import load_sites
from memorymaze.sites.records import Landmark
from PIL import Image, ImageDraw

CELL = 220
"""Pixels of a picture's side."""
LABEL = 16
COLUMNS, ROWS = 8, 7
FIELD_OF_VIEW_DEG = 42.0
NEAREST = 3.0
"""Metres from the camera to the thing's front."""
AZIMUTH_DEG = -28.0
EYE_HEIGHT = 1.25
LIGHTS = (
    ((0, 0, -1), 0.42), ((0, 0, 1), 0.2), ((-1, 0.3, -0.5), 0.34),
    ((1, -0.3, -0.5), 0.24), ((0.3, 1, -0.5), 0.28), ((-0.3, -1, -0.5), 0.24),
)  # fmt: skip
EXTRAS = (
    ("mystery contraption", (1.0, 0.6, 1.2), "floor"),
    ("standing person", (0.55, 0.4, 1.72), "floor"),
    ("walking person", (0.55, 0.85, 1.72), "floor"),
    ("chair", (0.5, 0.55, 0.85), "floor"),
    ("stool", (0.4, 0.4, 0.5), "floor"),
    ("desk", (1.4, 0.7, 0.74), "floor"),
    ("cabinet", (1.0, 0.45, 1.9), "floor"),
    ("dinosaur skeleton", (4.0, 1.2, 2.4), "floor"),
    ("bicycle", (1.7, 0.55, 1.05), "floor"),
    ("car", (3.9, 1.7, 1.45), "floor"),
    ("suitcase", (0.45, 0.28, 1.05), "floor"),
    ("cardboard boxes", (0.6, 0.5, 0.8), "floor"),
    ("queue barrier", (1.8, 0.34, 0.95), "floor"),
    ("traffic cone", (0.36, 0.36, 0.7), "floor"),
    ("cart", (0.9, 0.5, 1.0), "floor"),
)
"""Things that no shipped plan has: left in the way, walking, or unknown."""


def main() -> None:
    """Draw all sheets and print their names."""
    parser = argparse.ArgumentParser(description="Draw contact sheets of all categories.")
    parser.add_argument("--out", type=Path, default=Path("docs/images"), metavar="DIR")
    parser.add_argument("--only", metavar="WORDS", help="categories that have this in their name")
    args = parser.parse_args()
    args.out.mkdir(parents=True, exist_ok=True)
    subjects = [each for each in _subjects() if (args.only or "") in each[0]]
    pictures = [_labelled(_picture(*each[1:]), each[0]) for each in subjects]
    step = COLUMNS * ROWS
    for number, start in enumerate(range(0, len(pictures), step), start=1):
        path = args.out / f"contact_sheet_{number}.png"
        _sheet(pictures[start : start + step]).save(path, optimize=True)
        print(path)


def _subjects() -> list[tuple[str, ObjectModel, float]]:
    """Return category, model and height over the floor, one of each category."""
    examples: dict[str, Landmark] = {}
    for site in load_sites(None).values():
        for thing in site.landmarks:
            known = examples.get(thing.category)
            if known is None or (known.text is None and thing.text):
                examples[thing.category] = thing
    found = [
        (category, model_for_landmark(thing), _bottom(thing.mount, thing.size[2], thing.obstacle))
        for category, thing in sorted(examples.items(), key=lambda each: each[0].lower())
    ]
    return found + [(category, model_of(category, size), 0.0) for category, size, _ in EXTRAS]


def _bottom(mount: str, height: float, obstacle: bool) -> float:
    if mount == "floor" or obstacle:
        return 0.0
    return 2.3 if mount == "ceiling" else max(0.1, 1.5 - height / 2)


def _picture(model: ObjectModel, bottom: float) -> Image.Image:
    spec = mujoco.MjSpec()
    spec.stat.extent = 1.0
    spec.visual.map.znear = 0.02
    spec.visual.map.zfar = 80.0
    spec.visual.headlight.ambient = [0.6, 0.6, 0.6]
    spec.visual.headlight.diffuse = [0.1, 0.1, 0.1]
    spec.visual.headlight.specular = [0.0, 0.0, 0.0]
    spec.visual.global_.offwidth = spec.visual.global_.offheight = 2 * CELL
    for direction, strength in LIGHTS:
        spec.worldbody.add_light(
            type=mujoco.mjtLightType.mjLIGHT_DIRECTIONAL,
            dir=direction,
            diffuse=[strength] * 3,
            specular=[0.1] * 3,
            castshadow=False,
        )
    spec.worldbody.add_geom(
        type=mujoco.mjtGeom.mjGEOM_PLANE, size=[30, 30, 1], rgba=[0.72, 0.7, 0.67, 1]
    )
    wall = model.bounds()[0][0] - 0.03
    spec.worldbody.add_geom(
        type=mujoco.mjtGeom.mjGEOM_BOX, size=[0.02, 30, 10], pos=[wall - 0.02, 0, 0], rgba=[0.88, 0.86, 0.82, 1]
    )
    for number, part in enumerate(model.parts):
        _add_part(spec, part, number, bottom)
    low, high = model.bounds()
    middle = np.array([high[0], 0.0, bottom + high[2] / 2])
    size = high - low
    reach = 0.5 * math.hypot(size[0] + size[1], size[2])
    away = max(NEAREST, reach * 1.12 / math.tan(math.radians(FIELD_OF_VIEW_DEG / 2)))
    turn = math.radians(AZIMUTH_DEG)
    eye = middle + away * np.array([math.cos(turn), -math.sin(turn), 0.0])
    eye[2] = max(EYE_HEIGHT, 0.35 * away) if middle[2] < 1.2 else EYE_HEIGHT
    # Zoomed in where the thing is small, so that the cell shows it as one looks at it.
    zoom = math.degrees(2 * math.atan(1.12 * reach / float(np.linalg.norm(eye - middle))))
    spec.worldbody.add_camera(
        name="eye",
        pos=eye.tolist(),
        fovy=min(FIELD_OF_VIEW_DEG, max(zoom, 10.0)),
        xyaxes=_looking(eye, middle),
    )
    compiled = spec.compile()
    data = mujoco.MjData(compiled)
    mujoco.mj_forward(compiled, data)
    with mujoco.Renderer(compiled, 2 * CELL, 2 * CELL) as renderer:
        renderer.update_scene(data, "eye")
        return Image.fromarray(renderer.render()).reduce(2)


def _looking(eye: np.ndarray, target: np.ndarray) -> list[float]:
    forward = (target - eye) / np.linalg.norm(target - eye)
    right = np.cross(forward, (0, 0, 1))
    right /= np.linalg.norm(right)
    return [*right, *np.cross(right, forward)]


def _add_part(spec: mujoco.MjSpec, part: MeshPart, number: int, bottom: float) -> None:
    name = f"part{number}"
    material = spec.add_material(
        name=name,
        rgba=part.material.rgba,
        emission=part.material.emission,
        shininess=part.material.shininess,
        specular=0.3 * part.material.shininess,
    )
    if part.material.texture is not None:
        height, width, channels = part.material.texture.shape
        spec.add_texture(
            name=name,
            type=mujoco.mjtTexture.mjTEXTURE_2D,
            width=width,
            height=height,
            nchannel=channels,
            data=part.material.texture.ravel(),
        )
        material.textures[mujoco.mjtTextureRole.mjTEXROLE_RGB] = name
    mesh = spec.add_mesh(
        name=name,
        uservert=part.vertices.ravel(),
        userface=part.faces.ravel(),
        inertia=mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL,
    )
    if part.normals is not None:
        mesh.usernormal = part.normals.ravel()
        mesh.userfacenormal = part.faces.ravel()
    if part.uv is not None:
        mesh.usertexcoord = part.uv.ravel()
        mesh.userfacetexcoord = part.faces.ravel()
    spec.worldbody.add_geom(
        type=mujoco.mjtGeom.mjGEOM_MESH,
        meshname=name,
        material=name,
        pos=[0, 0, bottom],
        contype=0,
        conaffinity=0,
    )


def _labelled(picture: Image.Image, words: str) -> Image.Image:
    cell = Image.new("RGB", (CELL, CELL + LABEL), (255, 255, 255))
    cell.paste(picture, (0, 0))
    ImageDraw.Draw(cell).text((4, CELL + 2), words, (0, 0, 0))
    return cell


def _sheet(pictures: list[Image.Image]) -> Image.Image:
    columns = min(COLUMNS, len(pictures))
    rows = math.ceil(len(pictures) / columns)
    sheet = Image.new("RGB", (columns * (CELL + 4), rows * (CELL + LABEL + 4)), (255, 255, 255))
    for place, picture in enumerate(pictures):
        column, row = place % columns, place // columns
        sheet.paste(picture, (column * (CELL + 4), row * (CELL + LABEL + 4)))
    return sheet


if __name__ == "__main__":
    main()
