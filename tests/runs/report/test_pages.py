import re

from hypothesis import example, given
from hypothesis import strategies as st

from memorymaze.runs.report.pages import safe_name

IDS = st.text(max_size=200)


@given(IDS)
@example("con")
@example("")
@example("..")
@example("a" * 500)
@example("\ud800")
def test_any_id_becomes_a_short_harmless_name(identifier: str) -> None:
    name = safe_name(identifier)
    assert re.fullmatch(r"[a-z0-9_-]{1,100}", name)
    assert name not in {"con", "nul", "aux", "prn", "com1"}


@given(st.lists(IDS, unique=True, max_size=8))
@example(["A", "a", "a-", "-a", "a/", "a\\"])
def test_different_ids_keep_different_names(identifiers: list[str]) -> None:
    assert len({safe_name(each) for each in identifiers}) == len(identifiers)


def test_ids_of_the_shipped_kind_stay_as_they_are() -> None:
    assert safe_name("ons-university-r2-03-1") == "ons-university-r2-03-1"
