"""Labels of two people, from the plan to the exported corpus."""

import csv
import re
import time
from collections.abc import Callable, Generator
from pathlib import Path
from typing import Any

import httpx2
import pytest

from memorymaze.basics.errors import StudyError
from memorymaze.texts.corpus import load_instructions
from memorymaze.texts.corpus.records import Failure
from memorymaze.web.studies.exporting import export_study
from memorymaze.web.studies.interviews.records import InterviewRecord, Interviews
from memorymaze.web.studies.labels.marking import points_crossed, read_marks
from memorymaze.web.studies.schedule import StudyStep
from memorymaze.web.studies.serving import serving_study
from memorymaze.web.studies.store import Store, open_store
from memorymaze.web.studies.study_file import Study
from memorymaze.world.sites import Site

MakeStudy = Callable[..., Study]
WHO = "p0123456789"
MISTAKE = {
    "kind.0": "wrong_direction_at_turn",
    "where.0": "tp_junction",
    "detail.0": "right, should be left",
}


def interview(store: Store, who: str = WHO, **texts: str) -> None:
    """Keep a whole interview; texts by step, as `tell_R1`."""
    told = {
        f"{kind}.{route}": texts.get(f"{kind}_{route}", f"Left, {route}, {kind}.")
        for route in ("R1", "R2")
        for kind in ("tell", "retell")
    }
    interviews, now = Interviews(store), time.time()
    records = [
        InterviewRecord(f"{who}-{n:03}", who, StudyStep(step), now - 9, now)
        for n, step in enumerate(["consent", "familiarity.R1", *told, "done"])
    ]
    assert interviews.begin(records[0], "R1, R2", "I agree") == "kept"
    for record in records[1:]:
        state = "complete" if record.step == "done" else "active"
        interviews.take(record, told.get(record.step, "Yes"), state=state)


class Labeller:
    """Somebody who labels on the experimenter's pages."""

    def __init__(self, store: Store, entrance: str) -> None:
        self.store = store
        server = entrance.partition("/enter/")[0]
        self.client = httpx2.Client(base_url=server, follow_redirects=True)
        self.client.get(entrance)

    def label(
        self, step: str, name: str, way: str = "route_r1_reference", **fields: str
    ) -> str:
        address = f"/labels/{WHO}/{step}"
        page = self.client.get(address, params={"name": name}).text
        found = re.search(r'csrf-token" content="(\w+)"', page)
        assert found, page
        sent = {"csrf_token": found[1], "name": name, "way": way} | fields
        return self.client.post(address, data=sent).text

    def page(self) -> str:
        return self.client.get("/labels").text


@pytest.fixture
def labeller(make_study: MakeStudy) -> Generator[Labeller]:
    study = make_study("onsite")
    with open_store(study) as store, serving_study(store) as addresses:
        interview(store)
        labeller = Labeller(store, addresses.experimenter)
        yield labeller
        labeller.client.close()


def exported(
    labeller: Labeller, folder: Path
) -> tuple[dict[str, Any], list[dict[str, str]]]:
    out = folder / "out.jsonl"
    export_study(labeller.store.study, labeller.store, out)
    told = {each.id: each for each in load_instructions([out])}
    text = out.with_suffix(".csv").read_text(encoding="utf-8-sig")
    return told, list(csv.DictReader(text.splitlines()))


def test_what_two_people_say_alike_is_exported_and_one_alone_is_not(
    labeller: Labeller, tmp_path: Path
) -> None:
    assert "two annotators or more, got those of nobody" in labeller.page()
    labeller.label("tell.R1", "Ada", **MISTAKE)
    labeller.label("tell.R1", "Bo", **MISTAKE)
    labeller.label("retell.R1", "Ada", **MISTAKE)
    assert "1 of 4 texts are settled" in labeller.page()
    told, rows = exported(labeller, tmp_path)
    failure = Failure("wrong_direction_at_turn", "tp_junction", "right, should be left")
    assert told[f"{WHO}-r1-1"].failures == (failure,)
    assert told[f"{WHO}-r1-1"].study == "onsite"
    assert told[f"{WHO}-r1-2"].failures == ()
    assert [row["errors_labelled"] for row in rows] == ["1", "", "", ""]
    assert rows[0]["way_told"] == "route_r1_reference"


