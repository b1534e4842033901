"""The statistics as one page of HTML that needs no other file."""

from importlib.resources import files

from markupsafe import Markup

from memorymaze.basics.templates import templates_of
from memorymaze.texts.statistics.plots import study_plots, word_clouds
from memorymaze.texts.statistics.study import InstructionStudy
from memorymaze.texts.statistics.tables import study_tables

ROOM = "memorymaze.texts.statistics"
POLICY = (
    "default-src 'none'; img-src data:; style-src 'unsafe-inline'; base-uri 'none'; "
    "form-action 'none'"
)
"""Content security policy: nothing that a text brings along can run or be fetched."""


def study_page(study: InstructionStudy, *, seed: int = 0) -> str:
    """Return the page; who wrote the texts stands at its head and in every caption."""
    templates = templates_of(ROOM)
    style = files("memorymaze.runs.report") / "static" / "report.css"
    page = templates.get_template("statistics.html").render(
        policy=POLICY,
        style=Markup(style.read_text(encoding="utf-8")),
        written=study.written,
        tables={table.name: table for table in study_tables(study)},
        plots=study_plots(study),
        clouds=word_clouds(study, seed=seed),
    )
    return page.encode("utf-8", "replace").decode()
