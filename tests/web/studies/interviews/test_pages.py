"""What a tablet sends, taken and refused."""

import time
from collections.abc import Callable, Generator
from pathlib import Path
from typing import Any

import httpx2
import pytest

from memorymaze.basics.errors import StudyError
from memorymaze.web.studies.exporting import export_study
from memorymaze.web.studies.serving import serving_study
from memorymaze.web.studies.store import open_store
from memorymaze.web.studies.study_file import Study, load_study

MakeStudy = Callable[..., Study]
WHO = "p0123456789"
GUARDED = (
    "/interview",
    "/plan.svg",
    "/transcripts",
    "/labels",
    f"/transcripts/{WHO}/tell.R1",
    f"/labels/{WHO}/tell.R1",
    f"/interviews/{WHO}/transcripts/tell.R1",
    "/recordings/x.webm",
)


class Tablet:
    """An experimenter's tablet, which sends what its script would."""

    def __init__(self, store: Any, entrance: str) -> None:
        self.store = store
        self.entrance = entrance
        self.server = entrance.partition("/enter/")[0]
        self.client = httpx2.Client(base_url=self.server, follow_redirects=True)
        self.client.get(entrance)
        self.token = self.client.get("/offline").text.partition('token" content="')[2]
        self.headers = {"X-CSRF-Token": self.token[:64]}
        self.sent = 0

    def send(self, step: str, who: str = WHO, record: str = "", **fields: str) -> Any:
        self.sent += 1
        times = {"opened": str(time.time() - 9), "at": str(time.time())}
        return self.client.post(
            f"/interviews/{who}/records/{record or f'record-{self.sent:04d}'}",
            data=times | {"step": step} | fields,
            headers=self.headers,
        )

    def send_voice(
        self, step: str, voice: bytes, record: str = "voice-01", **of: str
    ) -> Any:
        times = {"opened": str(time.time() - 9), "at": str(time.time())}
        return self.client.post(
            f"/interviews/{WHO}/recordings/{record}",
            params=times | {"step": f"voice.{step}", "seconds": "9"} | of,
            content=voice,
            headers=self.headers | {"Content-Type": "audio/webm;codecs=opus"},
        )

    def post(self, path: str, **fields: str) -> str:
        return self.client.post(path, data=fields, headers=self.headers).text

    def tell(self, who: str = WHO, text: str = "Left at the end.") -> None:
        """Do a whole interview about R1 and R2, typed."""
        self.send("consent", who, cell="R1, R2", shown="I agree")
        for route in ("R1", "R2"):
            self.send(f"familiarity.{route}", who, text="Yes, I know both")
        self.send("scenario", who)
        for route in ("R1", "R2"):
            self.send(f"tell.{route}", who, text=f"{text} ({route})")
            self.send(f"mark.{route}", who, way=f"route_{route.lower()}_reference")
            self.send(f"told.{route}", who, text="no error", shown="it turns")
            self.send(f"retell.{route}", who, text=f"{text} ({route} again)")
        self.send("done", who)


@pytest.fixture
def tablet(make_study: MakeStudy) -> Generator[Tablet]:
    study = make_study("onsite")
    with open_store(study) as store, serving_study(store) as addresses:
        assert addresses.participants == ""
        tablet = Tablet(store, addresses.experimenter)
        yield tablet
        tablet.client.close()


def test_pages_of_interviews_need_the_printed_address(tablet: Tablet) -> None:
    for path in GUARDED:
        assert httpx2.get(tablet.server + path).status_code == 403, path
    for path in ("/trust", "/offline", "/service-worker.js"):
        assert httpx2.get(tablet.server + path).status_code == 200
    for kind in ("records", "recordings"):
        address = f"{tablet.server}/interviews/{WHO}/{kind}/record-1"
        assert httpx2.post(address).status_code == 403
    page = tablet.client.get("/interview").text
    assert "Do you know Main Hallway and the library" in page


