from dataclasses import replace
from xml.etree import ElementTree

from memorymaze.world.drawing.shapes import INKS
from memorymaze.world.drawing.svg import path_data, plan_frame, svg_plan
from memorymaze.world.sites import Site

SVG = "{http://www.w3.org/2000/svg}"


def words(site: Site) -> set[str]:
    root = ElementTree.fromstring(svg_plan(site))
    return {
        " ".join(row.text or "" for row in text) for text in root.iter(f"{SVG}text")
    }


def test_a_plan_names_places_things_and_signs(t_site: Site) -> None:
    assert {"Library", "Main Hallway", "chair"} <= words(t_site)
    assert any("“Library" in text for text in words(t_site))


def test_every_kind_has_a_colour_by_day_and_by_night(t_site: Site) -> None:
    text = svg_plan(t_site)
    assert "prefers-color-scheme:dark" in text
    for kind, ink in INKS.items():
        assert f"--{kind}:{ink.day}" in text
        assert f"--{kind}:{ink.night}" in text


def test_what_hangs_from_the_ceiling_does_not_cover_walks(t_site: Site) -> None:
    hanging = tuple(
        replace(thing, mount="ceiling", category="lamp") for thing in t_site.landmarks
    )
    assert "lamp" not in " ".join(words(replace(t_site, landmarks=hanging)))


def test_rooms_that_stand_aslant_have_their_names(
    builtin_sites: dict[str, Site],
) -> None:
    site = builtin_sites["university"]
    offices = {room.name for room in site.rooms if room.name.startswith("Office 230")}
    assert len(offices) > 3
    assert offices <= words(site)


def test_titles_of_any_kind_stay_texts(t_site: Site) -> None:
    title = "</style><script>alert(1)</script> & 図書館"
    root = ElementTree.fromstring(svg_plan(replace(t_site, title=title)))
    [found] = root.iter(f"{SVG}title")
    assert found.text == title


def test_the_frame_holds_floor_and_rooms_with_y_down(t_site: Site) -> None:
    frame = plan_frame(t_site)
    for west, south, east, north in (
        t_site.walkable_floor.bounds,
        *(room.polygon.bounds for room in t_site.rooms),
    ):
        assert frame.x < west < east < frame.x + frame.width
        assert frame.y < -north < -south < frame.y + frame.height


def test_lines_are_written_in_centimetres() -> None:
    assert path_data([(0, 0), (1.234, -5)]) == "M0 0L1.23 5"
    assert path_data([(0, 0), (1, 0), (1, 1), (0, 0)], closed=True) == "M0 0L1 0L1 -1Z"
