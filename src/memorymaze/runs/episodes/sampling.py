"""A smaller set of episodes that stands for all of them."""

from collections.abc import Sequence

from memorymaze.basics.options import check_whole
from memorymaze.texts.corpus.records import Episode


def sample(episodes: Sequence[Episode], limit: int | None) -> list[Episode]:
    """Return at most `limit` episodes: alike many of every route of every study.

    The paper's tables have a row per study and route and an unweighted mean over them,
    so a sample has as many episodes in each as any other, as far as they go; where
    `limit` does not divide evenly, some that lie evenly among the others have one more.
    Within a route they are spread evenly from first to last. The order stays. No chance
    is involved.
    """
    if limit is None:
        return list(episodes)
    check_whole("limit", limit, least=1)
    cells: dict[tuple[str, str, str], list[int]] = {}
    for place, episode in enumerate(episodes):
        told = episode.instruction
        cells.setdefault((told.study, told.site, told.route), []).append(place)
    counts = _shares([len(cell) for cell in cells.values()], limit)
    chosen = {
        cell[place]
        for cell, count in zip(cells.values(), counts, strict=True)
        for place in _evenly(count, len(cell))
    }
    return [episode for place, episode in enumerate(episodes) if place in chosen]


def _shares(sizes: Sequence[int], limit: int) -> list[int]:
    """Deal out `limit` among cells, alike many each, none more than its size."""
    shares = [0] * len(sizes)
    left = min(limit, sum(sizes))
    while left:
        hungry = [index for index, size in enumerate(sizes) if shares[index] < size]
        for place in _evenly(min(left, len(hungry)), len(hungry)):
            shares[hungry[place]] += 1
            left -= 1
    return shares


def _evenly(count: int, size: int) -> list[int]:
    """Return `count` of the numbers below `size`, spread evenly."""
    return [(2 * number + 1) * size // (2 * count) for number in range(count)]
