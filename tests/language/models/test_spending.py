"""Prices, limits on spending, and places in a queue."""

import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest

from memorymaze.basics.errors import LanguageModelError, SpendingLimitReached
from memorymaze.language.models.answers import RecordingModel, ReplayingModel
from memorymaze.language.models.model import (
    CompletionRequest,
    Message,
    UnusableReplyError,
    Usage,
)
from memorymaze.language.models.scripted_model import ScriptedLanguageModel
from memorymaze.language.models.spending import (
    Ledger,
    LimitedModel,
    PricedModel,
    Spent,
    TokenPrice,
)

REQUEST = CompletionRequest((Message("user", "four words are here"),))


def five_tokens_each() -> PricedModel:
    """A model whose replies cost 5 tokens and 5 dollars each."""
    model = ScriptedLanguageModel(lambda request: "yes")
    return PricedModel(model, TokenPrice(1e6, 1e6))


@pytest.mark.parametrize("shared", [True, False], ids=["in a file", "on its own"])
def test_a_limit_is_passed_by_one_reply_at_most(tmp_path: Path, shared: bool) -> None:
    ledger = Ledger(tmp_path / "spending.jsonl" if shared else None)
    for limits in ({"max_cost": 12.0}, {"max_tokens": 28}):
        model = LimitedModel(five_tokens_each(), ledger, **limits)
        for _ in range(3):
            model.complete(REQUEST)
        with pytest.raises(
            SpendingLimitReached,
            match=r"of .* allowed with (--)?max.[ct].*; raise it to go on$",
        ):
            model.complete(REQUEST)
    assert ledger.spent() == Spent(30, 30.0)


def test_processes_add_up_what_they_spend(tmp_path: Path) -> None:
    path = tmp_path / "spending.jsonl"
    one, other = Ledger(path), Ledger(path)
    assert one.spent() == Spent(0, 0.0)
    one.add(Usage(10, 2, 0.5))
    assert other.spent() == Spent(12, 0.5)
    other.add(Usage(1, 1, None))
    assert one.spent() == other.spent() == Ledger(path).spent() == Spent(14, 0.5)


def test_a_line_that_is_being_written_counts_when_it_is_whole(tmp_path: Path) -> None:
    path = tmp_path / "spending.jsonl"
    ledger = Ledger(path)
    ledger.add(Usage(10, 2, 0.5))
    whole = path.read_bytes()
    path.write_bytes(whole + whole[:9])
    assert ledger.spent() == Spent(12, 0.5)
    path.write_bytes(whole + whole)
    assert ledger.spent() == Spent(24, 1.0)


def test_failures_cost_nothing_that_is_known(tmp_path: Path) -> None:
    ledger = Ledger(tmp_path / "spending.jsonl")
    model = LimitedModel(ScriptedLanguageModel([]), ledger, max_tokens=1)
    for _ in range(2):
        with pytest.raises(LanguageModelError):
            model.complete(REQUEST)
    assert ledger.spent() == Spent(0, 0.0)


def test_an_answer_that_is_no_reply_is_paid_for() -> None:
    class Wordless(ScriptedLanguageModel):
        def complete(self, request: CompletionRequest):
            raise UnusableReplyError("nothing but thoughts", Usage(1000, 4096))

    priced = PricedModel(Wordless([]), TokenPrice(1.0, 10.0))
    ledger = Ledger(None)
    model = LimitedModel(priced, ledger, max_cost=0.05)
    for _ in range(2):
        with pytest.raises(UnusableReplyError, match="nothing but thoughts"):
            model.complete(REQUEST)
    assert ledger.spent() == Spent(2 * 5096, pytest.approx(2 * 0.04196))
    with pytest.raises(SpendingLimitReached, match=r"0\.0839 USD are spent, of 0\.05"):
        model.complete(REQUEST)


@pytest.mark.parametrize(
    "told", [Usage(), Usage(0, 9), Usage(9, 0)], ids=["neither", "replies", "requests"]
)
def test_a_server_that_does_not_count_all_is_not_asked_again_under_a_limit(
    told: Usage, tmp_path: Path
) -> None:
    class Silent(ScriptedLanguageModel):
        def complete(self, request: CompletionRequest):
            return replace(super().complete(request), usage=told)

    free = LimitedModel(Silent(["yes", "yes"]), Ledger(None))
    assert [free.complete(REQUEST).text for _ in range(2)] == ["yes", "yes"]
    limited = LimitedModel(Silent(["yes", "yes"]), Ledger(None), max_tokens=50)
    store = tmp_path / "replies.jsonl"
    model = RecordingModel(limited, store)
    assert model.complete(REQUEST).text == "yes"
    with pytest.raises(
        SpendingLimitReached,
        match=r"does not tell how many tokens .*; leave --max-cost .* out$",
    ):
        model.complete(replace(REQUEST, seed=2))
    assert ReplayingModel(store).complete(REQUEST).text == "yes"


def test_a_reply_says_what_it_cost() -> None:
    model = PricedModel(ScriptedLanguageModel(["one two"]), TokenPrice(2e6, 1e6))
    completion = model.complete(CompletionRequest((Message("user", "a b c"),)))
    assert completion.usage == Usage(3, 2, 8.0)
    assert model.name == "scripted"


def test_prices_are_read_in_dollars_per_million_tokens() -> None:
    assert TokenPrice.parse("0.15, 0.6") == TokenPrice(0.15, 0.6)
    assert TokenPrice(0.15, 0.6).cost(1_000_000, 500_000) == pytest.approx(0.45)


SCRIPT = """
import os, sys
from pathlib import Path
from memorymaze.language.models.model import CompletionRequest, Message
from memorymaze.language.models.spending import QueuedModel
from memorymaze.language.models.scripted_model import ScriptedLanguageModel

me, folder, places = sys.argv[1], Path(sys.argv[2]), int(sys.argv[3])

def answer(request):
    mine = folder / f"asking-{me}"
    mine.touch()
    under_way = len(list(folder.glob("asking-*")))
    mine.unlink()
    if me == "dies" :
        os._exit(7)
    return str(under_way)

model = QueuedModel(ScriptedLanguageModel(answer), folder / "requests.lock", places)
for number in range(40):
    print(model.complete(CompletionRequest((Message("user", "?"),))).text)
"""


def ask(names: list[str], folder: Path, places: int) -> list[list[str]]:
    running = [
        subprocess.Popen(
            [sys.executable, "-c", SCRIPT, name, str(folder), str(places)],
            stdout=subprocess.PIPE,
            text=True,
        )
        for name in names
    ]
    return [process.communicate(timeout=60)[0].split() for process in running]


def test_processes_take_turns(tmp_path: Path) -> None:
    said = ask(["a", "b", "c"], tmp_path, places=1)
    assert said == [["1"] * 40] * 3


def test_a_process_that_dies_gives_its_place_back(tmp_path: Path) -> None:
    assert ask(["dies"], tmp_path, places=1) == [[]]
    assert ask(["lives"], tmp_path, places=1) == [["1"] * 40]
