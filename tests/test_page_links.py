"""Links lead somewhere, and pages and names are there that others name."""

import re
from pathlib import Path

import pytest

import memorymaze

PROJECT = Path(__file__).parents[1]
PAGES = sorted(
    path
    for pattern in ("*.md", "docs/**/*.md", "examples/**/*.md", "src/**/*.md")
    for path in PROJECT.glob(pattern)
)
CODE = re.compile(r"^```.*?^```$|^ {4}[^\n]*$|`[^`\n]+`", re.MULTILINE | re.DOTALL)
LINK = re.compile(r"\]\(([^)\s]+)\)")
HEADING = re.compile(r"^#{1,6} (.+)$", re.MULTILINE)


def _anchors_of(page: Path) -> set[str]:
    """What headings are called in links, by the rule of GitHub and of `mkdocs.yml`."""
    text = re.sub(r"^```.*?^```$", "", page.read_text("utf-8"), flags=re.M | re.S)
    words = (re.sub(r"[^\w\- ]", "", each).lower() for each in HEADING.findall(text))
    return {each.strip().replace(" ", "-") for each in words}


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(PROJECT)))
def test_the_links_of_a_page_lead_somewhere(page: Path) -> None:
    astray: list[str] = []
    for link in LINK.findall(CODE.sub("", page.read_text("utf-8"))):
        if "://" in link:
            continue
        name, _, anchor = link.partition("#")
        target = page.parent / name if name else page
        if not target.exists() or (anchor and anchor not in _anchors_of(target)):
            astray.append(link)
    assert astray == []


def test_pages_that_the_code_names_are_there() -> None:
    folders = ("src", "tests", "benchmarks", "examples", "scripts")
    named = {
        (str(path.relative_to(PROJECT)), page)
        for folder in folders
        for kind in ("*.py", "*.toml", "*.html", "*.sh", "*LICENSE")
        for path in (PROJECT / folder).rglob(kind)
        for page in re.findall(r"\bdocs/[\w/]+\.md", path.read_text("utf-8"))
    }
    assert [each for each in sorted(named) if not (PROJECT / each[1]).exists()] == []


def test_the_page_on_python_has_every_name_of_the_front_door() -> None:
    page = (PROJECT / "docs" / "python.md").read_text(encoding="utf-8")
    rows = "".join(re.findall(r"^\|.*$", page.partition("\n## ")[0], re.MULTILINE))
    told = set(re.findall(r"`(\w+)`", rows))
    assert told == {*memorymaze.__all__} - {"__version__"}