def test_what_is_sent_twice_is_kept_once(tablet: Tablet) -> None:
    for _ in range(2):
        sent = tablet.send("consent", record="begin-01", cell="R1, R2", shown="I agree")
        assert sent.status_code == 200
    sent = [
        tablet.send("tell.R1", record="tell-0001", recorded="yes") for _ in range(2)
    ]
    assert [each.json()["taken"] for each in sent] == ["kept", "known"]
    sent = [tablet.send_voice("tell.R1", b"voice") for _ in range(2)]
    assert [each.json()["taken"] for each in sent] == ["kept", "known"]
    other = tablet.send_voice("tell.R1", b"another", record="voice-03")
    assert other.status_code == 409
    assert "kept already" in other.json()["refused"]
    files = list((tablet.store.folder / "recordings").iterdir())
    assert [file.read_bytes() for file in files] == [b"voice"]
    [who] = tablet.store.participants()
    assert (who.id, who.cell) == (WHO, "R1, R2")
    played = tablet.client.get(f"/recordings/{files[0].name}")
    assert (played.content, played.headers["content-type"]) == (b"voice", "audio/webm")


@pytest.mark.parametrize(
    ("fields", "said"),
    [
        pytest.param({"step": "tell.R9", "text": "x"}, "no step", id="unknown step"),
        pytest.param({"step": "tell.R1"}, "typed or recorded", id="nothing told"),
        pytest.param({"step": "mark.R1", "way": "R9"}, "expected a way", id="no way"),
        pytest.param(
            {"step": "mark.R1", "way": "none", "places": "1 77"}, "got 77", id="place"
        ),
        pytest.param(
            {"step": "scenario", "at": "99999999999"}, "the clock", id="clock ahead"
        ),
        pytest.param(
            {"step": "scenario", "opened": "x"}, "could not convert", id="time"
        ),
        pytest.param({"step": "tell.R1", "text": "x" * 30000}, "at most", id="long"),
    ],
)
def test_what_cannot_be_is_refused_and_said(
    tablet: Tablet, fields: dict[str, str], said: str
) -> None:
    tablet.send("consent", cell="R1, R2")
    sent = tablet.send(**fields)
    assert sent.status_code == 400
    assert said in sent.json()["refused"]


def test_who_lacks_a_description_that_was_refused_is_left_out_and_named(
    tablet: Tablet, tmp_path: Path
) -> None:
    study, store, other = tablet.store.study, tablet.store, "p00000000ff"
    tablet.send("consent", other, cell="R1, R2")
    for step in ("tell.R1", "retell.R1", "tell.R2"):
        tablet.send(step, other, text="Left.")
    assert tablet.send("retell.R2", other, text="x" * 30000).status_code == 400
    tablet.send("done", other)
    with pytest.raises(StudyError, match=f"some of {other} never came"):
        export_study(study, store, tmp_path / "none.jsonl")
    tablet.tell()
    done = export_study(study, store, tmp_path / "mine.jsonl")
    assert (done.participants, done.unwritten, done.lacking) == (1, 0, (other,))


def test_whoever_does_not_know_both_places_is_excluded(tablet: Tablet) -> None:
    tablet.send("consent", cell="R1, R2")
    tablet.send("familiarity.R1", text="I do not know both")
    [who] = tablet.store.participants()
    assert (who.state, who.reason) == ("excluded", "familiarity")


def test_what_was_told_and_marked_is_kept_in_its_exact_words(tablet: Tablet) -> None:
    tablet.send("consent", cell="R1, R2")
    tablet.send("tell.R1", text="Turn right.", shown="Tell the way")
    tablet.send(
        "mark.R1",
        way="none",
        places="3 2 1",
        **{"kind.0": "wrong_direction", "where.0": "tp_junction", "detail.0": "left"},
    )
    tablet.send("told.R1", text="Not  right, left.", shown="It can turn.")
    answers = tablet.store.answers(WHO)
    # The places are those of the reference, so that is what is told.
    assert '"way": "route_r1_reference", "places": []' in answers["mark.R1"].text
    assert '"where": "tp_junction"' in answers["mark.R1"].text
    assert answers["told.R1"].text == "Not  right, left."
    assert answers["told.R1"].shown == "It can turn."
    page = tablet.client.get(f"/participants/{WHO}").text
    assert "Not  right, left." in page
    assert "It can turn." in page


