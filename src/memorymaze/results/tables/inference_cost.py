"""What asking a language model cost per episode: columns beside the success rate."""

from collections.abc import Sequence
from dataclasses import dataclass
from statistics import fmean

from memorymaze.evaluation.inference_time import describe_inference_time
from memorymaze.evaluation.results import EpisodeResult
from memorymaze.results.tables.rows import MeasuredRun, TableRow

COST_COLUMNS = {
    "model_calls": "calls",
    "tokens": "tokens",
    "cost_usd": "US$",
    "inference_s": "inference s",
    "standing_s": "standing s",
}
"""Headings by the names of the fields."""

COST_KEY = (
    "Means per episode: calls of the language model, tokens of requests and replies, US$ "
    "at the\nprices given (- where none were), seconds of inference, and simulated "
    "seconds that the user\nstands waiting for the model (they do not count against the "
    "time budget)."
)


@dataclass(frozen=True, slots=True)
class InferenceCost:
    """Means per episode; over several routes the unweighted mean of theirs."""

    model_calls: float
    tokens: float
    cost_usd: float | None
    """None where no price is known."""
    inference_s: float
    """Real seconds."""
    standing_s: float
    """Simulated seconds."""


def any_inference(runs: Sequence[MeasuredRun]) -> bool:
    """Tell whether a run has asked a language model at all."""
    return any(result.model_calls for run in runs for result in run.results)


def inference_cost(row: TableRow) -> InferenceCost | None:
    """Return what inference cost in the episodes of a row; None for the paper's."""
    if row.run is None:
        return None
    routes: dict[tuple[str, str], list[EpisodeResult]] = {}
    for result in row.results:
        routes.setdefault((result.site, result.route), []).append(result)
    means = {
        name: fmean(
            fmean(getattr(each, name) for each in cell) for cell in routes.values()
        )
        for name in COST_COLUMNS
    }
    return InferenceCost(
        model_calls=means["model_calls"],
        tokens=means["tokens"],
        cost_usd=means["cost_usd"] if _is_priced(row.run) else None,
        inference_s=means["inference_s"],
        standing_s=means["standing_s"],
    )


def cost_cells(row: TableRow) -> list[str]:
    """Return the texts of the columns, in the order of `COST_COLUMNS`."""
    cost = inference_cost(row)
    if cost is None:
        return [""] * len(COST_COLUMNS)
    return [
        f"{cost.model_calls:.1f}",
        f"{cost.tokens:.0f}",
        "-" if cost.cost_usd is None else f"{cost.cost_usd:.4f}",
        f"{cost.inference_s:.1f}",
        f"{cost.standing_s:.1f}",
    ]


def cost_notes(run: MeasuredRun) -> list[str]:
    """Say how a run's times and costs came about; nothing where no model was asked."""
    if not any_inference([run]):
        return []
    agent = run.record.settings.agent
    notes = [describe_inference_time(agent.inference_time)]
    price = agent.asking.price
    if price is not None:
        notes.append(
            f"prices as given: {price.prompt:g} US$ per million tokens read, "
            f"{price.completion:g} written"
        )
    return notes


def _is_priced(run: MeasuredRun) -> bool:
    asks_nobody = not any_inference([run])
    priced = run.record.settings.agent.asking.price is not None
    return asks_nobody or priced or any(result.cost_usd for result in run.results)
