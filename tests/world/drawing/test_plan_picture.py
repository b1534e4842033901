import re
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from memorymaze.basics.errors import SettingsError
from memorymaze.basics.geometry.trajectory import TimedPose, Trajectory
from memorymaze.world.drawing.axes import lettering
from memorymaze.world.drawing.margin import draw_scale_and_north
from memorymaze.world.drawing.plan_picture import draw_site, draw_walk
from memorymaze.world.drawing.shapes import Met, ThingInTheWay
from memorymaze.world.sites import Site, load_site

SVG = "{http://www.w3.org/2000/svg}"


@pytest.fixture
def words(tmp_path: Path) -> Callable[..., list[str]]:
    """Draw a site as SVG and return the texts in it."""

    def drawn(site: Site, **options: object) -> list[str]:
        path = tmp_path / "drawn.svg"
        draw_site(site, path, **options)
        root = ElementTree.parse(path).getroot()
        return ["".join(text.itertext()).strip() for text in root.iter(f"{SVG}text")]

    return drawn


@pytest.mark.parametrize(
    ("suffix", "start"),
    [
        pytest.param(".png", b"\x89PNG", id="png"),
        pytest.param(".svg", b"<?xml", id="svg"),
        pytest.param(".pdf", b"%PDF", id="pdf"),
        pytest.param(".PNG", b"\x89PNG", id="capitals"),
    ],
)
def test_the_suffix_chooses_the_format(
    suffix: str, start: bytes, l_site: Site, tmp_path: Path
):
    path = tmp_path / f"floor{suffix}"
    draw_site(l_site, path)
    assert path.read_bytes().startswith(start)


def test_a_drawing_names_places_things_and_routes(
    t_site: Site, words: Callable[..., list[str]]
):
    found = " ".join(words(t_site))
    for name in (
        "A T junction",
        "Library",
        "Main Hallway",
        "chair",
        "clock",
        "sign: “Library",
        "R1: 20.00 m to the library",
        "R2: 20.00 m to the lift",
        "turning point with its exits",
        "glass door",
        "elevator door",
        "5 m",
        "N",
    ):
        assert name in found


@pytest.mark.parametrize("scale", [0.004, 0.03, 0.2, 0.25, 0.29, 0.31, 0.34, 0.36])
def test_the_scale_bar_is_as_long_as_it_says_and_whole(
    l_site: Site, scale: float
) -> None:
    figure = Figure(figsize=(9, 6))
    draw_scale_and_north(figure, l_site, scale)
    [corner] = figure.axes
    bars = [each for each in corner.patches if isinstance(each, Rectangle)]
    west = min(each.get_x() for each in bars)
    east = max(each.get_x() + each.get_width() for each in bars)
    said = [text.get_text() for text in corner.texts]
    assert f"{round((east - west) / scale)} m" in said
    assert (east - west) / scale == pytest.approx(round((east - west) / scale))
    assert corner.get_xlim()[0] < west
    assert east < corner.get_xlim()[1]


def test_a_vast_building_is_drawn_on_a_sheet_that_can_be_looked_at(
    enlarged: Callable[[float], Path], tmp_path: Path
):
    draw_site(load_site(enlarged(30)), tmp_path / "vast.svg")
    root = ElementTree.parse(tmp_path / "vast.svg").getroot()
    inches = float(root.attrib["height"].removesuffix("pt")) / 72
    assert 50 < inches < 65


def test_equal_things_beside_each_other_share_a_label(
    t_site: Site, words: Callable[..., list[str]]
):
    chair = next(thing for thing in t_site.landmarks if thing.id == "chair")
    chairs = tuple(replace(chair, id=f"chair_{number}") for number in range(3))
    found = words(replace(t_site, landmarks=chairs))
    assert "chair x3" in found
    assert "chair" not in found


def test_only_the_chosen_routes_are_drawn(
    loop_site: Site, words: Callable[..., list[str]]
):
    by_id = " ".join(words(loop_site, routes=["route_r1_alternative"]))
    assert "(alternative): 33.00 m" in by_id
    assert "15.00 m" not in by_id
    by_name = " ".join(words(loop_site, routes={"R1"}))
    assert "15.00 m" in by_name
    assert "33.00 m" in by_name
    assert "R1" not in " ".join(words(loop_site, routes=False))


def test_an_unknown_route_or_format_is_refused_before_anything_is_written(
    loop_site: Site, tmp_path: Path
):
    with pytest.raises(SettingsError, match=r"route_r1_alternative; got 'R7'"):
        draw_site(loop_site, tmp_path / "loop.png", routes=["R7"])
    with pytest.raises(SettingsError, match=r"\.png, \.svg, \.pdf, got '\.gif'"):
        draw_site(loop_site, tmp_path / "loop.gif")
    assert list(tmp_path.iterdir()) == []


