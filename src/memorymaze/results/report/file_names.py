"""Names of files for any id, on any file system."""

import hashlib
import re

LONGEST = 80
"""Characters of an id that a name keeps."""

RESERVED = frozenset(
    {"con", "prn", "aux", "nul"}
    | {f"{port}{number}" for port in ("com", "lpt") for number in range(10)}
)
"""Names that Windows keeps for devices, whatever their suffix."""


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
    stem = re.sub(r"[^a-z0-9_-]+", "-", identifier.lower()).strip("-")[:LONGEST]
    if stem == identifier and stem and stem not in RESERVED:
        return stem
    digest = hashlib.sha256(identifier.encode("utf-8", "surrogatepass")).hexdigest()
    return f"{stem}-{digest[:10]}".lstrip("-")


def route_page(place: tuple[str, str]) -> str:
    """Return the page of a route, given site and route, from the root of a report."""
    site, route = place
    return f"routes/{safe_name(site)}/{safe_name(route)}.html"
