"""Writing the pages of a site: templates filled, static files copied."""

import hashlib
import re
from collections.abc import Callable, Mapping
from importlib.resources import files
from pathlib import Path
from typing import Any

from memorymaze.basics.templates import templates_of
from memorymaze.basics.wording import counted, printable, single_spaced
from memorymaze.runs.episodes.in_words import OUTCOMES, ending_words, outcome_of
from memorymaze.runs.tables import (
    PAPER_MEASURES,
    TablePlace,
    place_title,
)
from memorymaze.runs.tables.measures import EPISODE_MEASURES
from memorymaze.world.drawing.svg import svg_number

ROOM = "memorymaze.runs.report"

POLICY = (
    "default-src 'none'; img-src 'self' file: data:; style-src 'self' file: "
    "'unsafe-inline'; script-src 'self' file:; base-uri 'none'; form-action 'none'"
)
"""Content security policy of every page: what it shows cannot bring a script along."""
LONGEST_NAME = 80
"""Characters of an id that a name keeps."""

RESERVED = frozenset(
    {"con", "prn", "aux", "nul"}
    | {f"{port}{number}" for port in ("com", "lpt") for number in range(10)}
)
"""Names that Windows keeps for devices, whatever their suffix."""
ERROR_TITLES = {"none": "no error", "any": "any error"}
"""Of instructions, where they are not those of the corpus."""


class Pages:
    """Writes static pages into a folder that is there."""

    def __init__(self, folder: Path) -> None:
        """Prepare the templates."""
        self.folder = folder
        self._templates = templates_of(ROOM)
        words: dict[str, Any] = {
            "EPISODE_MEASURES": EPISODE_MEASURES,
            "PAPER_MEASURES": PAPER_MEASURES,
            "OUTCOMES": OUTCOMES,
            "ending_words": ending_words,
            "outcome_of": outcome_of,
            "place_name": _place_name,
            "policy": POLICY,
            "route_page": route_page,
        }
        self._templates.globals.update(words)
        filters: dict[str, Callable[..., Any]] = {
            "counted": counted,
            "file": safe_name,
            "kind": error_title,
            "number": svg_number,
            "spaced": single_spaced,
        }
        self._templates.filters.update(filters)

    def write(
        self, path: str, template: str, view: Mapping[str, Any], *, title: str
    ) -> None:
        """Write a page."""
        root = "../" * path.count("/")
        text = self._templates.get_template(template).render(
            **view, title=title, root=root, path=path
        )
        self.write_text(path, text)

    def write_text(self, path: str, text: str) -> None:
        """Write a file; characters that no page can have are replaced."""
        file = self.folder / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_bytes(printable(text).encode("utf-8", "replace"))

    def copy_static(self, *names: str) -> None:
        """Copy style and scripts from the package."""
        for name in names:
            content = (files(ROOM) / "static" / name).read_text(encoding="utf-8")
            self.write_text(f"static/{name}", content)


def safe_name(identifier: str) -> str:
    """Return a file stem of small letters, digits, `_` and `-` that stands for an id.

    Ids that are such names already, as the shipped ones are, stay as they are; others
    get a fingerprint, so that different ids keep different names, also where a file
    system knows no capital letters.

    >>> safe_name("onl-museum_5f-r1-04-2")
    'onl-museum_5f-r1-04-2'
    >>> safe_name("../Etc/passwd")
    'etc-passwd-28c79e5bab'
    """
    stem = re.sub(r"[^a-z0-9_-]+", "-", identifier.lower()).strip("-")[:LONGEST_NAME]
    if stem == identifier and stem and stem not in RESERVED:
        return stem
    digest = hashlib.sha256(identifier.encode("utf-8", "surrogatepass")).hexdigest()
    return f"{stem}-{digest[:10]}".lstrip("-")


def route_page(place: tuple[str, str]) -> str:
    """Return the page of a route, given site and route, from the root of a report."""
    site, route = place
    return f"routes/{safe_name(site)}/{safe_name(route)}.html"


def error_title(kind: str) -> str:
    """Return a kind of error as it is written: `no error`, `missing turn`."""
    return ERROR_TITLES.get(kind, kind.replace("_", " "))


def _place_name(place: tuple[str, str]) -> str:
    return place_title([TablePlace(*place)])
