"""Interviews as an experimenter with a tablet meets them, in Chromium with a microphone."""

import shutil
import wave
from collections.abc import Callable, Generator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from playwright.sync_api import Browser, Page, expect

from memorymaze.texts.corpus import load_instructions
from memorymaze.web.studies.exporting import export_study
from memorymaze.web.studies.serving import serving_study
from memorymaze.web.studies.store import Store, open_store
from memorymaze.web.studies.study_file import Study, load_study

MakeStudy = Callable[..., Study]
Complaints = Callable[[Page], list[str]]
TABLET, PHONE = {"width": 1024, "height": 768}, {"width": 390, "height": 844}
HEARD = "Go to the end of the corridor and then turn right into the hallway."
TYPED = "Go on to the end of the corridor and there you turn left."
PATIENCE = 30_000.0


@pytest.fixture(scope="module")
def hearing_browser(
    browser: Browser, tmp_path_factory: pytest.TempPathFactory
) -> Generator[Browser]:
    """The installed Chromium, whose microphone hears a tone from a file."""
    voice = tmp_path_factory.mktemp("voice") / "tone.wav"
    tone = 12_000 * np.sin(np.arange(3 * 16_000) * 2 * np.pi * 440 / 16_000)
    with wave.open(str(voice), "wb") as file:
        file.setnchannels(1)
        file.setsampwidth(2)
        file.setframerate(16_000)
        file.writeframes(tone.astype("<i2").tobytes())
    path = next(filter(None, map(shutil.which, ("chromium", "google-chrome"))))
    launched = browser.browser_type.launch(
        executable_path=path,
        args=[
            "--no-sandbox",
            "--disable-gpu",
            "--use-fake-ui-for-media-stream",
            "--use-fake-device-for-media-stream",
            f"--use-file-for-fake-audio-capture={voice}",
        ],
    )
    yield launched
    launched.close()


class Tablet:
    """A page of the experimenter, used by the keyboard; each step is checked by axe."""

    def __init__(
        self,
        browser: Browser,
        find_complaints: Complaints,
        entrance: str,
        **options: Any,
    ) -> None:
        self._find_complaints = find_complaints
        self.context = browser.new_context(
            bypass_csp=True, permissions=["microphone"], **options
        )
        self.page: Page = self.context.new_page()
        self.page.set_default_timeout(PATIENCE)
        self.complaints: list[str] = []
        self.page.on("pageerror", lambda error: self.complaints.append(str(error)))
        self.page.on("dialog", lambda dialog: dialog.accept())
        self.page.goto(entrance)
        self.server = entrance.partition("/enter/")[0]

    def open(self, path: str) -> None:
        self.page.goto(self.server + path)

    def look(self) -> None:
        self.complaints += self._find_complaints(self.page)

    @property
    def step(self) -> Any:
        return self.page.locator("#interviews > section:not([hidden])")

    def at(self, step: str) -> None:
        """Wait until a step is shown, and look at it."""
        expect(self.step).to_have_attribute("data-step", step)
        self.look()

    def press(self, name: str) -> None:
        self.step.get_by_role("button", name=name, exact=True).press("Enter")

    def begin(self) -> None:
        """Go from the list to the first description of R1."""
        self.at("start")
        self.step.get_by_label("R1: Main Hallway", exact=False).first.check()
        self.press("Begin")
        self.at("consent")
        for box in self.step.get_by_role("checkbox").all():
            box.press("Space")
        self.press("I agree, let us begin")
        for route in ("R1", "R2"):
            self.at(f"familiarity.{route}")
            self.step.get_by_label("Yes, I know both").press("Space")
            self.press("Go on")
        self.at("scenario")
        self.press("Go on")

    def record(self) -> None:
        self.press("Record")
        expect(self.step.locator(".time")).not_to_have_text("0:00")
        self.look()

    def mark_an_error(self) -> None:
        self.step.get_by_label("reference, 20 m").press("Space")
        kind = self.step.locator("[name='kind.0']")
        kind.select_option("wrong_direction_at_turn")
        kind.focus()
        place = self.step.locator(".place").first
        place.focus()
        for _ in range(3):
            self.page.keyboard.press("ArrowRight")
        self.page.keyboard.press("ArrowLeft")
        self.page.keyboard.press("Enter")
        self.step.get_by_label("What is said, and what is right").fill("right for left")

    def all_is_sent(self) -> None:
        expect(self.page.locator("#pending")).to_have_text("All is sent.")


