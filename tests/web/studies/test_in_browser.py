"""Studies as participants and experimenters meet them, in Chromium."""

from collections.abc import Callable, Generator
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser, Page

from memorymaze.texts.corpus import load_instructions
from memorymaze.texts.corpus.checking import check_instruction_files
from memorymaze.web.studies.exporting import export_study
from memorymaze.web.studies.study_file import Study
from memorymaze.world.sites import load_sites

MakeStudy = Callable[..., Study]
ServeStudy = Callable[[Study], Any]
Complaints = Callable[[Page], list[str]]
TINY_SITES = Path(__file__).parents[2] / "tiny_sites"
WAY = "Go straight on to the end of the corridor and then turn left at the junction."
PHONE = {"width": 390, "height": 844}


class Reader:
    """A page, looked at with axe wherever it is opened; complaints are kept."""

    def __init__(
        self, browser: Browser, find_complaints: Complaints, **options: Any
    ) -> None:
        self._find_complaints = find_complaints
        self.context = browser.new_context(**options)
        self.page: Page = self.context.new_page()
        self.complaints: list[str] = []
        self.looked_at: list[str] = []
        self.page.on("pageerror", lambda error: self.complaints.append(str(error)))
        self.page.on("console", self._hear)
        self.page.on("request", self._watch)

    def _hear(self, message: Any) -> None:
        # A form that is sent back has code 400, which the browser logs.
        if message.type == "error" and "400" not in message.text:
            self.complaints.append(message.text)

    def _watch(self, request: Any) -> None:
        if not request.url.startswith(("http://127.0.0.1:", "data:", "blob:")):
            self.complaints.append(request.url)

    def look(self) -> None:
        """Check the page as it is."""
        self.complaints += self._find_complaints(self.page)
        self.looked_at.append(self.page.title())

    def press(self, name: str) -> None:
        """Press a button by the keyboard."""
        self.page.get_by_role("button", name=name, exact=True).press("Enter")

    def send(self, name: str) -> None:
        """Press a button that leads to another page."""
        with self.page.expect_navigation():
            self.press(name)

    def choose(self, *labels: str) -> None:
        """Choose answers by the keyboard, and go on."""
        self.look()
        for label in labels:
            self.page.get_by_label(label).press("Space")
        self.send("Go on")

    def until(self, script: str) -> None:
        """Wait until something holds; the page's policy forbids Playwright's own way."""
        for _ in range(400):
            if self.page.evaluate(script):
                return
            self.page.wait_for_timeout(25)
        pytest.fail(f"never true: {script}")


@pytest.fixture
def read(browser: Browser, complaints: Complaints) -> Generator[Callable[..., Reader]]:
    """Open a browser of one's own; the test fails on any complaint."""
    readers: list[Reader] = []

    def opened(**options: Any) -> Reader:
        readers.append(Reader(browser, complaints, **options))
        return readers[-1]

    yield opened
    for reader in readers:
        reader.context.close()
    assert [each for reader in readers for each in reader.complaints] == []


def consent(reader: Reader, address: str) -> None:
    reader.page.goto(address)
    reader.look()
    for box in reader.page.get_by_role("checkbox").all():
        box.press("Space")
    reader.send("I agree, let us begin")


def reach_first_way(reader: Reader, address: str) -> None:
    consent(reader, address)
    reader.choose("Draw a map", "Somebody who works in")
    reader.until("document.activeElement.role === 'alert'")
    reader.choose("Describe a way", "Somebody who has never been in")
    reader.choose("I have never been there")
    reader.choose()


def watch_to_the_end(reader: Reader) -> None:
    reader.until("document.querySelector('video').readyState >= 2")
    reader.press("Play")
    reader.until("document.querySelector('video').ended")


def tell(reader: Reader, label: str, text: str) -> None:
    reader.page.get_by_label(label).fill(text)
    reader.look()
    reader.send("Send and go on")


