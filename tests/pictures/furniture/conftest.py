"""A tiny furniture library, made here: nobody's models are part of the tests."""

import io
from pathlib import Path
from zipfile import ZipFile

import numpy as np
import pytest
from PIL import Image

CATALOGUE = """\
# PluginFurnitureCatalog.properties
id=tiny
id#1=tiny#cone
name#1=K\\u00e4gel
model#1=/tiny/cone/cone.obj
width#1=40.0
depth#1=40.0
height#1=70.0
creator#1=Ada Maker
id#2=tiny#table4
name#2=Table
model#2=/tiny/table4/table4.obj
width#2=140.0
depth#2=90.0
height#2=75.0
"""
BOX = """\
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
v 0 0 1
v 1 0 1
v 1 1 1
v 0 1 1
vt 0 0
vt 1 0
vt 1 1
vt 0 1
"""
SIDES = ("1 4 3 2", "5 6 7 8", "1 2 6 5", "3 4 8 7", "2 3 7 6", "1 5 8 4")


def box_twice(material: str, corners: str = BOX) -> str:
    """Return an OBJ file of a box whose faces lie twice, front and back."""
    lines = [f"mtllib looks.mtl\n{corners}usemtl {material}"]
    for side in SIDES:
        corners = [f"{v}/{t}" for t, v in enumerate(side.split(), start=1)]
        lines += [f"f {' '.join(corners)}", f"f {' '.join(reversed(corners))}"]
    return "\n".join(lines) + "\n"


@pytest.fixture
def library_folder(tmp_path: Path) -> Path:
    """A folder with one library of two pieces: a plain cone and a table with a picture."""
    picture = io.BytesIO()
    Image.fromarray(np.full((600, 300, 3), (200, 100, 50), dtype=np.uint8)).save(
        picture, "PNG"
    )
    folder = tmp_path / "libraries"
    folder.mkdir()
    with ZipFile(folder / "Scopia.sh3f", "w") as archive:
        archive.writestr("PluginFurnitureCatalog.properties", CATALOGUE)
        archive.writestr("tiny/cone/cone.obj", box_twice("plain"))
        archive.writestr("tiny/cone/looks.mtl", "newmtl plain\nKd 1.0 0.5 0.0\nd 1.0\n")
        archive.writestr("tiny/table4/table4.obj", box_twice("wood"))
        archive.writestr(
            "tiny/table4/looks.mtl", "newmtl wood\nKd 1 1 1\nmap_Kd wood.png\n"
        )
        archive.writestr("tiny/table4/wood.png", picture.getvalue())
    return folder


@pytest.fixture
def own_cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty cache of the user's."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    monkeypatch.delenv("MEMORYMAZE_CACHE")
    return tmp_path / "cache" / "memorymaze"
