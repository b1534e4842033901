"""How a run asks its language model: patience, prices, limits."""

from dataclasses import dataclass
from typing import Literal

from memorymaze.errors import SettingsError
from memorymaze.language.spending import TokenPrice

GrammarServer = Literal["llama.cpp", "vllm"]


@dataclass(frozen=True, slots=True)
class AskingSettings:
    """How a server is asked, and what may be spent on it.

    Raises:
        SettingsError: A value has no meaning, or a cost is limited that is not known.
    """

    price: TokenPrice | None = None
    """What the server charges; None where costs are not known."""
    timeout: float = 120.0
    """Seconds to wait for a reply, and for each part of it."""
    retries: int = 4
    """Attempts after the first."""
    max_requests: int | None = None
    """Requests under way at once, over all workers; None for one per worker."""
    max_cost: float | None = None
    """US dollars after which the run ends."""
    max_tokens_total: int | None = None
    """Tokens, of requests and replies together, after which the run ends."""
    grammar: GrammarServer | None = None
    """Kind of server that replies are held to a grammar by; None for free replies."""
    shared_folder: str | None = None
    """Where the processes of a run keep what they share: the run's own folder."""
    threads: int | None = None
    """Processor cores that a local model uses; None for half of them."""

    def __post_init__(self) -> None:
        """Refuse values without meaning."""
        least: tuple[tuple[str, float | None, float], ...] = (
            ("--request-timeout", self.timeout, 0.001),
            ("--retries", self.retries, 0),
            ("--max-requests", self.max_requests, 1),
            ("--max-cost", self.max_cost, 0),
            ("--max-tokens-total", self.max_tokens_total, 1),
        )
        for name, value, lowest in least:
            if value is not None and not value >= lowest:
                raise SettingsError(
                    f"{name}: expected at least {lowest:g}, got {value:g}"
                )
        if self.max_cost is not None and self.price is None:
            raise SettingsError(
                "--max-cost: what replies cost is not known; give the server's prices "
                "with --price PROMPT,COMPLETION (US dollars per million tokens)"
            )

    @property
    def limited(self) -> bool:
        """Whether there is a limit on what may be spent."""
        return self.max_cost is not None or self.max_tokens_total is not None


PATIENT = AskingSettings()
"""The defaults: no limit, no price, four further attempts."""
