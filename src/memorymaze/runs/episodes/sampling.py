"""A smaller set of episodes that stands for all of them."""

from collections.abc import Sequence

from memorymaze.basics.options import check_whole
from memorymaze.texts.corpus.records import Episode


def sample(episodes: Sequence[Episode], limit: int | None) -> list[Episode]:
    """Return at most `limit` episodes: alike many of every route of every study.

    The paper's tables have a row per study and route and an unweighted mean over them,
    so a sample has as many episodes in each as any other, as far as they go; where
    `limit` does not divide evenly, those that have one more are as far as can be of all
    studies, sites and routes.
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
    by_turns = _by_turns(list(cells))
    counts = _shares([len(cells[key]) for key in by_turns], limit)
    chosen = {
        cells[key][place]
        for key, count in zip(by_turns, counts, strict=True)
        for place in _evenly(count, len(cells[key]))
    }
    return [episode for place, episode in enumerate(episodes) if place in chosen]


def _by_turns(keys: list[tuple[str, str, str]]) -> list[tuple[str, str, str]]:
    """Order cells so that the studies, sites and routes of neighbours take turns.

    Like the colours of a chessboard: first those of which the numbers of study, site and
    route have an even sum.
    """
    ranks = [list(dict.fromkeys(parts)) for parts in zip(*keys, strict=True)]
    return sorted(
        keys,
        key=lambda key: (
            sum(r.index(part) for r, part in zip(ranks, key, strict=True)) % 2
        ),
    )


def _shares(sizes: Sequence[int], limit: int) -> list[int]:
    """Deal out `limit` among cells, alike many each, none more than its size."""
    shares = [0] * len(sizes)
    left = min(limit, sum(sizes))
    while left:
        hungry = [index for index, size in enumerate(sizes) if shares[index] < size]
        half = (len(hungry) + 1) // 2
        first = _evenly(min(left, half), half)
        more = min(left, len(hungry)) - len(first)
        rest = _evenly(more, len(hungry) - half) if more else []
        for place in [*first, *(half + each for each in rest)]:
            shares[hungry[place]] += 1
            left -= 1
    return shares


def _evenly(count: int, size: int) -> list[int]:
    """Return `count` of the numbers below `size`, spread evenly."""
    return [(2 * number + 1) * size // (2 * count) for number in range(count)]
