"""Participants without scripts, over real connections."""

import re
import time
from collections.abc import Callable
from typing import Any

import pytest

from memorymaze.web.serving.web import FORM_KEY
from memorymaze.web.studies.study_file import Study

from .conftest import Served, Visitor

MakeStudy = Callable[..., Study]
ServeStudy = Callable[[Study], Any]
WAY = "Go straight on to the end of the corridor and then turn left at the junction."


def test_somebody_goes_from_consent_to_the_code(served: Served, one: Visitor) -> None:
    one.reach_first_way()
    for telling in range(4):
        assert "once more" in one.page if telling % 2 else "Way" in one.page
        if telling % 2:
            assert f"<blockquote>{WAY} ({telling - 1})</blockquote>" in one.page
            assert "What the robot can do" in one.page
        one.send(text=f"{WAY} ({telling})")
        if "A short question" in one.page:
            one.send(answer_0="1")
    assert "Thank you!" in one.page
    assert "THANKYOU" in one.page
    [who] = served.store.participants()
    assert who.state == "complete"
    answers = served.store.answers(who.id)
    first, second = who.order
    assert list(answers) == [
        "comprehension",
        "familiarity",
        "scenario",
        f"tell.{first}",
        f"retell.{first}",
        "attention.0",
        f"tell.{second}",
        f"retell.{second}",
    ]
    robot = served.store.study.design.robot
    assert answers[f"retell.{first}"].shown == robot
    assert answers["attention.0"].text == "A cat"


def test_nothing_is_stored_before_consent(served: Served, one: Visitor) -> None:
    one.get("/?PROLIFIC_PID=5f00")
    refused = one.post("/consent", consent_0="on", id_PROLIFIC_PID="5f00")
    assert refused.status_code == 400
    assert "tick every box" in one.page
    assert served.store.participants() == []
    one.consent("?PROLIFIC_PID=5f00&OTHER=x")
    [who] = served.store.participants()
    assert served.store.platform_ids(who.id) == {"PROLIFIC_PID": "5f00"}


def test_who_comes_twice_with_an_id_is_sent_to_the_first_browser(
    served: Served,
) -> None:
    served.browse().consent("?PROLIFIC_PID=5f00")
    again = served.browse()
    again.consent("?PROLIFIC_PID=5f00")
    assert "You have been here before" in again.page
    assert len(served.store.participants()) == 1


@pytest.mark.parametrize("query", ["?PROLIFIC_PID=5f00", ""])
def test_a_consent_sent_twice_begins_once(
    served: Served, one: Visitor, query: str
) -> None:
    one.get(f"/{query}")
    form = one.page
    one.consent(query)
    first = one.client.cookies
    one.client.cookies = {FORM_KEY: first[FORM_KEY]}
    one.page = form
    ids = {"id.PROLIFIC_PID": "5f00"} if query else {}
    one.post("/consent", **ids, **{f"consent.{number}": "on" for number in range(3)})
    assert "Have we been clear?" in one.page
    assert dict(one.client.cookies) == dict(first)
    assert len(served.store.participants()) == 1


def test_who_knows_the_place_is_thanked_and_let_go(
    served: Served, one: Visitor
) -> None:
    one.consent()
    one.send(answer_0="1", answer_1="0")
    one.send(answer_0="2")
    assert "Thank you for your interest" in one.page
    assert "NOTTHISTIME" in one.page
    [who] = served.store.participants()
    assert (who.state, who.reason) == ("excluded", "familiarity")
    assert "Thank you for your interest" in one.get("/study")


def test_the_comprehension_check_has_so_many_attempts(
    make_study: MakeStudy, serve_study: ServeStudy
) -> None:
    with serve_study(make_study("online", "attempts = 2")) as served:
        one = served.browse()
        one.consent()
        one.send(answer_0="0", answer_1="0")
        assert "Not all answers were right" in one.page
        assert 'value="0" required checked' in one.page
        one.send(answer_0="0", answer_1="1")
        assert "Your answers are not used" in one.page
        [who] = served.store.participants()
        assert who.reason == "comprehension"


def test_the_same_wrong_answers_sent_twice_are_one_attempt(
    make_study: MakeStudy, serve_study: ServeStudy
) -> None:
    with serve_study(make_study("online", "attempts = 2")) as served:
        one = served.browse()
        one.consent()
        for _ in range(3):
            one.post("/study/comprehension", attempt="0", answer_0="0", answer_1="0")
            assert "Not all answers were right" in one.page
        [who] = served.store.participants()
        assert who.state == "active"
        # Nor are answers tried out from a page of before.
        one.post("/study/comprehension", attempt="0", answer_0="1", answer_1="0")
        assert "Not all answers were right" in one.page
        one.send(answer_0="1", answer_1="0")
        assert "Do you know the place?" in one.page


def test_who_comes_when_all_places_are_taken_is_told_and_not_stored(
    make_study: MakeStudy, serve_study: ServeStudy
) -> None:
    with serve_study(make_study("online", "quota = 1")) as served:
        for _ in range(2):
            served.browse().consent()
        late = served.browse()
        late.consent()
        assert "No place is left" in late.page
        assert len(served.store.participants()) == 2


