import itertools
import math
from collections import Counter
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from shapely import Point

from memorymaze.world.looks.assembly import MeshPart, ObjectModel
from memorymaze.world.looks.catalogue import (
    archetypes,
    model_for_landmark,
    model_of,
    models_of,
)
from memorymaze.world.looks.models import Order, model_of_kind
from memorymaze.world.looks.windows import WINDOWS, is_window
from memorymaze.world.sites import load_sites
from memorymaze.world.sites.records import Landmark

MOST_TRIANGLES = 1700
"""Of one thing; most have a few hundred."""
SIZES = {
    "thin": (1.2, 0.04, 0.8),
    "deep": (1.4, 3.5, 1.1),
    "small": (0.2, 0.1, 0.25),
}


@pytest.fixture(scope="module")
def landmarks() -> list[Landmark]:
    """One landmark of each look in the shipped plans; windows are looked at elsewhere."""
    unlike = {
        (each.category, each.size, each.color, each.text): each
        for site in load_sites(None).values()
        for each in site.landmarks
        if not is_window(each)
    }
    return list(unlike.values())


@pytest.fixture(scope="module")
def nodes() -> list[tuple[str, ObjectModel]]:
    """Every node of `things.glb` at its own size, and larger in all directions."""
    shown: list[tuple[str, ObjectModel]] = []
    for kind, group in models_of("own").items():
        for number, model in enumerate(group, start=1):
            for share in (1.0, 1.3):
                size = (share * model.mesh.size).tolist()
                order = Order(kind, *size, text="Words" if model.word_parts else None)
                shown.append((f"{kind}.{number}", model_of_kind([model], order)))
    return shown


def thing(category: str, **properties: object) -> Landmark:
    fields = {
        "id": "thing",
        "position": Point(0, 0),
        "category": category,
        "color": None,
        "name": None,
        "text": None,
        "heading": 0.0,
        "size": (0.8, 0.6, 1.1),
        "mount": "floor",
        "obstacle": True,
    }
    return Landmark(**(fields | properties))  # pyright: ignore[reportArgumentType]


def corners_of(part: MeshPart) -> np.ndarray:
    return part.vertices[part.faces].astype(float)


def test_models_fill_the_boxes_of_their_landmarks(landmarks: list[Landmark]):
    for landmark in landmarks:
        length, depth, height = landmark.size
        low, high = model_for_landmark(landmark).bounds()
        assert low == pytest.approx((-depth / 2, -length / 2, 0), abs=0.02), landmark
        assert high == pytest.approx((depth / 2, length / 2, height), abs=0.02)


def test_every_kind_has_a_model_and_every_model_is_of_a_kind():
    assert set(models_of("own")) == (set(archetypes()) - WINDOWS) | {"unknown"}


def test_all_kinds_are_told():
    page = Path("docs/seeing.md").read_text(encoding="utf-8")
    listed = page.partition("**Kinds** that can be shown:")[2].partition("\n\n")[0]
    kinds = {" ".join(each.split()) for each in listed.strip(" .\n").split(",")}
    assert kinds == set(archetypes()) - WINDOWS


def test_models_are_cheap(nodes: list[tuple[str, ObjectModel]]):
    counts = {name: model.triangle_count for name, model in nodes}
    assert max(counts.values()) <= MOST_TRIANGLES, max(counts, key=counts.__getitem__)


def test_surfaces_are_closed_and_face_outwards(nodes: list[tuple[str, ObjectModel]]):
    for name, model in nodes:
        for part in model.parts:
            assert_closed(part, name)


def assert_closed(part: MeshPart, what: str) -> None:
    places: dict[tuple[float, ...], int] = {}
    numbers = np.array([
        places.setdefault(tuple(point), len(places))
        for point in np.round(part.vertices.astype(float), 4).tolist()
    ])
    faces = numbers[part.faces]
    edges = Counter(
        (int(a), int(b))
        for first, second in ((0, 1), (1, 2), (2, 0))
        for a, b in zip(faces[:, first], faces[:, second], strict=True)
        if a != b
    )
    open_edges = [(a, b) for (a, b), count in edges.items() if edges[b, a] != count]
    assert not open_edges, what
    a, b, c = corners_of(part).transpose(1, 0, 2)
    volume = np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6
    assert volume > 0, what


def test_normals_are_unit_and_agree_with_their_faces(
    nodes: list[tuple[str, ObjectModel]],
):
    for name, model in nodes:
        for part in model.parts:
            assert part.normals is not None
            lengths = np.linalg.norm(part.normals, axis=1)
            assert lengths == pytest.approx(np.ones(len(lengths)), abs=1e-4)
            a, b, c = corners_of(part).transpose(1, 0, 2)
            across = np.cross(b - a, c - a)
            shown = part.normals[part.faces].mean(axis=1)
            turned = np.einsum("ij,ij->i", across, shown) < -1e-9
            assert not turned.any(), name


def test_no_face_lies_twice_in_one_place(nodes: list[tuple[str, ObjectModel]]):
    for name, model in nodes:
        for part in model.parts:
            seen = Counter(
                tuple(sorted(map(tuple, np.round(face, 4).tolist())))
                for face in corners_of(part)
            )
            assert max(seen.values()) == 1, name


def test_pictures_are_laid_on_within_their_bounds(landmarks: list[Landmark]):
    for landmark in landmarks:
        for part in model_for_landmark(landmark).parts:
            texture = part.material.texture
            assert (texture is None) == (part.uv is None)
            if texture is not None and part.uv is not None:
                assert part.uv.min() >= 0
                assert part.uv.max() <= 1
                assert texture.dtype == np.uint8
                assert max(texture.shape[:2]) <= 512