@pytest.mark.proof
@pytest.mark.parametrize("kind", ["online", "memory"])
@pytest.mark.parametrize("phone", [False, True], ids=["desktop", "phone"])
def test_a_participant_goes_from_consent_to_the_exported_corpus(
    make_study: MakeStudy,
    serve_study: ServeStudy,
    read: Callable[..., Reader],
    tmp_path: Path,
    kind: str,
    phone: bool,
) -> None:
    changed = ["delay_minutes = 0.02"] if kind == "memory" else []
    study = make_study(kind, *changed)
    # axe is a script of its own, which the pages' policy would keep out.
    reader = read(bypass_csp=True, **({"viewport": PHONE} if phone else {}))
    with serve_study(study) as served:
        reach_first_way(reader, served.addresses.participants)
        for way in (1, 2):
            assert f"Way {way} of 2" in reader.page.title()
            watch_to_the_end(reader)
            reader.look()
            if kind == "memory":
                reader.send("I have seen the whole way")
                reader.look()
                reader.until("!document.querySelector('main form button').disabled")
                reader.send("Go on")
                assert reader.page.locator("video").count() == 0
            tell(reader, "Your description", f"{WAY} ({way})")
            assert f"({way})" in reader.page.locator("blockquote").inner_text()
            tell(reader, "Your second description", f"{WAY} Again. ({way})")
            if way == 1:
                reader.choose("A cat")
        assert "THANKYOU" in reader.page.locator("main").inner_text()
        reader.look()
        out = tmp_path / "mine.jsonl"
        export_study(study, served.store, out)
        reader.page.goto(served.addresses.experimenter)
        reader.look()
        with reader.page.expect_navigation():
            reader.page.locator("tbody a").press("Enter")
        reader.look()
        with reader.page.expect_navigation():
            reader.page.get_by_role("link", name="For the ethics board").press("Enter")
        reader.look()
        reader.page.goto(f"{served.addresses.participants}/withdraw")
        reader.look()
        reader.send("Remove everything")
        reader.look()
        assert served.store.participants() == []
        reader.page.goto(f"{served.addresses.participants}/privacy")
        reader.look()
    told = load_instructions([out])
    assert [(each.iteration, each.study) for each in told] == [(1, kind), (2, kind)] * 2
    assert not check_instruction_files([out], load_sites(TINY_SITES)).errors
    assert len(reader.looked_at) == (19 if kind == "online" else 21)
    assert {"online", "memory"} & set(reader.looked_at) == {kind}
    assert not any("None" in title for title in reader.looked_at)


@pytest.mark.proof
def test_pages_of_who_cannot_take_part_pass_the_checks_of_axe_in_the_dark(
    make_study: MakeStudy, serve_study: ServeStudy, read: Callable[..., Reader]
) -> None:
    with serve_study(make_study("online", "quota = 1")) as served:
        address = served.addresses.participants
        knows, waits, late = (
            read(bypass_csp=True, color_scheme="dark") for _ in range(3)
        )
        consent(knows, f"{address}/?PROLIFIC_PID=1")
        consent(waits, address)
        consent(late, address)
        late.look()
        assert late.page.title() == "No place is left"
        knows.choose("Describe a way", "Somebody who has never been in")
        knows.choose("I know it well")
        knows.look()
        assert "NOTTHISTIME" in knows.page.locator("main").inner_text()
        consent(late, f"{address}/?PROLIFIC_PID=1")
        late.look()
        assert late.page.title() == "You have been here before"


