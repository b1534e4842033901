"""The report on runs: a folder of pages that need neither server nor network."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from itertools import combinations
from pathlib import Path
from typing import Any

from memorymaze.basics.durable_files import new_folder
from memorymaze.basics.errors import RunFolderError
from memorymaze.basics.tables import Row, Table
from memorymaze.runs.episodes.results import EpisodeResult
from memorymaze.runs.report.belief_timeline import belief_timeline
from memorymaze.runs.report.confidence_page import plot_confidence
from memorymaze.runs.report.episode_page import (
    EpisodeRow,
    EpisodeView,
    RunInEpisode,
    WalkOfRun,
    story_record,
    walk_of,
)
from memorymaze.runs.report.overview import (
    compare_pair,
    count_endings,
    error_kinds,
    error_table,
    settings_table,
    spreads,
    written_by,
)
from memorymaze.runs.report.pages import Pages, route_page, safe_name
from memorymaze.runs.report.route_page import picture_frame, run_on_route
from memorymaze.runs.report.sources import Sources
from memorymaze.runs.story.recorded_episode import read_story
from memorymaze.runs.tables import (
    SPREAD_MEASURES,
    TablePlace,
    paper_table,
    run_notes,
)
from memorymaze.runs.tables.confidence import CONFIDENCE
from memorymaze.runs.tables.confidence import KEY as CONFIDENCE_KEY
from memorymaze.runs.tables.questions import means_table
from memorymaze.world.drawing.svg import ViewBox, path_data, plan_frame, svg_plan
from memorymaze.world.sites import Route, Site

REPORT_MARK = "static/replay.js"
"""A file by which a folder is known to be a report."""


def write_report(
    sources: Sources,
    folder: str | Path,
    *,
    overwrite: bool = False,
    progress: Callable[[int, int], None] | None = None,
) -> list[str]:
    """Write a report as a site of static pages; `index.html` is where it begins.

    Equal runs, instructions and plans give equal files. A trace that cannot be read
    costs its own walk only, and its page says so. The folder is there when the report
    is whole, or as it was before.

    Args:
        sources: What it tells of.
        folder: Made; must not hold anything yet.
        overwrite: Whether a report that is there is replaced.
        progress: Told how many episodes of how many are done.

    Returns:
        What readers should know: files not found, traces that cannot be read.

    Raises:
        SettingsError: The folder holds something else, or cannot be made.
    """
    with new_folder(folder, replaces=REPORT_MARK if overwrite else None) as unfinished:
        return _Report(sources, Pages(unfinished)).write(progress)


class _Report:
    def __init__(self, sources: Sources, pages: Pages) -> None:
        self._sources = sources
        self._runs = sources.runs
        self._pages = pages
        self._walks: dict[TablePlace, list[list[WalkOfRun]]] = {}
        self._rows: dict[TablePlace, list[EpisodeRow]] = {}
        self._problems: list[str] = []
        self._by_id: list[dict[str, EpisodeResult]] = [
            {each.episode_id: each for each in run.results} for run in self._runs
        ]
        order = {
            result.episode_id: TablePlace(result.site, result.route)
            for run in self._runs
            for result in run.results
        }
        self._episodes = sorted(order, key=lambda each: (order[each], each))
        self._places = sorted(set(order.values()))
        self._written = written_by(sources)
        self._second = paper_table(self._runs, "II")

    def write(self, progress: Callable[[int, int], None] | None) -> list[str]:
        self._pages.copy_static("report.css", "replay.js", "timeline.js", "tables.js")
        for name, site in self._sources.sites.items():
            self._pages.write_text(f"plans/{safe_name(name)}.svg", svg_plan(site))
        around = [None, *self._episodes, None]
        for number, episode in enumerate(self._episodes, start=1):
            self._write_episode(episode, around[number - 1], around[number + 1])
            if progress is not None:
                progress(number, len(self._episodes))
        for place in self._places:
            self._write_route(place)
        self._write_overview()
        return [*self._sources.notes, *self._problems]

    def _page(self, template: str, title: str, path: str = "", **view: Any) -> None:
        """Write a page; it has the path of its template unless there is another."""
        shown = {"runs": self._runs, "places": self._places, "written": self._written}
        self._pages.write(path or template, template, shown | view, title=title)

    # -- episodes

    def _write_episode(
        self, episode: str, before: str | None, after: str | None
    ) -> None:
        runs = [
            self._run_in_episode(number, by_id[episode])
            for number, by_id in enumerate(self._by_id)
            if episode in by_id
        ]
        first = runs[0].result
        place = TablePlace(first.site, first.route)
        site = self._sources.sites[first.site]
        told = self._sources.instructions[first.instruction_id]
        route = site.find_route(first.reference_route)
        walks = self._walks.setdefault(place, [[] for _ in self._runs])
        for each in runs:
            if each.story is not None and each.walk is not None:
                walks[each.number].append(each.walk)
                self._pages.write_text(
                    each.data_file,
                    "(window.replayData = window.replayData || {})["
                    f'"{each.number}"] = {story_record(each.story)};\n',
                )
        view = EpisodeView(episode, first, told, tuple(runs))
        self._rows.setdefault(place, []).append(
            EpisodeRow(
                episode,
                first,
                tuple(failure.kind for failure in told.failures),
                tuple(by_id.get(episode) for by_id in self._by_id),
            )
        )
        self._page(
            "episode.html",
            f"Episode {episode}",
            f"episodes/{safe_name(episode)}.html",
            view=view,
            route=route,
            site=site,
            frame=plan_frame(site),
            way=path_data(list(route.line.coords)),
            before=before,
            after=after,
        )

    def _run_in_episode(self, number: int, result: EpisodeResult) -> RunInEpisode:
        run = self._runs[number]
        try:
            story = read_story(run.folder, result.episode_id)
        except RunFolderError as error:
            self._problems.append(str(error))
            return RunInEpisode(run, number, result, None, str(error), None, None)
        way = self._sources.sites[result.site].find_route(result.reference_route)
        near = run.record.settings.success_distance
        walk = walk_of(result, story, way, near)
        belief = belief_timeline(story)
        return RunInEpisode(run, number, result, story, None, walk, belief)

    # -- routes

    def _write_route(self, place: TablePlace) -> None:
        site = self._sources.sites[place.site]
        by_run = self._walks[place]
        routes = self._ways(place)
        everything = [walk for walks in by_run for walk in walks]
        self._page(
            "route.html",
            f"Route {place.route}, {site.title}",
            route_page(place),
            place=place,
            site=site,
            routes=routes,
            frame=picture_frame(site, routes, everything),
            whole=plan_frame(site),
            ways=_drawn(routes),
            views=[
                run_on_route(run, site, walks)
                for run, walks in zip(self._runs, by_run, strict=True)
            ],
            table=_only(self._second, *place),
            rows=self._rows[place],
        )

    def _ways(self, place: TablePlace) -> list[Route]:
        """Return the ways that the episodes on a route describe."""
        names = {row.first.reference_route for row in self._rows[place]}
        site = self._sources.sites[place.site]
        return [site.find_route(name) for name in sorted(names)]

    # -- the rest

    def _tile(self, place: TablePlace) -> tuple[TablePlace, Site, ViewBox, list[str]]:
        site = self._sources.sites[place.site]
        return place, site, plan_frame(site), _drawn(self._ways(place))

    def _write_overview(self) -> None:
        self._page(
            "index.html",
            "Report on " + ", ".join(run.label for run in self._runs),
            notes=[run_notes(each) for each in self._runs],
            warnings=[*self._sources.notes, *self._problems],
            endings=[count_endings(run) for run in self._runs],
            means=_only(self._second, "mean", "mean"),
            tiles=[self._tile(place) for place in self._places],
        )
        self._page(
            "tables.html",
            "Tables",
            tables=[_linked(self._second), _linked(paper_table(self._runs, "III"))],
            comparisons=[
                compare_pair(one, two) for one, two in combinations(self._runs, 2)
            ],
        )
        self._page(
            "distributions.html",
            "Distributions",
            spreads=[
                (measure, spreads(self._runs, measure)) for measure in SPREAD_MEASURES
            ],
        )
        self._page(
            "confidence.html",
            "Confidence",
            table=means_table(self._runs, CONFIDENCE),
            key=CONFIDENCE_KEY,
            plots=plot_confidence(self._runs),
        )
        kinds = error_kinds(self._runs, self._sources.instructions)
        self._page(
            "errors.html",
            "Errors in instructions",
            kinds=kinds,
            table=error_table(self._runs, kinds),
        )
        self._page(
            "episodes.html",
            "Episodes",
            rows=[row for place in self._places for row in self._rows[place]],
        )
        self._page(
            "settings.html",
            "Settings of the runs",
            settings=[settings_table(run.record, run.name) for run in self._runs],
        )


def _only(table: Table, site: str, route: str) -> Table:
    """Return the rows of a table that are about a route, or `mean`."""
    rows = [
        each for each in table.rows if (each["site"], each["route"]) == (site, route)
    ]
    return replace(table, rows=tuple(rows))


def _linked(table: Table) -> Table:
    """Return a table whose routes lead to their pages."""

    def page(row: Row) -> str | None:
        is_mean = row["site"] == "mean"
        return None if is_mean else route_page((row["site"], row["route"]))

    columns = (
        replace(each, link=page) if each.name == "place" else each
        for each in table.columns
    )
    return replace(table, columns=tuple(columns))


def _drawn(routes: Sequence[Route]) -> list[str]:
    return [path_data(list(route.line.coords)) for route in routes]