def test_where_they_differ_is_shown_and_settled_together(
    labeller: Labeller, tmp_path: Path
) -> None:
    labeller.label("tell.R1", "Ada", **MISTAKE)
    labeller.label("tell.R1", "Bo")
    page = labeller.page()
    assert "Where they differ" in page
    assert "has a failure: yes (1), no (1)" in page
    assert "kappa" in page
    shown = labeller.client.get(f"/labels/{WHO}/tell.R1", params={"settle": "yes"}).text
    assert (
        "<strong>Ada</strong>: way route_r1_reference, wrong direction at turn at"
        in shown
    )
    assert "Bo" in shown
    told, _ = exported(labeller, tmp_path)
    assert told[f"{WHO}-r1-1"].failures == ()
    labeller.label("tell.R1", "Ada and Bo", settle="yes", **MISTAKE)
    page = labeller.page()
    assert "Where they differ" not in page
    assert "settled by Ada and Bo" in page
    told, _ = exported(labeller, tmp_path)
    assert len(told[f"{WHO}-r1-1"].failures) == 1


def test_nobody_sees_what_the_other_said_before_labelling(labeller: Labeller) -> None:
    labeller.label("tell.R1", "Ada", **MISTAKE)
    page = labeller.client.get(f"/labels/{WHO}/tell.R1", params={"name": "Bo"}).text
    assert "right, should be left" not in page
    page = labeller.client.get(f"/labels/{WHO}/tell.R1", params={"name": "Ada"}).text
    assert "right, should be left" in page


def test_another_way_by_places_is_settled_and_told_in_the_table(
    labeller: Labeller, tmp_path: Path
) -> None:
    for name in ("Ada", "Bo"):
        labeller.label("tell.R1", name, way="none", places="3, 2 4")
    assert "1 of 4 texts are settled" in labeller.page()
    _, rows = exported(labeller, tmp_path)
    assert rows[0]["way_told"] == "tp_south_end > tp_junction > tp_east_end"
    labeller.label("tell.R1", "Bo", way="none", places="3 2")
    assert "0 of 4 texts are settled" in labeller.page()


def test_a_label_of_a_text_that_was_corrected_since_counts_no_more(
    labeller: Labeller, tmp_path: Path
) -> None:
    for name in ("Ada", "Bo"):
        labeller.label("tell.R1", name, **MISTAKE)
    page = labeller.client.get(f"/transcripts/{WHO}/tell.R1").text
    token = page.partition('csrf-token" content="')[2][:64]
    sent = {"csrf_token": token, "name": "Ada", "text": "Right at the end."}
    labeller.client.post(f"/transcripts/{WHO}/tell.R1", data=sent)
    assert "0 of 4 texts are settled" in labeller.page()
    told, _ = exported(labeller, tmp_path)
    assert told[f"{WHO}-r1-1"].text == "Right at the end."
    assert told[f"{WHO}-r1-1"].original_text == "Left, R1, tell."
    assert told[f"{WHO}-r1-1"].failures == ()


def test_a_wrong_label_is_sent_back_with_what_was_marked(labeller: Labeller) -> None:
    page = labeller.label("tell.R1", "Ada", **(MISTAKE | {"where.0": ""}))
    assert "error 1: expected a place or thing of the plan, got none" in page
    assert "right, should be left" in page


def test_whose_recordings_are_not_written_down_is_left_out_and_counted(
    labeller: Labeller, tmp_path: Path
) -> None:
    interview(labeller.store, "p00000000ff", tell_R1="")
    done = export_study(labeller.store.study, labeller.store, tmp_path / "x.jsonl")
    assert (done.participants, done.unwritten, done.instructions) == (1, 1, 4)
    labeller.store.withdraw(WHO)
    with pytest.raises(StudyError, match="all came and are written down"):
        export_study(labeller.store.study, labeller.store, tmp_path / "y.jsonl")


def test_places_of_a_way_of_the_plan_mean_that_way(t_site: Site) -> None:
    assert points_crossed(t_site, t_site.find_route("R1")) == (
        "tp_south_end",
        "tp_junction",
        "tp_west_end",
    )
    for places in ("3 2 1", "2"):
        marks = read_marks({"way": "none", "places": places}, t_site, "R1")
        assert marks.way == "route_r1_reference"
        assert marks.places == ()
    assert read_marks({"way": "none"}, t_site, "R1").way == "none"
