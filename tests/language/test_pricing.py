"""Costs come from prices that the user gives."""

import pytest

from memorymaze.errors import SettingsError
from memorymaze.language.model import CompletionRequest, Message, Usage
from memorymaze.language.pricing import PricedModel, TokenPrice, parse_price
from memorymaze.language.scripted_model import ScriptedLanguageModel


def test_a_reply_says_what_it_cost() -> None:
    model = PricedModel(ScriptedLanguageModel(["one two"]), TokenPrice(2e6, 1e6))
    completion = model.complete(CompletionRequest((Message("user", "a b c"),)))
    assert completion.usage == Usage(3, 2, 8.0)
    assert model.name == "scripted"


def test_prices_are_read_in_dollars_per_million_tokens() -> None:
    assert parse_price("0.15, 0.6") == TokenPrice(0.15, 0.6)
    assert TokenPrice(0.15, 0.6).cost(1_000_000, 500_000) == pytest.approx(0.45)


@pytest.mark.parametrize("text", ["", "1", "1,", "1,two", "-1,2", "nan,1", "1,inf"])
def test_what_is_no_price_is_refused(text: str) -> None:
    with pytest.raises(SettingsError, match="price: expected"):
        parse_price(text)
