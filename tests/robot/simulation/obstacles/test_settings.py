import pytest

from memorymaze.basics.errors import SettingsError
from memorymaze.robot.simulation.obstacles import (
    LEVELS,
    ObstacleSettings,
    parse_obstacles,
)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        pytest.param("medium", ObstacleSettings(), id="a level"),
        pytest.param("light", ObstacleSettings(*LEVELS["light"]), id="another level"),
        pytest.param(
            "heavy,seed=3",
            ObstacleSettings(things_per_100m=8.0, people_per_100m2=2.0, seed=3),
            id="a level and a setting",
        ),
        pytest.param(
            "things=0, people=12,patience=4.5",
            ObstacleSettings(things_per_100m=0, people=12, patience=4.5),
            id="settings alone",
        ),
        pytest.param(
            "kinds=cart+suitcase,density=0",
            ObstacleSettings(kinds=("cart", "suitcase"), people_per_100m2=0),
            id="kinds",
        ),
    ],
)
def test_settings_are_read_from_text(text: str, expected: ObstacleSettings):
    assert parse_obstacles(text) == expected


@pytest.mark.parametrize(
    ("text", "named"),
    [
        ("huge", "light, medium, heavy"),
        ("seed=1,light", "'light'"),
        ("cars=3", "'cars=3'"),
        ("people=1.5", "people: expected a whole number"),
        ("things=-1", r"things \(things_per_100m\)"),
        ("density=nan", "density: expected a number"),
        ("density=51", "from 0 to 50"),
        ("things=101", "from 0 to 100"),
        ("people=100000", "from 0 to 1000"),
        ("seed=-1", "seed"),
        ("kinds=cart+tank", "'tank'"),
        ("havy", "did you mean 'heavy'"),
        ("seed=1,seed=2", "seed: given twice"),
        ("", "light, medium, heavy"),
    ],
)
def test_settings_without_meaning_are_refused_by_name(text: str, named: str):
    with pytest.raises(SettingsError, match=named):
        parse_obstacles(text)


def test_counts_follow_the_size_of_the_building():
    settings = ObstacleSettings(things_per_100m=4, people_per_100m2=1)

    assert settings.things_on(250.0) == 10
    assert settings.people_on(1400.0) == 14
    assert ObstacleSettings(people=3).people_on(1400.0) == 3
