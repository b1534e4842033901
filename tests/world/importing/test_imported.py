import pytest

from memorymaze.basics.errors import SettingsError
from memorymaze.world.importing.imported import LocalFrame, chosen_floor


def test_a_minute_of_latitude_is_a_sea_mile():
    # The international sea mile, 1852 m, is that minute at 44.2 degrees.
    frame = LocalFrame(8.0, 44.2)
    assert frame.metres(8.0, 44.2 + 1 / 60) == (0.0, pytest.approx(1852, abs=0.5))


def test_a_degree_of_longitude_shrinks_towards_the_poles():
    east, north = LocalFrame(10.0, 60.0).metres(10.001, 60.0)
    assert (east, north) == (pytest.approx(55.80, abs=0.01), 0.0)


def test_a_frame_is_in_the_middle_of_what_it_is_around():
    places = [(10.0, 50.0), (10.002, 50.001), (10.001, 50.004)]
    assert LocalFrame.around(places) == LocalFrame(10.001, 50.001)


def test_a_frame_reaches_a_building_and_not_another_town():
    frame = LocalFrame.around([(10.0, 50.0), (10.001, 50.0), (0.0, 0.0)])
    assert frame.reaches([(10.0, 50.0), (10.001, 50.005)])
    assert not frame.reaches([(10.0, 50.0), (0.0, 0.0)])


@pytest.mark.parametrize("asked", ["2", "2F", " 2f "])
def test_a_floor_is_chosen_by_its_number_or_its_name(asked):
    assert chosen_floor({1.0: "1F", 2.0: "2F"}, asked, "f") == 2.0


def test_the_names_of_floors_come_before_their_numbers():
    assert chosen_floor({0.0: "-1", 1.0: "0", 2.0: "1"}, "0", "f") == 1.0


def test_the_only_floor_need_not_be_asked_for():
    assert chosen_floor({0.0: "G"}, None, "f") == 0.0


@pytest.mark.parametrize("asked", [None, "7F"])
def test_a_floor_that_is_not_clear_is_an_error_that_lists_them(asked):
    with pytest.raises(SettingsError, match="1F, 2F"):
        chosen_floor({1.0: "1F", 2.0: "2F"}, asked, "f")
