import pytest

from memorymaze.world.construction.recipes import BUILDING_KINDS
from memorymaze.world.construction.vocabulary import vocabulary
from memorymaze.world.importing import imdf, osm
from memorymaze.world.sites import load_sites
from memorymaze.world.sites.things import (
    door_kinds,
    kind_of_thing,
    read_things,
    thing_kinds,
)


def test_every_category_of_the_shipped_plans_is_a_known_kind_of_thing():
    unknown = {
        each.category
        for site in load_sites(None).values()
        for each in site.landmarks
        if kind_of_thing(each.category) is None
    }
    assert not unknown


def test_what_importers_make_of_tags_is_in_the_table():
    assert {*osm.THINGS.values(), *imdf.THINGS.values()} <= thing_kinds().keys()
    assert {*osm.DOOR_KINDS.values(), *imdf.DOOR_KINDS.values()} <= door_kinds().keys()


def test_made_buildings_have_colours_for_all_their_things():
    for kind in BUILDING_KINDS:
        for program in vocabulary(kind).programs.values():
            for name in (*program.things, *program.furniture):
                assert thing_kinds()[name].colors, name


@pytest.mark.parametrize(
    ("category", "look"),
    [
        ("old wooden bench", "bench"),
        ("Bench", "bench"),
        ("snack vending machine", "vending machine"),
        ("laundry machine", "ticket machine"),
        ("gift shop sign", "sign"),
        ("laboratory table", "table"),
        ("statue of a bear", "statue"),
        ("benches", "bench"),
        ("bookshelves", "bookshelf"),
        ("coin_lockers", "coin lockers"),
        ("bay window", "window"),
        ("flux capacitor", None),
        ("", None),
    ],
)
def test_categories_are_known_by_their_head_noun(category: str, look: str | None):
    kind = kind_of_thing(category)
    assert (kind and kind.look) == look


def test_a_thing_may_be_called_and_measured_apart_from_what_it_looks_like():
    desk = kind_of_thing("reception desk")
    assert desk is not None
    assert desk.look == "counter"
    assert desk.size != thing_kinds()["counter"].size


PLAIN = 'size = [1, 1, 1], mount = "floor"'


@pytest.mark.parametrize(
    ("entries", "told"),
    [
        (
            'bench = { size = [1, 1], mount = "floor" }',
            "things.bench.size[2]: expected this member, got none; add it",
        ),
        (
            f'bench = {{ {PLAIN}, like = "seat" }}',
            "things.bench.like: expected a kind with a look of its own, got 'seat'",
        ),
        (
            f'pew = {{ {PLAIN} }}\nbench = {{ {PLAIN}, also = ["Pew"] }}',
            "things.bench: expected names of its own, got 'pew', which is pew",
        ),
    ],
)
def test_a_wrong_entry_is_told_with_file_and_name(entries: str, told: str):
    with pytest.raises(ValueError, match=r"things\.toml") as raised:
        read_things(f"[things]\n{entries}")
    assert str(raised.value) == f"things.toml: {told}"
