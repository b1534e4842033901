import sys
from io import StringIO

import pytest
from rich.console import Console

from memorymaze.errors import SettingsError
from memorymaze.passers_by import Briefing
from memorymaze.results.watching import Present, check_keyboard, type_answer
from memorymaze.results.watching.terminal import TerminalView
from memorymaze.sites import Site

BRIEFING = Briefing(
    "Excuse me, how do I get to the library?",
    ("the library lies 9 m away", "1. go the way the robot faces"),
    ((0.0, -5.0), (0.0, 0.0), (-6.0, 0.0)),
)


@pytest.fixture
def typed(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "stdin", StringIO("Left at the end.\nand more\n"))


@pytest.mark.usefixtures("typed")
def test_a_question_is_shown_with_what_is_true_and_a_line_is_read(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert type_answer(BRIEFING) == "Left at the end.\n"
    shown = capsys.readouterr()
    assert shown.out == ""
    assert "how do I get to the library?" in shown.err
    assert "  1. go the way the robot faces\n" in shown.err
    assert shown.err.endswith("I don't know): ")


@pytest.mark.usefixtures("typed")
def test_the_way_asked_for_is_on_the_plan_while_one_types(
    t_site: Site, present: Present
) -> None:
    console = Console(file=StringIO(), force_terminal=True, width=100, height=40)
    view = TerminalView(t_site, t_site.reference_route("R1"), "Go.", "A walk", console)
    with view:
        view.show(present)
        before = console.file.getvalue()  # type: ignore[attr-defined]
        assert view.answer(BRIEFING) == "Left at the end.\n"
        asked = console.file.getvalue()[len(before) :]  # type: ignore[attr-defined]
        view.show(present)
        after = console.file.getvalue()[len(before + asked) :]  # type: ignore[attr-defined]
    assert "way asked for" not in before
    assert "+++" in asked
    assert "way asked for" in asked
    assert "+++" not in after


def test_where_nobody_can_type_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "stdin", StringIO())
    with pytest.raises(SettingsError, match="expected a terminal"):
        check_keyboard()
