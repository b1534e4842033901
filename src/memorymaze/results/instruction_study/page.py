"""The statistics as one page of HTML that needs no other file."""

import base64
from collections.abc import Iterator
from dataclasses import dataclass
from importlib.resources import files

from jinja2 import Environment, PackageLoader, StrictUndefined
from markupsafe import Markup

from memorymaze.results.instruction_study.clouds import Cloud, word_clouds
from memorymaze.results.instruction_study.plots import PLOTS
from memorymaze.results.instruction_study.study import InstructionStudy
from memorymaze.results.instruction_study.study_table import place_title
from memorymaze.results.instruction_study.tables import study_tables

ROOM = "memorymaze.results.instruction_study"
POLICY = (
    "default-src 'none'; img-src data:; style-src 'unsafe-inline'; base-uri 'none'; "
    "form-action 'none'"
)
"""Content security policy: nothing that a text brings along can run or be fetched."""


@dataclass(frozen=True, slots=True)
class Picture:
    """A picture inside the page."""

    source: str
    """Data URL."""
    alt: str
    caption: str


def study_page(study: InstructionStudy, *, seed: int = 0) -> str:
    """Return the page; who wrote the texts stands at its head and in every caption."""
    templates = Environment(
        loader=PackageLoader(ROOM),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    style = files("memorymaze.results.report") / "static" / "report.css"
    page = templates.get_template("statistics.html").render(
        policy=POLICY,
        style=Markup(style.read_text(encoding="utf-8")),
        written=study.written,
        tables=study_tables(study),
        plots=dict(_plots(study)),
        clouds=[_cloud_picture(each, study) for each in word_clouds(study, seed=seed)],
    )
    return page.encode("utf-8", "replace").decode()


def _plots(study: InstructionStudy) -> Iterator[tuple[str, Picture]]:
    for name, draw in PLOTS.items():
        needed = {"distances": study.distances, "curves": study.vocabularies}
        if not needed.get(name, True):
            continue
        svg = base64.b64encode(draw(study).encode()).decode()
        alt, caption = _told(name, study)
        yield name, Picture(f"data:image/svg+xml;base64,{svg}", alt, caption)


def _told(name: str, study: InstructionStudy) -> tuple[str, str]:
    """Return the text instead of a plot, and its caption."""
    match name:
        case "lengths":
            means = [cell.words_mean for cell in study.cells]
            return (
                "Box plots of words per text for every study, route and iteration; means "
                f"from {min(means):.0f} to {max(means):.0f} words. All figures are in "
                "Table I.",
                "Words per text: median, quartiles, and texts beyond 1.5 times their "
                "distance as points; diamonds are the published means on human texts.",
            )
        case "curves":
            ends = "; ".join(
                f"{place_title(v.place)} {v.study} {v.curve.types[-1]:.0f} after "
                f"{v.words} words"
                for v in study.vocabularies
            )
            return (
                f"Type-token curves, rising ever more slowly: {ends}.",
                "Distinct words among the first words read, mean over 20 orders of the "
                "texts.",
            )
        case "speech":
            groups = "; ".join(
                f"{g.study}: hedges {100 * g.means['hedges'] / max(g.words, 1):.2f}, "
                f"fillers {100 * g.means['fillers'] / max(g.words, 1):.2f}, corrections "
                f"{100 * g.means['corrections'] / max(g.words, 1):.2f}"
                for g in study.groups
                if g.site is None and g.iteration is None
            )
            return (
                f"Bars of marks of speech per 100 words. {groups}.",
                "Hedges, fillers and corrections per 100 words, by study and iteration.",
            )
        case "things":
            groups = "; ".join(
                f"{g.study}: {g.means['things_in_plan']:.1f} in the plan, "
                f"{g.means['unknown_things']:.1f} not"
                for g in study.groups
                if g.site is None and g.iteration is None
            )
            return (
                f"Stacked bars of things named per text, by site and iteration. {groups}.",
                "Things named per text, by what of the site plan they fit best.",
            )
        case _:
            found = "; ".join(
                f"{each.study}: median ratio {each.median:.2f} over {each.legs} legs"
                for each in study.distances
                if each.unit == "numbers"
            )
            return (
                f"Points of stated over true length of legs around the diagonal. {found}.",
                "Stated and true length of legs, by study and by what was counted in; on "
                "the line they agree.",
            )


def _cloud_picture(cloud: Cloud, study: InstructionStudy) -> Picture:
    words = ", ".join(f"{word} ({count})" for word, count in cloud.commonest)
    place = f"{place_title(cloud.site)}, {cloud.study}"
    return Picture(
        f"data:image/png;base64,{base64.b64encode(cloud.png).decode()}",
        f"Word cloud of {place}. Commonest words: {words}.",
        f"{place}: {cloud.texts} {'text' if cloud.texts == 1 else 'texts'} of "
        f"{' '.join(study.written)}",
    )