def test_equal_landmarks_share_one_model():
    assert model_for_landmark(thing("bench")) is model_for_landmark(thing("bench"))


def test_models_are_the_same_in_every_process():
    first = model_of("potted plant", (0.5, 0.5, 1.4), variant=2)
    model_of.cache_clear()
    second = model_of("potted plant", (0.5, 0.5, 1.4), variant=2)
    assert first is not second
    for one, other in zip(first.parts, second.parts, strict=True):
        assert np.array_equal(one.vertices, other.vertices)


def test_plants_differ_from_one_another():
    shapes = {
        model_for_landmark(thing("potted plant", id=f"plant_{number}")).triangle_count
        for number in range(12)
    }
    assert len(shapes) > 1


def test_an_unknown_category_gets_a_box_with_its_name_readable():
    model = model_of("flux capacitor", (1.0, 0.6, 1.2))
    named = model_of("time machine?", (1.0, 0.6, 1.2))
    assert pictures_of(model)
    assert not np.array_equal(pictures_of(model)[0], pictures_of(named)[0])


def pictures_of(model: ObjectModel) -> list[np.ndarray]:
    return [
        part.material.texture
        for part in model.parts
        if part.material.texture is not None
    ]


def test_words_of_the_plan_are_on_their_things(landmarks: list[Landmark]):
    for landmark in landmarks:
        if landmark.text:
            shown = model_for_landmark(landmark)
            other = model_for_landmark(replace(landmark, text="Qwertyuiop"))
            assert pixels_of(shown) != pixels_of(other), landmark


def pixels_of(model: ObjectModel) -> set[bytes]:
    return {picture.tobytes() for picture in pictures_of(model)}


def test_unknown_colours_give_the_usual_one():
    plain = model_of("sofa", (1.9, 0.85, 0.8))
    odd = model_of("sofa", (1.9, 0.85, 0.8), colour_words="heliotrope")
    assert [part.material.rgba for part in plain.parts] == [
        part.material.rgba for part in odd.parts
    ]


def test_colours_of_the_plan_are_shown():
    red = model_of("sofa", (1.9, 0.85, 0.8), colour_words="red")
    reddest = max(part.material.rgba[0] - part.material.rgba[1] for part in red.parts)
    assert reddest > 0.4


def test_a_sign_hangs_stands_or_lies_on_the_wall_as_it_is_mounted():
    size = (0.8, 0.5, 0.9)
    looks = {
        mount: model_of("sign", size, text="Cafe", mount=mount).triangle_count
        for mount in ("floor", "wall", "ceiling")
    }
    assert len(set(looks.values())) == 3


def back_of(model: ObjectModel) -> set[tuple[int, ...]]:
    """Colours that a thing shows to who stands behind it."""
    colours: set[tuple[int, ...]] = set()
    for part in model.parts:
        a, b, c = corners_of(part).transpose(1, 0, 2)
        behind = np.cross(b - a, c - a)[:, 0] < 0
        texture, uv = part.material.texture, part.uv
        if texture is not None and uv is not None and behind.any():
            shown = uv[part.faces[behind]].reshape(-1, 2)
            (left, top), (right, bottom) = shown.min(axis=0), shown.max(axis=0)
            high, wide = texture.shape[:2]
            rows = slice(int(top * (high - 1)), int(bottom * (high - 1)) + 1)
            columns = slice(int(left * (wide - 1)), int(right * (wide - 1)) + 1)
            colours |= set(map(tuple, texture[rows, columns].reshape(-1, 3).tolist()))
    return colours


@pytest.mark.parametrize("text", ["Cafe", "← Lifts   Reception →"])
def test_a_hanging_sign_has_something_on_its_back(text: str):
    sign = model_of("hanging sign", (1.6, 0.08, 0.5), text=text, mount="ceiling")
    assert len(back_of(sign)) > 1


def test_words_that_point_somewhere_are_not_on_the_back():
    size = (1.6, 0.08, 0.5)
    backs = [
        back_of(model_of("hanging sign", size, text=text, mount="ceiling"))
        for text in ("← Lifts   Reception →", "Exhibition →")
    ]
    assert backs[0] == backs[1]


def test_every_poster_and_screen_shows_another_picture():
    for category in ("poster", "information panel", "digital sign"):
        shown = [
            pixels_of(model_for_landmark(replace(thing(category), id=f"{n}")))
            for n in range(30)
        ]
        assert len({frozenset(each) for each in shown}) == len(shown), category


@pytest.mark.parametrize("archetype", sorted(archetypes()))
def test_archetypes_can_be_of_any_size(archetype: str):
    for size in SIZES.values():
        low, high = model_of(archetype, size).bounds()
        assert high - low == pytest.approx((size[1], size[0], size[2]), abs=1e-3)


@given(
    category=st.sampled_from(sorted(archetypes())),
    text=st.text(max_size=40),
    colour=st.none() | st.text(max_size=20),
    mount=st.sampled_from(["floor", "wall", "ceiling"]),
    variant=st.integers(0, 5),
)
def test_any_words_and_colours_can_be_built(category, text, colour, mount, variant):
    model = model_of(
        category,
        (1.1, 0.5, 1.3),
        colour_words=colour,
        text=text,
        mount=mount,
        variant=variant,
    )
    assert all(math.isfinite(x) for x in itertools.chain(*model.bounds().tolist()))
