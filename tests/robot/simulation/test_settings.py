from typing import Any

import pytest

from memorymaze.basics.errors import SettingsError
from memorymaze.robot.simulation.settings import SimulationSettings


@pytest.mark.parametrize(
    "wrong",
    [
        {"max_speed": 0},
        {"max_speed": float("nan")},
        {"max_acceleration": float("inf")},
        {"time_budget": "10"},
        {"call_budget": 10.5},
        {"stuck_limit": True},
        {"control_period": 0.055},
        {"rolling_speed": 2.0},
        {"wheel_noise": -0.1},
        {"turning_points": "radar"},
        {"motion": "gliding"},
    ],
    ids=lambda wrong: next(iter(wrong)),
)
def test_settings_without_meaning_are_named(wrong: dict[str, Any]) -> None:
    with pytest.raises(SettingsError, match=next(iter(wrong))):
        SimulationSettings(**wrong)
