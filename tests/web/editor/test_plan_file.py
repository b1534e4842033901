import json
from pathlib import Path
from typing import Any

import pytest

from memorymaze.basics.errors import MemoryMazeError
from memorymaze.web.editor.plan_file import (
    ChangedMeanwhile,
    Edited,
    PlanFile,
    TracedPicture,
)
from memorymaze.world.sites import find_site_problems


def edited(
    file: PlanFile, changed: dict[int, Any] | None = None, **members: Any
) -> Edited:
    """Return what a browser sends that changed some features, or members."""
    contents = file.contents()
    plan = contents["plan"]
    features: list[Any] = list(range(len(plan["features"])))
    for place, feature in (changed or {}).items():
        features[place : place + 1] = [feature]
    kept = {name: value for name, value in plan.items() if name != "features"}
    return Edited(base=contents["base"], members=kept | members, features=features)


def edited_from_nothing(file: PlanFile) -> Edited:
    base = file.contents()["base"]
    return Edited(base=base, members={"title": "Tower"}, features=[])


def bench(file: PlanFile) -> dict[str, Any]:
    return json.loads(json.dumps(file.contents()["plan"]["features"][5]))


def test_saving_without_a_change_writes_nothing(annex: Path) -> None:
    annex.write_bytes(b"\xef\xbb\xbf" + annex.read_bytes().replace(b"\n", b"\r\n"))
    before = annex.read_bytes()
    file = PlanFile(annex)
    file.save(edited(file))
    assert annex.read_bytes() == before


def test_one_changed_feature_of_a_saved_plan_is_one_changed_line(annex: Path) -> None:
    file = PlanFile(annex)
    file.save(edited(file, description="An annex, half \ud83d drawn."))
    before = annex.read_bytes().splitlines()
    moved = bench(file)
    moved["geometry"]["coordinates"][0] = 5.5
    file.save(edited(file, {5: moved}))
    after = annex.read_bytes().splitlines()
    [(_, changed)] = [
        each for each in zip(before, after, strict=True) if len({*each}) > 1
    ]
    assert json.loads(changed.rstrip(b",")) == moved


def test_whole_numbers_of_a_browser_are_no_change(annex: Path) -> None:
    annex.write_bytes(annex.read_bytes().replace(b": 2.8", b": 3.0"))
    before = annex.read_bytes()
    file = PlanFile(annex)
    bench_again = json.loads(json.dumps(bench(file)).replace(".0", ""))
    file.save(edited(file, {5: bench_again}, ceiling_height_m=3))
    assert annex.read_bytes() == before


def test_features_come_and_go_and_what_the_format_does_not_know_is_kept(
    annex: Path,
) -> None:
    annex.write_text(
        annex.read_text(encoding="utf-8").replace(
            '"kind": "room",', '"kind": "room", "floor_no": 3,'
        ),
        encoding="utf-8",
    )
    file = PlanFile(annex)
    new = bench(file) | {"id": "bench_2", "seen_by": ["ü"]}
    message = edited(file, {6: new}, survey={"by": "us"})
    file.save(message)
    plan = json.loads(annex.read_text(encoding="utf-8"))
    assert [each["id"] for each in plan["features"]][4:] == [
        "door_library",
        "bench",
        "bench_2",
    ]
    assert plan["features"][3]["properties"]["floor_no"] == 3
    assert plan["features"][6]["seen_by"] == ["ü"]
    assert plan["survey"] == {"by": "us"}


def test_what_is_not_saved_outlives_the_editor(annex: Path) -> None:
    file = PlanFile(annex)
    file.keep_draft(edited(file, title="Tower"))
    again = PlanFile(annex).contents()
    assert again["draft"]["title"] == "Tower"
    assert not again["is_old_draft"]
    assert again["plan"]["title"] == "Annex"


def test_nothing_stays_beside_the_plan_once_it_is_saved(annex: Path) -> None:
    file = PlanFile(annex)
    message = edited(file, title="Tower")
    file.keep_draft(message)
    file.save(message)
    assert list(annex.parent.iterdir()) == [annex]
    assert PlanFile(annex).contents()["plan"]["title"] == "Tower"


def test_where_the_picture_lies_is_kept_beside_the_plan(annex: Path) -> None:
    picture = TracedPicture(
        x=1.0, y=2.0, metres_per_pixel=0.1, turn_deg=5.0, opacity=0.5
    )
    PlanFile(annex).keep_picture(picture)
    assert PlanFile(annex).contents()["picture"] == picture.model_dump()


def test_a_window_that_began_with_another_state_is_told_so(annex: Path) -> None:
    file = PlanFile(annex)
    other = edited(file, title="Other window")
    file.save(edited(file, title="Tower"))
    with pytest.raises(ChangedMeanwhile, match="in another window"):
        file.save(other)


def test_a_file_that_is_not_there_begins_empty_and_is_written_when_saved(
    tmp_path: Path,
) -> None:
    path = tmp_path / "tower.geojson"
    file = PlanFile(path)
    assert not path.exists()
    file.save(edited(file))
    plan = json.loads(path.read_text(encoding="utf-8"))
    assert (plan["name"], plan["features"]) == ("tower", [])
    assert {
        each.rule for each in find_site_problems(path) if each.severity == "error"
    } == {
        "members",
        "floor-connected",
    }


def test_what_lacks_is_written_when_it_is_saved(tmp_path: Path) -> None:
    path = tmp_path / "tower.geojson"
    path.write_text("{}", encoding="utf-8")
    file = PlanFile(path)
    file.save(edited_from_nothing(file))
    plan = json.loads(path.read_text(encoding="utf-8"))
    assert plan == {"type": "FeatureCollection", "title": "Tower", "features": []}


@pytest.mark.parametrize(
    ("name", "text", "said"),
    [
        pytest.param(
            "a.geojson", "{", "correct it in a text editor first", id="no JSON"
        ),
        pytest.param("a.geojson", "[]", "at the top", id="a list"),
        pytest.param(
            "a.txt", "{}", r"expected a plan's file, \*\.geojson", id="a text"
        ),
    ],
)
def test_what_is_no_plan_is_refused_with_the_reason(
    tmp_path: Path, name: str, text: str, said: str
) -> None:
    (tmp_path / name).write_text(text, encoding="utf-8")
    with pytest.raises(MemoryMazeError, match=said):
        PlanFile(tmp_path / name)