def test_walks_are_drawn_on_top(l_site: Site, words: Callable[..., list[str]]):
    walk = Trajectory([TimedPose(0, 1, 0, 0), TimedPose(9, 10, 0.2, 0)])
    assert "walked" in words(l_site, trajectories=[walk])
    assert "walked" in words(l_site, trajectories=[[(1, 0), (9, 0)]])
    assert "walked" not in words(l_site)


def test_things_in_the_way_and_people_are_drawn_and_explained(
    l_site: Site, words: Callable[..., list[str]]
):
    met = Met(
        [ThingInTheWay("cart", 3.0, 0.2, 0.0, 0.9, 0.5)],
        [np.array([(1.0, 0.0), (6.0, 0.0), (9.0, 0.5)])],
        [(4.0, 0.0)],
    )
    drawn = words(l_site, met=met)
    assert "cart" in drawn
    assert {"left in the way", "person, from the dot on", "near miss"} <= set(drawn)
    assert "left in the way" not in words(l_site)


def test_the_picture_of_a_walk_shows_its_surroundings_and_what_came_of_it(
    builtin_sites: dict[str, Site], tmp_path: Path
):
    site = builtin_sites["university"]
    route = site.find_route("R1")
    path = tmp_path / "walk.svg"
    sheet = draw_walk(
        site,
        route,
        list(route.line.coords),
        instruction="Go  on\n to the library.",
        outcome="✔ ARRIVED",
        arrived=True,
    )
    with lettering(**{"svg.fonttype": "none"}):
        sheet.savefig(path)
    root = ElementTree.parse(path).getroot()
    texts = ["".join(text.itertext()).strip() for text in root.iter(f"{SVG}text")]
    assert {"“Go on to the library.”", "✔ ARRIVED", "Library"} <= set(texts)
    assert "GHI Lounge" not in " ".join(texts)
    inches = float(root.attrib["width"].removesuffix("pt")) / 72
    west, _, east, _ = site.walkable_floor.bounds
    assert inches < 0.2 * (east - west)


def test_a_walk_of_the_wrong_shape_is_refused(l_site: Site, tmp_path: Path):
    with pytest.raises(ValueError, match=r"shape \(N, 2\), got \(3,\)"):
        draw_site(l_site, tmp_path / "l.png", trajectories=[[1, 2, 3]])


def test_the_same_site_gives_the_same_drawing(t_site: Site, tmp_path: Path):
    contents = set()
    for number in range(2):
        path = tmp_path / f"{number}.svg"
        draw_site(t_site, path)
        contents.add(path.read_bytes())
    assert len(contents) == 1


def test_names_in_other_scripts_and_with_dollars_are_drawn_as_they_are(
    t_site: Site, tmp_path: Path, words: Callable[..., list[str]]
):
    odd = replace(t_site, title="図書館 $x^2$ <b>&", description="")
    assert "図書館 $x^2$ <b>&" in words(odd)
    draw_site(odd, tmp_path / "odd.png")
    assert (tmp_path / "odd.png").stat().st_size > 10_000


def test_labels_left_out_are_counted_on_the_drawing(
    corridor_site: Site, words: Callable[..., list[str]]
):
    [bench] = corridor_site.landmarks
    crowd = tuple(
        replace(bench, id=f"thing_{number}", category=f"thing number {number}")
        for number in range(120)
    )
    found = words(replace(corridor_site, landmarks=crowd))
    [left_out] = [text for text in found if "left out" in text]
    shown = sum(text.startswith("thing") and "number" in text for text in found)
    counted = re.match(r"(\d+) labels left out for want of room", left_out)
    assert counted is not None
    assert 0 < int(counted[1]) == 120 - shown


def test_a_plan_without_routes_rooms_or_things_is_drawn(
    corridor_site: Site, tmp_path: Path
):
    bare = replace(corridor_site, rooms=(), doors=(), landmarks=(), routes=())
    draw_site(bare, tmp_path / "bare.png")
    assert (tmp_path / "bare.png").exists()


def test_the_benchmarks_floors_are_drawn_with_nearly_all_labels(
    builtin_sites: dict[str, Site], words: Callable[..., list[str]]
):
    found = words(builtin_sites["museum_7f"])
    assert "Reception foyer" in " ".join(found)
    left_out = [text for text in found if "left out" in text]
    assert all(int(text.split()[0]) <= 12 for text in left_out)
