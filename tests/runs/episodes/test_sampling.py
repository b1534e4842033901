from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from memorymaze.basics.errors import SettingsError
from memorymaze.basics.geometry.pose import Pose
from memorymaze.runs.episodes.sampling import sample
from memorymaze.texts.corpus.corpus import episodes
from memorymaze.texts.corpus.files import load_instructions
from memorymaze.texts.corpus.records import Episode
from memorymaze.world.sites import Site


def cell(episode: Episode) -> tuple[str, str, str]:
    told = episode.instruction
    return told.study, told.site, told.route


def made_up(sizes: Sequence[int]) -> list[Episode]:
    """Episodes on as many routes as there are sizes."""
    [told] = load_instructions()[:1]
    return [
        Episode(
            f"{route}-{number}",
            replace(told, route=f"R{route}"),
            Pose(0, 0, 0),
            (0, 0),
            (),
        )
        for route, size in enumerate(sizes)
        for number in range(size)
    ]


@given(st.lists(st.integers(1, 9), min_size=1, max_size=6), st.integers(1, 60))
def test_every_route_has_its_share_and_the_order_stays(
    sizes: list[int], limit: int
) -> None:
    everything = made_up(sizes)
    chosen = sample(everything, limit)
    assert len(chosen) == min(limit, len(everything))
    places = [everything.index(one) for one in chosen]
    assert places == sorted(set(places))
    counts = Counter(map(cell, chosen))
    shares = [counts[cell(everything[sum(sizes[:i])])] for i in range(len(sizes))]
    for share, size in zip(shares, sizes, strict=True):
        assert share == size or share >= max(shares) - 1


def test_twelve_of_the_shipped_texts_are_on_all_routes_of_both_studies(
    builtin_sites: Mapping[str, Site],
) -> None:
    everything = episodes(load_instructions(), builtin_sites)
    assert len(Counter(map(cell, sample(everything, 12)))) == 12
    assert sample(everything, None) == everything


@pytest.mark.parametrize("limit", [0, -1])
def test_a_limit_without_meaning_is_refused(limit: int) -> None:
    with pytest.raises(SettingsError, match="at least 1"):
        sample(made_up([3]), limit)


@pytest.mark.parametrize("limit", [2, 4, 6, 8])
def test_a_small_sample_of_the_shipped_texts_is_of_both_studies_and_routes(
    limit: int, builtin_sites: Mapping[str, Site]
) -> None:
    chosen = sample(episodes(load_instructions(), builtin_sites), limit)
    counts = Counter(part for each in chosen for part in cell(each))
    assert abs(counts["online"] - counts["onsite"]) <= 1
    assert min(counts["R1"], counts["R2"]) >= 1
    if limit >= 6:
        assert abs(counts["R1"] - counts["R2"]) <= 1
