import json
import math
from collections.abc import Callable

import pytest

from memorymaze.basics.errors import RunFolderError
from memorymaze.runs.episodes.results import (
    EpisodeResult,
    result_from_line,
    result_to_line,
)

Make = Callable[..., EpisodeResult]


def test_a_line_gives_back_the_result_it_was_made_of(result: Make) -> None:
    made = result(error='"quoted"\nleft \ud7ff 左', spd=1 / 3, stopped_by="crash")
    line = result_to_line(made)
    assert "\n" not in line
    assert result_from_line(line, "here") == made


@pytest.mark.parametrize("number", [math.nan, math.inf])
def test_a_number_that_is_not_finite_is_refused(result: Make, number: float) -> None:
    with pytest.raises(ValueError, match="Out of range"):
        result_to_line(result(spd=number))


@pytest.mark.parametrize(
    ("change", "field"),
    [
        pytest.param({"spd": "near"}, "spd", id="text for a number"),
        pytest.param({"stopped_by": "wind"}, "stopped_by", id="unknown ending"),
        pytest.param({"success": 1}, "success", id="number for a flag"),
        pytest.param({"site": None}, "site", id="nothing for a text"),
        pytest.param({"spd": math.nan}, "spd", id="not finite"),
    ],
)
def test_a_line_with_a_wrong_field_is_refused_with_its_place(
    result: Make, change: dict[str, object], field: str
) -> None:
    content = json.loads(result_to_line(result())) | change
    with pytest.raises(RunFolderError, match=rf"^episodes\.jsonl:7: .*{field}"):
        result_from_line(json.dumps(content), "episodes.jsonl:7")


@pytest.mark.parametrize(
    ("stopped_by", "gave_up", "success", "claims", "is_false"),
    [
        pytest.param("agent", False, True, True, False, id="there"),
        pytest.param("agent", False, False, True, True, id="elsewhere"),
        pytest.param("agent", True, False, False, False, id="gave up"),
        pytest.param("budget", False, False, False, False, id="cut off"),
    ],
)
def test_only_who_stops_without_giving_up_claims_to_be_there(
    result: Make,
    stopped_by: str,
    gave_up: bool,
    success: bool,
    claims: bool,
    is_false: bool,
) -> None:
    ended = result(stopped_by=stopped_by, gave_up=gave_up, success=success)
    assert (ended.claims_arrival, ended.is_false_arrival) == (claims, is_false)


def test_a_line_without_a_field_is_of_another_version(result: Make) -> None:
    content = json.loads(result_to_line(result()))
    del content["way_m"]
    with pytest.raises(
        RunFolderError, match=r"without way_m, made by another version.*run it again"
    ):
        result_from_line(json.dumps(content), "here")
