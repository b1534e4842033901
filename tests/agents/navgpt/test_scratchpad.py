from memorymaze.agents.navgpt.scratchpad import Scratchpad


def test_only_the_last_place_is_told_in_full() -> None:
    pad = Scratchpad(10_000)
    pad.add_move("first", "all of A", "A in short")
    pad.add_failure("hm", "say what you mean")
    pad.add_move("second", "all of B", "B in short")
    pad.add_failure("hm", "once more")
    assert pad.text() == (
        "first\nObservation: A in short\n\n"
        "hm\nObservation: say what you mean\n\n"
        "second\nObservation: all of B\n\n"
        "hm\nObservation: once more\n"
    )


def test_the_released_scratchpad_cuts_a_record_in_two() -> None:
    pad = Scratchpad(20, whole_steps=False)
    pad.add_move("first", "all of A", "A in short")
    pad.add_move("second", "all of B", "B in short")
    assert pad.text() == "bservation: all of B\n"[-20:]


def test_whole_steps_are_left_out_the_oldest_first() -> None:
    pad = Scratchpad(80)
    for number in range(9):
        pad.add_move(f"step {number}", f"all of {number}", f"{number} in short")
    shown = pad.text()
    assert len(shown) <= 80
    assert shown.startswith("step 7\n")
    assert "all of 8" in shown


def test_where_the_robot_is_stays_though_many_replies_fail() -> None:
    pad = Scratchpad(150)
    pad.add_move("old", "all of A", "A in short")
    pad.add_move("step", "all of B", "B in short")
    for number in range(20):
        pad.add_failure(f"nonsense {number}", "no")
    shown = pad.text()
    assert len(shown) <= 150
    assert "all of B" in shown
    assert "nonsense 19" in shown
    assert "A in short" not in shown


def test_an_observation_longer_than_the_limit_is_cut() -> None:
    pad = Scratchpad(50)
    pad.add_move("step", "x" * 500, "short")
    assert pad.text() == "x" * 49 + "\n"


def test_nonsense_is_not_shown_at_length() -> None:
    pad = Scratchpad(10_000)
    pad.add_failure("blah " * 1000, "no")
    assert len(pad.text()) < 450
