import csv
import io
import re
from collections.abc import Callable, Mapping
from dataclasses import replace
from html.parser import HTMLParser

import pytest

from memorymaze.texts.corpus import Instruction, load_instructions
from memorymaze.texts.statistics import (
    StudyFormat,
    study_instructions,
    write_study,
)
from memorymaze.texts.statistics.named_things import SiteNames
from memorymaze.world.sites import Site

Told = Callable[..., Instruction]


@pytest.mark.parametrize(
    ("phrase", "sort"),
    [
        pytest.param("Meteorite Lane", "way", id="hallway"),
        pytest.param("vending machines", "landmark", id="landmark"),
        pytest.param("planetarium", "door", id="door of a room"),
        pytest.param("drilling exhibits", "room", id="room"),
        pytest.param("carpet floor", "floor", id="floor"),
        pytest.param("camel", "unknown", id="nothing"),
    ],
)
def test_a_phrase_is_looked_for_in_the_plan(
    builtin_sites: dict[str, Site], phrase: str, sort: str
) -> None:
    found = SiteNames(builtin_sites["museum_5f"]).sort_of(phrase)
    assert found == sort


def test_the_first_table_has_every_cell_of_the_paper_beside_the_measured_one(
    builtin_sites: dict[str, Site],
) -> None:
    few = load_instructions()[::9]
    text = write_study(few, builtin_sites, "text")
    assert text.startswith(f"{len(few)} texts written by a LANGUAGE MODEL")
    rows = [line for line in text.splitlines() if re.match(r"\w+ ?\w* R[12] ", line)]
    assert len(rows) == 24
    assert all(line.count("(") == 6 for line in rows)
    [row] = [line for line in rows if line.startswith("University R2  2")][1:]
    for published in ("(156.68)", "(147.3)", "(143.0)", "(65.0)", "(35.0)", "(15.0)"):
        assert published in row


@pytest.mark.parametrize("studies", [("online",), ("onsite",), ("online", "onsite")])
def test_online_and_onsite_are_compared_where_both_are_there(
    builtin_sites: dict[str, Site], studies: tuple[str, ...]
) -> None:
    some = [each for each in load_instructions() if each.study in studies][::30]
    text = write_study(some, builtin_sites, "text")
    compared = "published counts are higher onsite than online" in text
    assert compared == (len(studies) == 2)


def test_marks_things_and_distances_are_means_per_text(
    told: Told, tiny_sites: Mapping[str, Site]
) -> None:
    texts = ["Um, go 9 metres, I think, then right.", "Go right at the corner."]
    study = study_instructions([told(text) for text in texts], tiny_sites)
    [means] = study.rows("per_text", place="all", iteration="both")
    assert [means[f"{name} mean"] for name in ("fillers", "hedges")] == [0.5, 0.5]
    assert means["distances mean"] == 0.5
    assert means["hedges share of texts"] == 0.5
    assert means["hedges per 100 words"] == pytest.approx(100 / 13)
    ratios = study.rows("stated_distances", "key")
    assert [(row["legs"], row["median"]) for row in ratios] == [
        (1, pytest.approx(1.0))
    ] * 2


def test_csv_has_one_number_per_row_and_says_who_wrote(
    told: Told, tiny_sites: Mapping[str, Site]
) -> None:
    sheet = write_study([told("Go 9 metres, then right.")], tiny_sites, "csv")
    rows = list(csv.DictReader(io.StringIO(sheet)))
    assert {row["written_by"] for row in rows} == {"1 text written by people."}
    [length] = [row for row in rows if row["measure"] == "route_length"]
    assert (length["place"], length["route"], length["value"]) == ("loop", "R1", "15.0")
    assert all(float(row["value"]) >= 0 for row in rows)


@pytest.mark.parametrize("form", ["text", "csv", "html"])
def test_texts_without_a_latin_word_and_names_like_formulas_can_be_described(
    told: Told, tiny_sites: Mapping[str, Site], form: StudyFormat
) -> None:
    sites = {"$x^{$": replace(tiny_sites["loop"], name="$x^{$")}
    shown = write_study([told("左に曲がる", site="$x^{$")], sites, form)
    assert "1 text written by people." in shown


class Page(HTMLParser):
    """What a page has in it."""

    def __init__(self) -> None:
        super().__init__()
        self.images: list[dict[str, str | None]] = []
        self.tags: list[str] = []
        self.words = ""

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append(tag)
        if tag == "img":
            self.images.append(dict(attrs))

    def handle_data(self, data: str) -> None:
        self.words += data


def test_the_page_stands_alone_and_hostile_texts_stay_texts(
    told: Told, tiny_sites: Mapping[str, Site]
) -> None:
    hostile = (
        'Go 9 metres right <script>alert(1)</script> "><img src=x onerror=y> \ud800'
    )
    study = [told(hostile), told("Right, right, right.", source="llm", study="onsite")]
    text = write_study(study, tiny_sites, "html")
    page = Page()
    page.feed(text)
    assert "script" not in page.tags
    assert all(str(image["src"]).startswith("data:image/") for image in page.images)
    assert all(image["alt"] for image in page.images)
    assert len(page.images) == 7
    assert page.tags.count("caption") == page.tags.count("table")
    assert page.words.count("1 text written by a LANGUAGE MODEL") >= len(page.images)
    assert "http" not in text.replace("http-equiv", "").replace("http://www.w3.org", "")
    assert text == write_study(study, tiny_sites, "html")