def test_a_short_description_is_sent_back_and_kept(one: Visitor) -> None:
    one.reach_first_way()
    refused = one.send(text="Go left.")
    assert refused.status_code == 400
    assert "at least 10 words" in one.page
    assert "Go left.</textarea>" in one.get("/study")


def test_a_draft_is_there_when_somebody_comes_back(
    make_study: MakeStudy, serve_study: ServeStudy
) -> None:
    study = make_study()
    with serve_study(study) as served:
        one = served.browse()
        one.reach_first_way()
        [draft] = re.findall(r'formaction="([^"]+)"', one.page)
        one.post(draft, text="Go to the\r\n<b>blue</b> door")
        assert "Kept. You may close this page" in one.page
        cookies = dict(one.client.cookies)
    with serve_study(study) as served:
        back = served.browse()
        back.client.cookies.update(cookies)
        assert "Go to the\n&lt;b&gt;blue&lt;/b&gt; door</textarea>" in back.get("/")


def test_a_draft_of_what_was_sent_already_is_refused_and_said(one: Visitor) -> None:
    one.reach_first_way()
    [draft] = re.findall(r'formaction="([^"]+)"', one.page)
    one.send(text=WAY)
    assert one.post(draft, text="Something else", quiet="1").status_code == 409
    one.post(draft, text="Something else")
    assert "was sent already and cannot be changed" in one.page
    assert "Kept." not in one.page


def test_a_page_sent_twice_counts_once(served: Served, one: Visitor) -> None:
    one.reach_first_way()
    [first] = re.findall(r'action="(/study/tell[^"]+)"', one.page)
    one.send(text=WAY)
    one.post(first, text=WAY + " And something else.")
    assert "once more" in one.page
    [who] = served.store.participants()
    key = first.removeprefix("/study/")
    assert served.store.answers(who.id)[key].text == WAY


def test_a_video_is_there_for_who_describes_its_way_and_for_nobody_else(
    served: Served, one: Visitor
) -> None:
    one.reach_first_way()
    [who] = served.store.participants()
    first, second = who.order
    shown = one.client.get(f"/film/{first}", headers={"Range": "bytes=0-99"})
    assert (shown.status_code, len(shown.content)) == (206, 100)
    for path in (second, "R9", "..%2f..%2fetc%2fpasswd"):
        assert one.client.get(f"/film/{path}").status_code == 404
    assert served.browse().client.get(f"/film/{first}").status_code == 404


@pytest.mark.proof
def test_from_memory_the_video_is_gone_while_one_describes(
    make_study: MakeStudy, serve_study: ServeStudy
) -> None:
    with serve_study(make_study("memory", "delay_minutes = 0.02")) as served:
        one = served.browse()
        one.reach_first_way()
        [film] = re.findall(r'src="(/film/[^"]+)"', one.page)
        shown = one.client.get(film)
        assert (shown.status_code, shown.headers["cache-control"]) == (200, "no-store")
        refused = one.send()
        assert "watch the video to its end" in refused.text
        [step] = re.findall(r'data-step="([^"]+)"', one.page)
        one.post(f"/event/{step}", kind="ended", value="61.5")
        one.send()
        assert "A short break" in one.page
        assert "a little too early" in one.send().text
        [left] = re.findall(r'data-seconds="(\d+)"', one.page)
        assert 0 <= int(left) <= 2
        deadline = time.monotonic() + 20
        while "A short break" in one.page and time.monotonic() < deadline:
            one.send()
        assert "Your description" in one.page
        assert "/film/" not in one.page
        assert one.client.get(film).status_code == 404


def test_what_the_video_tells_is_checked(served: Served, one: Visitor) -> None:
    one.reach_first_way()
    [step] = re.findall(r'data-step="([^"]+)"', one.page)
    assert one.post(f"/event/{step}", kind="play", value="3.2").status_code == 204
    for kind, value in (("play", "nan"), ("play", "-1"), ("party", "1")):
        sent = one.post(f"/event/{step}", kind=kind, value=value)
        assert sent.status_code == 400
    assert one.post("/event/tell.R9", kind="play").status_code == 404
    [who] = served.store.participants()
    events = served.store.events(who.id, step)
    assert [(event.kind, event.value) for event in events] == [
        ("opened", 0.0),
        ("play", 3.2),
    ]


def test_somebody_withdraws_and_begins_anew(served: Served, one: Visitor) -> None:
    one.reach_first_way()
    one.get("/withdraw")
    one.post("/withdraw")
    assert "Nothing of you is left" in one.page
    assert served.store.participants() == []
    assert dict(one.client.cookies) == {}
    assert "Welcome" in one.get("/study")
    one.reach_first_way()
    assert len(served.store.participants()) == 1


@pytest.mark.parametrize("path", ["/study", "/withdraw"])
def test_who_has_not_consented_is_led_to_the_beginning(one: Visitor, path: str) -> None:
    assert "Welcome" in one.get(path)


def test_texts_of_the_study_file_are_escaped(
    make_study: MakeStudy, serve_study: ServeStudy
) -> None:
    contact = 'contact = "<img src=x> {{ 7 * 7 }} & more"'
    with serve_study(make_study("online", contact)) as served:
        assert "&lt;img src=x&gt; {{ 7 * 7 }} &amp; more" in served.browse().get("/")
