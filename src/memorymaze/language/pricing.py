"""What replies cost, at prices that the user gives: they age too fast to be kept here."""

import math
from dataclasses import dataclass, replace

from memorymaze.errors import SettingsError
from memorymaze.language.model import (
    Completion,
    CompletionRequest,
    LanguageModel,
    takes_grammar,
)


@dataclass(frozen=True, slots=True)
class TokenPrice:
    """What a server charges, in US dollars per million tokens.

    Raises:
        SettingsError: A price is below 0, or no number.
    """

    prompt: float
    completion: float

    def __post_init__(self) -> None:
        """Refuse what is no price."""
        for amount in (self.prompt, self.completion):
            if not (math.isfinite(amount) and amount >= 0):
                raise SettingsError(
                    "price: expected US dollars per million tokens, at least 0, got "
                    f"{amount!r}"
                )

    def cost(self, prompt_tokens: int, completion_tokens: int) -> float:
        """Return what a reply cost, US dollars."""
        return (
            prompt_tokens * self.prompt + completion_tokens * self.completion
        ) / 1_000_000


def parse_price(text: str) -> TokenPrice:
    """Read `PROMPT,COMPLETION`, such as `0.15,0.60`.

    Raises:
        SettingsError: It is no pair of prices.
    """
    prompt, comma, completion = text.partition(",")
    try:
        if comma:
            return TokenPrice(float(prompt), float(completion))
    except ValueError:
        pass
    raise SettingsError(
        "--price: expected PROMPT,COMPLETION in US dollars per million tokens, such as "
        f"0.15,0.60; got {text!r}"
    )


class PricedModel:
    """A model whose replies say what they cost."""

    def __init__(self, model: LanguageModel, price: TokenPrice) -> None:
        """Put prices on a model's replies."""
        self._model = model
        self._price = price

    @property
    def name(self) -> str:
        """Name of the model asked."""
        return self._model.name

    @property
    def takes_grammar(self) -> bool:
        """Whether the model asked is held to a request's grammar."""
        return takes_grammar(self._model)

    def complete(self, request: CompletionRequest) -> Completion:
        """Return the model's reply with its cost.

        Raises:
            LanguageModelError: No usable answer came.
        """
        completion = self._model.complete(request)
        usage = completion.usage
        cost = self._price.cost(usage.prompt_tokens, usage.completion_tokens)
        return replace(completion, usage=replace(usage, cost_usd=cost))
