import numpy as np
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st

from memorymaze.pictures.furniture.mesh_cleaning import (
    MaterialSurface,
    cleaned,
    finished,
    thinned,
)


def ball(rings: int) -> MaterialSurface:
    mesh = trimesh.creation.uv_sphere(count=[rings, rings])
    return cleaned(MaterialSurface(np.array(mesh.vertices), np.array(mesh.faces)))


def volume(vertices: np.ndarray, faces: np.ndarray) -> float:
    a, b, c = (vertices[faces[:, corner]] for corner in range(3))
    return float(np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6)


@given(st.lists(st.booleans(), min_size=12, max_size=12))
@settings(max_examples=25)
def test_a_closed_body_faces_outward_however_its_faces_were_wound(
    turned: list[bool],
) -> None:
    box = trimesh.creation.box()
    faces = np.array(box.faces)
    mixed = np.where(np.array(turned)[:, None], faces[:, ::-1], faces)
    once = cleaned(
        MaterialSurface(np.array(box.vertices), np.concatenate([mixed, mixed]))
    )
    vertices, faces, normals, _ = finished(once)
    assert len(faces) == 12
    assert np.isclose(volume(vertices, faces), 1.0)
    # A box has edges: its normals stand along the axes.
    assert np.allclose(np.abs(normals).max(axis=1), 1.0)
    assert np.einsum("ij,ij->i", normals, vertices).min() > 0.4


def test_an_open_surface_is_seen_from_both_sides() -> None:
    square = MaterialSurface(
        np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], dtype=float),
        np.array([[0, 1, 2], [0, 2, 3]]),
    )
    _, faces, normals, _ = finished(square)
    assert len(faces) == 4
    assert sorted(normals[:, 2].round(6).tolist()) == [-1] * 4 + [1] * 4


def test_a_round_body_keeps_its_shape_with_a_tenth_of_its_faces() -> None:
    before = ball(80)
    after = thinned(before, len(before.faces) // 10, np.random.default_rng(0))
    assert len(after.faces) <= len(before.faces) // 10
    vertices, faces, normals, _ = finished(after)
    assert volume(vertices, faces) > 0.95 * 4 / 3 * np.pi
    outward = vertices / np.linalg.norm(vertices, axis=1, keepdims=True)
    assert np.quantile(np.einsum("ij,ij->i", normals, outward), 0.05) > 0.95


def test_foliage_loses_leaves_and_stays_as_large() -> None:
    rng = np.random.default_rng(1)
    middles = rng.uniform(-1, 1, (500, 1, 3))
    leaf = np.array([[0, 0, 0], [0.05, 0, 0], [0, 0.05, 0.02]])
    vertices = (middles + leaf).reshape(-1, 3)
    leaves = MaterialSurface(vertices, np.arange(1500).reshape(-1, 3))
    after = thinned(leaves, 100, np.random.default_rng(0))
    assert 60 <= len(after.faces) <= 140
    left = after.vertices[np.unique(after.faces)]
    assert np.all(np.ptp(left, axis=0) > 0.9 * np.ptp(vertices, axis=0))
    assert np.all(left.min(axis=0) >= vertices.min(axis=0))