@pytest.mark.proof
def test_one_looks_round_in_a_video_by_keys_buttons_and_pointer(
    make_study: MakeStudy, serve_study: ServeStudy, read: Callable[..., Reader]
) -> None:
    reader = read()
    with serve_study(make_study()) as served:
        served_to = served.browse()
        served_to.reach_first_way()
        for name, value in served_to.client.cookies.items():
            cookie = {
                "name": name,
                "value": value,
                "url": served.addresses.participants,
            }
            reader.context.add_cookies([cookie])
        reader.page.goto(f"{served.addresses.participants}/study")
        reader.until("document.querySelector('video').readyState >= 2")
        canvas = reader.page.locator("canvas")

        def colour() -> str:
            # The middle of the window; in the video each side has a colour of its own.
            red, green, blue, _ = reader.page.evaluate(
                """() => {
                const canvas = document.querySelector("canvas");
                const gl = canvas.getContext("webgl2");
                const found = new Uint8Array(4);
                gl.readPixels(canvas.width / 2, canvas.height / 2, 1, 1, gl.RGBA,
                  gl.UNSIGNED_BYTE, found);
                return [...found];
                }"""
            )
            return max(
                ("red", red), ("green", green), ("blue", blue), key=lambda e: e[1]
            )[0]

        reader.until("document.querySelector('.clock').textContent.endsWith('0:02')")
        assert colour() == "red"
        for _ in range(9):
            canvas.press("ArrowLeft")
        assert colour() == "green"
        canvas.press("Home")
        assert colour() == "red"
        for _ in range(9):
            reader.press("Look right")
        assert colour() == "blue"
        reader.press("Look straight ahead")
        box = canvas.bounding_box()
        assert box is not None
        middle = box["y"] + box["height"] / 2
        reader.page.mouse.move(box["x"] + 20, middle)
        reader.page.mouse.down()
        reader.page.mouse.move(box["x"] + box["width"] - 20, middle)
        reader.page.mouse.up()
        assert colour() == "green"
        canvas.press("Space")
        reader.until("document.querySelector('video').ended")
        canvas.press("Space")
        reader.until("!document.querySelector('video').ended")
        [who] = served.store.participants()
        step = f"tell.{who.cell.split(', ')[0]}"
        reader.page.wait_for_timeout(200)
        kinds = [event.kind for event in served.store.events(who.id, step)]
        assert [kinds.count(kind) for kind in ("ended", "again")] == [1, 1]


@pytest.mark.proof
def test_what_is_typed_is_kept_when_the_browser_is_closed(
    make_study: MakeStudy, serve_study: ServeStudy, read: Callable[..., Reader]
) -> None:
    reader = read()
    with serve_study(make_study()) as served:
        served_to = served.browse()
        served_to.reach_first_way()
        cookies = [
            {"name": name, "value": value, "url": served.addresses.participants}
            for name, value in served_to.client.cookies.items()
        ]
        reader.context.add_cookies(cookies)
        reader.page.goto(f"{served.addresses.participants}/study")
        reader.page.get_by_label("Your description").type("Go straight")
        reader.until(
            "document.querySelector('[data-draft-state]').textContent === 'Draft kept.'"
        )
        reader.page.get_by_label("Your description").type(" and then left")
        reader.page.close(run_before_unload=True)
        back = reader.context.new_page()
        back.goto(served.addresses.participants)
        area = back.get_by_label("Your description")
        assert area.input_value() == "Go straight and then left"
        # Another window sends it meanwhile.
        served_to.send(text=WAY)
        area.type(" or so")
        back.get_by_text("was sent already and cannot be changed").wait_for()


@pytest.mark.proof
def test_without_webgl_the_plain_video_with_its_controls_stays(
    make_study: MakeStudy, serve_study: ServeStudy, read: Callable[..., Reader]
) -> None:
    reader = read()
    reader.context.add_init_script(
        "HTMLCanvasElement.prototype.getContext = () => null"
    )
    with serve_study(make_study()) as served:
        reader.page.goto(served.addresses.participants)
        for box in reader.page.get_by_role("checkbox").all():
            box.check()
        reader.send("I agree, let us begin")
        for labels in (
            ["Describe a way", "Somebody who has never been in"],
            ["I have never"],
            [],
        ):
            for label in labels:
                reader.page.get_by_label(label).check()
            reader.send("Go on")
        assert reader.page.locator("video[controls]").is_visible()
        assert not reader.page.locator("canvas").is_visible()
