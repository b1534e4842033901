from dataclasses import replace

import pytest

from memorymaze.basics.errors import SettingsError
from memorymaze.testing import check_site
from memorymaze.world.importing.reference_route import reference_route


@pytest.fixture
def routed(tmp_path):
    """Add a route to a site without routes, and see that an oracle walks it."""

    def add(site, start, goal):
        route = reference_route(replace(site, routes=()), start, goal)
        path = tmp_path / "routed.geojson"
        replace(site, name="routed", routes=(route,)).save(path)
        check_site(path)
        return route

    return add


def test_a_route_turns_where_middle_lines_meet(l_site, routed):
    route = routed(l_site, "1,0.4", l_site.doors[0].id)
    assert [turn.direction for turn in route.turns] == ["left"]
    assert list(route.line.coords[:2]) == [(1.0, 0.0), (11.0, 0.0)]


@pytest.mark.proof
def test_a_route_goes_to_things_in_the_open(builtin_sites, routed):
    route = routed(builtin_sites["museum_7f"], "d_men", "lm_piano")
    assert route.goal_landmark == "lm_piano"
    assert route.turns


def test_goals_have_the_names_that_people_know(t_site):
    made = reference_route(t_site, "0,-8", "library")
    assert made.goal == "Library"


def test_the_next_route_has_the_next_number(l_site):
    names = {route.route for route in l_site.routes}
    made = reference_route(l_site, "1,0", l_site.doors[0].id)
    assert made.route not in names


@pytest.mark.parametrize(
    ("start", "goal", "message"),
    [
        pytest.param("1,0", "the mooon", "route to 'the mooon': expected x,y or the id", id="unknown"),
        pytest.param("99,99", "door", "m off it", id="off the floor"),
        pytest.param("1,0", "1,0.1", "room, door or thing within 4 m", id="nothing there"),
        pytest.param("1..2,0", "1,0", "expected x,y in metres", id="no numbers"),
    ],
)  # fmt: skip
def test_what_is_no_route_is_told(start, goal, message, l_site):
    with pytest.raises(SettingsError, match=message):
        reference_route(l_site, start, goal)


def test_of_several_rooms_of_one_name_the_route_asks_for_an_id(t_site):
    rooms = tuple(replace(each, name="Restroom") for each in t_site.rooms)
    site = replace(t_site, rooms=rooms)
    with pytest.raises(SettingsError, match="got room_library, room_lift; give the id"):
        reference_route(site, "0,-8", "restroom")
    assert reference_route(site, "0,-8", "room_lift").goal_landmark == "room_lift"


def test_two_places_that_obstacles_part_are_told(corridor_site):
    wall = replace(corridor_site.landmarks[0], size=(0.5, 9.0, 1.0), heading=1.5707963)
    with pytest.raises(SettingsError, match=r"got none that keeps 0\.45 m"):
        reference_route(
            replace(corridor_site, landmarks=(wall,)),
            corridor_site.doors[0].id,
            corridor_site.doors[3].id,
        )