def with_recogniser(study: Study) -> Study:
    """Give the study a recogniser that hears the same in whatever is loud enough."""
    program = (
        "import sys, pathlib\n"
        "assert pathlib.Path(sys.argv[1]).stat().st_size > 2000\n"
        f"print({HEARD!r})\n"
    )
    (study.path.parent / "hear.py").write_text(program, encoding="utf-8")
    text = study.text.replace(
        '# recogniser = "python recognise.py"', 'recogniser = "python3 hear.py"'
    )
    study.path.write_text(text, encoding="utf-8")
    return load_study(study.path)


@pytest.fixture
def served(make_study: MakeStudy) -> Generator[tuple[Store, str]]:
    study = with_recogniser(make_study("onsite"))
    with open_store(study) as store, serving_study(store) as addresses:
        yield store, addresses.experimenter


@pytest.mark.proof
@pytest.mark.parametrize("size", [TABLET, PHONE], ids=["tablet", "phone"])
def test_an_interview_goes_from_who_knows_both_places_to_the_exported_corpus(
    hearing_browser: Browser,
    complaints: Complaints,
    served: tuple[Store, str],
    tmp_path: Path,
    size: dict[str, int],
) -> None:
    store, entrance = served
    tablet = Tablet(hearing_browser, complaints, entrance, viewport=size)
    tablet.open("/interview")
    tablet.begin()
    tablet.at("tell.R1")
    tablet.record()
    tablet.press("Stop")
    expect(tablet.step.locator("audio")).to_be_visible()
    tablet.press("Go on")
    tablet.at("mark.R1")
    expect(tablet.step.get_by_label("What was said")).to_have_value(HEARD)
    tablet.mark_an_error()
    tablet.press("Go on")
    tablet.at("told.R1")
    words = tablet.step.get_by_label("The errors").input_value()
    assert "left for right at a turn on the way, at place 3" in words
    assert words.endswith(": right for left")
    tablet.step.get_by_role("checkbox").press("Space")
    tablet.press("Go on")

    # The rest without a network, with a page that is loaded again while it records.
    tablet.at("retell.R1")
    tablet.page.evaluate("navigator.serviceWorker.ready.then(() => true)")
    tablet.context.set_offline(True)
    tablet.record()
    tablet.page.reload()
    expect(tablet.step.get_by_role("status")).to_contain_text("The page was closed")
    tablet.look()
    tablet.press("Go on")
    tablet.at("tell.R2")
    expect(tablet.page.locator("#pending")).to_contain_text("1 of them a recording")
    tablet.step.get_by_label("Or type what is said").fill(TYPED)
    tablet.press("Go on")
    tablet.at("mark.R2")
    tablet.step.get_by_label("reference, 20 m").press("Space")
    tablet.page.reload()
    expect(tablet.step.get_by_label("reference, 20 m")).to_be_checked()
    tablet.press("Go on")
    expect(tablet.step.get_by_label("The errors")).to_have_value(
        "With your description the robot would arrive."
    )
    tablet.step.get_by_role("checkbox").press("Space")
    tablet.press("Go on")
    tablet.step.get_by_label("Or type what is said").fill(f"{TYPED} Again.")
    tablet.press("Go on")
    tablet.at("done")
    tablet.press("End this interview")
    tablet.at("start")
    expect(tablet.page.locator("#pending")).to_contain_text("Still to be sent")
    [who] = store.participants()
    assert who.state == "active"
    tablet.open("/labels")
    assert tablet.page.title() == "No network"
    tablet.look()
    tablet.context.set_offline(False)
    tablet.open("/interview")
    tablet.all_is_sent()
    [who] = store.participants()
    assert who.state == "complete"
    assert len(list((store.folder / "recordings").iterdir())) == 2

    out = tmp_path / "mine.jsonl"
    label_alike(tablet, who.id)
    export_study(store.study, store, out)
    told = {each.id.removeprefix(who.id): each for each in load_instructions([out])}
    assert told["-r1-1"].text == told["-r1-2"].text == HEARD
    assert told["-r2-2"].text == f"{TYPED} Again."
    [failure] = told["-r1-1"].failures
    assert (failure.kind, failure.where) == ("wrong_direction_at_turn", "tp_south_end")
    assert told["-r1-2"].failures == ()
    tablet.context.close()
    assert tablet.complaints == []


