from pathlib import Path

import pytest

from benchmarks import blame, fit, made_walks


def _ran(
    bench: object, folder: Path, monkeypatch: pytest.MonkeyPatch, *more: str
) -> int:
    floors = ["--kinds", "office", "--made", "1", "--workers", "1"]
    arguments = ["bench", *floors, "--out", str(folder), *more]
    monkeypatch.setattr("sys.argv", arguments)
    return bench.main()  # type: ignore[attr-defined]


@pytest.mark.proof
def test_success_on_made_floors_is_told_by_kind_of_building(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    assert not _ran(made_walks, tmp_path, monkeypatch, "--agent", "explorer")
    told = capsys.readouterr().out
    assert "explorer  office    2" in told
    assert "made-up speakers (exact)" in told


@pytest.mark.proof
def test_the_same_floors_are_told_by_all_speakers(tmp_path: Path) -> None:
    def ways(speakers: str) -> list[made_walks.ToldWay]:
        floors = {"office": [made_walks.FIRST_SEED]}
        return list(made_walks.told_ways(floors, speakers, 1, 0, tmp_path))

    everything, right, wrong = map(ways, ("all", "people", "errors"))
    assert [e.name for e in everything] == [e.name for e in right]
    assert not any(each.errors for each in (*everything, *right))
    assert all(each.errors for each in wrong)
    told = [len(each.plan.legs[0].mentions) for each in (everything[0], right[0])]
    assert told[0] > told[1]


@pytest.mark.proof
def test_each_evidence_is_blamed_for_what_it_made_of_wrong_turns(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    assert not _ran(blame, tmp_path, monkeypatch, "--sample", "2")
    told = capsys.readouterr().out
    assert "The first mistake of walks that were lost" in told
    assert all(name in told for name in blame.NEUTRAL)


@pytest.mark.proof
def test_decisions_of_walks_are_weighed_by_what_was_right(tmp_path: Path) -> None:
    floors = {"office": [made_walks.FIRST_SEED]}
    told = list(made_walks.told_ways(floors, "exact", 1, 0, tmp_path))
    kept = fit.snapshots(told, 0, "exact")
    assert len(kept) == fit.MOST_A_WALK * len(told)
    as_set = [fit.chance_of_right(each, fit.Likelihoods()) for each in kept]
    sloppy = fit.Likelihoods(wrong_side=0.5, no_turn=0.5, turn_untold=0.5)
    others = [fit.chance_of_right(each, sloppy) for each in kept]
    assert min(as_set) > 0.5
    assert sum(as_set) > sum(others)
