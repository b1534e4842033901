"""Hooks of `mkdocs.yml`: the README is the front page, and the lab has all its notes.

The reference is made here: its page is of use only with the docstrings filled in. Links to what is no page, such as an example, become its path in the repository.
"""

import re
from pathlib import Path
from typing import Any

from mkdocs.config.defaults import MkDocsConfig
from mkdocs.exceptions import PluginError
from mkdocs.structure.files import File, Files
from mkdocs.structure.pages import Page

import memorymaze

PROJECT = Path(__file__).parents[1]
PAGES = PROJECT / "docs"
FRONT = "index.md"
REFERENCE = "reference.md"
LINK = re.compile(r"(?<!!)\[([^\]]*)\]\(([^)\s#:]+)(#[^)\s]*)?\)")


def on_config(config: MkDocsConfig) -> MkDocsConfig:
    """List the notes of the lab, its README first."""
    notes = sorted(each.name for each in (PAGES / "lab").glob("*.md"))
    notes.sort(key=lambda name: name != "README.md")
    assert config.nav is not None
    config.nav = [*config.nav, {"The lab": [f"lab/{name}" for name in notes]}]
    return config


def on_files(files: Files, config: MkDocsConfig) -> Files:
    """Have the README as the front page, and the names of the front door as reference."""
    text = (PROJECT / "README.md").read_text(encoding="utf-8")
    files.append(File.generated(config, FRONT, content=text))
    files.append(File.generated(config, REFERENCE, content=_reference()))
    return files


def _reference() -> str:
    """Return the page that has the docstrings of all that `import memorymaze` gives."""
    names = [name for name in memorymaze.__all__ if not name.startswith("_")]
    kinds = {
        "Functions": [name for name in names if name.islower()],
        "Classes": [name for name in names if not name.islower()],
    }
    parts = ["# Reference", "The names that `import memorymaze as mm` gives."]
    for heading, those in kinds.items():
        parts += [f"## {heading}", *(f"::: memorymaze.{name}" for name in those)]
    return "\n\n".join(parts) + "\n"


def on_page_markdown(markdown: str, page: Page, **_: Any) -> str:
    """Make links lead to pages, or tell the path of what is none."""
    uri = page.file.src_uri
    folder = PROJECT if uri == FRONT else (PAGES / uri).parent

    def led(link: re.Match[str]) -> str:
        text, name, anchor = link.groups()
        target = (folder / name).resolve()
        if target.is_relative_to(PAGES):
            # What is missing there mkdocs finds itself.
            return link[0] if uri != FRONT else link[0].replace("(docs/", "(", 1)
        if not target.exists():
            raise PluginError(f"{uri}: no such file: {name}{anchor or ''}")
        path = f"`{target.relative_to(PROJECT)}`"
        return text if text == path else f"{text} ({path})"

    if uri == FRONT:
        markdown = markdown.replace('src="docs/', 'src="')
    return LINK.sub(led, markdown)