def label_alike(tablet: Tablet, who: str) -> None:
    """Let two people label the first text, and look at all pages on the way."""
    text = f"/transcripts/{who}/tell.R1"
    for path in (
        "/",
        f"/participants/{who}",
        "/ethics",
        "/trust",
        "/transcripts",
        text,
    ):
        tablet.open(path)
        tablet.look()
    for name in ("Ada", "Bo"):
        tablet.open(f"/labels?name={name}")
        tablet.look()
        tablet.page.get_by_role("link", name="Label the next").press("Enter")
        tablet.page.get_by_label("reference, 20 m").press("Space")
        tablet.page.locator("[name='kind.0']").select_option("wrong_direction_at_turn")
        tablet.page.locator("[name='where.0']").select_option("tp_south_end")
        tablet.look()
        with tablet.page.expect_navigation():
            tablet.page.get_by_role("button", name="Keep this label").press("Enter")
    tablet.look()
    main = tablet.page.locator("main")
    expect(main).to_contain_text("kappa")
    expect(main).to_contain_text("1 of 4 texts are settled")


@pytest.mark.proof
def test_what_the_server_does_not_take_stays_on_the_tablet_until_it_is_removed(
    hearing_browser: Browser, complaints: Complaints, served: tuple[Store, str]
) -> None:
    store, entrance = served
    tablet = Tablet(hearing_browser, complaints, entrance, viewport=TABLET)
    tablet.open("/interview")
    tablet.begin()
    tablet.at("tell.R1")
    tablet.all_is_sent()
    [who] = store.participants()
    store.withdraw(who.id)
    tablet.record()
    tablet.press("Stop")
    tablet.press("Go on")
    refused = tablet.page.locator("#refused")
    expect(refused).to_contain_text(f"{who.id}, voice.tell.R1. Nobody of this number")
    tablet.look()
    refused.get_by_role("button").press("Enter")
    expect(refused).to_be_hidden()
    assert store.participants() == []
    with tablet.page.expect_navigation():
        tablet.page.get_by_role("link", name="Progress").press("Enter")
    tablet.open("/interview")
    tablet.page.locator("#leave button").press("Enter")
    tablet.at("start")
    assert tablet.page.locator("#open").is_hidden()
    tablet.context.close()
    assert tablet.complaints == []


@pytest.mark.proof
def test_whoever_does_not_know_both_places_is_thanked_and_let_go(
    hearing_browser: Browser, complaints: Complaints, served: tuple[Store, str]
) -> None:
    store, entrance = served
    tablet = Tablet(
        hearing_browser, complaints, entrance, viewport=TABLET, color_scheme="dark"
    )
    tablet.open("/interview")
    tablet.at("start")
    tablet.press("Begin")
    tablet.at("consent")
    for box in tablet.step.get_by_role("checkbox").all():
        box.press("Space")
    tablet.press("I agree, let us begin")
    tablet.step.get_by_label("I do not know both").press("Space")
    tablet.press("Go on")
    tablet.at("excluded")
    tablet.all_is_sent()
    tablet.press("To the interviews")
    tablet.at("start")
    assert tablet.page.locator("#open").is_hidden()
    assert [each.state for each in store.participants()] == ["excluded"]
    tablet.context.close()
    assert tablet.complaints == []