def test_withdrawal_removes_recordings_transcripts_and_labels(tablet: Tablet) -> None:
    tablet.tell()
    tablet.send_voice("tell.R1", b"SECRET-VOICE")
    at = f"{WHO}/tell.R1"
    tablet.post(f"/transcripts/{at}", text="SECRET-TEXT is said", name="Ada")
    tablet.post(
        f"/labels/{at}",
        name="Ada",
        way="none",
        **{"kind.0": "other", "where.0": "chair", "detail.0": "SECRET-LABEL"},
    )
    folder = tablet.store.folder
    kept = b"".join(file.read_bytes() for file in folder.rglob("*") if file.is_file())
    secrets = (b"SECRET-VOICE", b"SECRET-TEXT", b"SECRET-LABEL", WHO.encode())
    assert all(secret in kept for secret in secrets)
    tablet.post(f"/participants/{WHO}/withdraw")
    kept = b"".join(file.read_bytes() for file in folder.rglob("*") if file.is_file())
    assert not any(secret in kept for secret in secrets)
    assert not any(WHO in file.name for file in folder.rglob("*"))
    late = tablet.send_voice("retell.R1", b"SECRET-VOICE", record="voice-02")
    assert late.status_code == 410
    assert not list((folder / "recordings").iterdir())


def test_over_plain_http_of_another_machine_nothing_is_recorded(
    make_study: MakeStudy,
) -> None:
    study = make_study("onsite")
    with (
        open_store(study) as store,
        # As if it were the address of this machine in a network.
        serving_study(store, host="127.0.0.2") as addresses,
    ):
        tablet = Tablet(store, addresses.experimenter)
        page = tablet.client.get("/interview").text
        assert "Start the server with --tls" in page
        tablet.send("consent", cell="R1, R2")
        refused = tablet.send_voice("tell.R1", b"voice")
        assert refused.status_code == 403
        assert "not taken over http" in refused.text
        assert not (store.folder / "recordings").exists()
        assert "plain http" in tablet.client.get("/trust").text
        tablet.client.close()


def with_recogniser(study: Study, program: str) -> Study:
    (study.path.parent / "hear.py").write_text(program, encoding="utf-8")
    text = study.text.replace(
        '# recogniser = "python recognise.py"', 'recogniser = "python3 hear.py"'
    )
    study.path.write_text(text, encoding="utf-8")
    return load_study(study.path)


def test_a_recogniser_hears_recordings_and_people_correct_it(
    make_study: MakeStudy,
) -> None:
    program = "import sys; print('heard', open(sys.argv[1]).read())"
    study = with_recogniser(make_study("onsite"), program)
    with open_store(study) as store, serving_study(store) as addresses:
        tablet = Tablet(store, addresses.experimenter)
        tablet.send("consent", cell="R1, R2")
        tablet.send("tell.R1", recorded="yes")
        tablet.send_voice("tell.R1", b"left at the end")
        address = f"/interviews/{WHO}/transcripts/tell.R1"
        until(lambda: tablet.client.get(address).json()["text"])
        assert tablet.client.get(address).json()["text"] == "heard left at the end"
        corrected = {"text": "Left at the end.", "name": "Ada"}
        tablet.post(f"/transcripts/{WHO}/tell.R1", **corrected)
        page = tablet.client.get(f"/transcripts/{WHO}/tell.R1").text
        assert page.index("heard left at the end") < page.index("Ada, ")
        assert tablet.client.get(address).json()["text"] == "Left at the end."
        nameless = tablet.post(f"/transcripts/{WHO}/tell.R1", text="Typed much")
        assert "say who you are" in nameless
        assert "Typed much" in nameless
        tablet.client.close()


def test_a_recogniser_that_fails_says_so_where_the_text_is_typed(
    make_study: MakeStudy, capfd: pytest.CaptureFixture[str]
) -> None:
    study = with_recogniser(make_study("onsite"), "raise SystemExit('no model')")
    with open_store(study) as store, serving_study(store) as addresses:
        tablet = Tablet(store, addresses.experimenter)
        tablet.send("consent", cell="R1, R2")
        tablet.send("tell.R1", recorded="yes")
        tablet.send_voice("tell.R1", b"left at the end")
        address = f"/interviews/{WHO}/transcripts/tell.R1"
        until(lambda: tablet.client.get(address).json()["problem"])
        problem = tablet.client.get(address).json()["problem"]
        assert problem == "code 1: no model"
        tablet.client.close()
    assert "type it by hand, or mend the command" in capfd.readouterr().err


def until(holds: Callable[[], object]) -> None:
    for _ in range(400):
        if holds():
            return
        time.sleep(0.05)
    pytest.fail("never so")
