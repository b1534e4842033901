"""The texts that people follow in a study, as episodes, and the settings they share."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from memorymaze.basics.errors import StudyError
from memorymaze.basics.input_files import stamp_file
from memorymaze.runs.episodes.bodies import parse_body
from memorymaze.runs.episodes.plan import define_run, stamp_site
from memorymaze.runs.episodes.sampling import sample
from memorymaze.runs.episodes.settings import AgentSettings, RunDefinition, RunSettings
from memorymaze.texts.corpus.corpus import episodes
from memorymaze.texts.corpus.files import BUILTIN_CORPUS, load_instructions
from memorymaze.texts.corpus.records import Episode
from memorymaze.web.studies.follow.walk import NEEDS, PEOPLE
from memorymaze.web.studies.study_file import Study


@dataclass(frozen=True, slots=True)
class TextsToFollow:
    """What people follow, and how their walks are run and scored."""

    episodes: dict[str, Episode]
    """By the id of the text."""
    settings: RunDefinition

    def episode(self, text: str) -> Episode:
        """Return a text that somebody follows or has followed."""
        if text not in self.episodes:
            raise StudyError(
                f"text {text!r}: expected it among the texts of the study, because it was "
                "followed, got it no more; bring instruction files and limit back as they "
                "were"
            )
        return self.episodes[text]

    def of_route(self, route: str) -> Sequence[Episode]:
        """Return the texts of a route, in order."""
        every = self.episodes.values()
        return [each for each in every if each.instruction.route == route]


def texts_to_follow(study: Study) -> TextsToFollow:
    """Read the texts of a study of the kind `follow`.

    StudyError says that there are none of a route.
    """
    follow = study.design.follow
    assert follow is not None  # the study file was checked
    files = [study.path.parent / each for each in follow.instructions]
    files = files or [BUILTIN_CORPUS]
    routes = [each.route for each in study.design.routes]
    told = [
        each
        for each in load_instructions(files)
        if each.site == study.site.name and each.route in routes
    ]
    for route in routes:
        if not any(each.route == route for each in told):
            raise StudyError(
                f"{study.path}: expected texts of {route} of {study.site.name} in "
                f"{', '.join(map(str, files))}, got none; name other files in "
                "[follow] instructions, or leave the route out"
            )
    chosen = sample(episodes(told, {study.site.name: study.site}), follow.limit)
    settings = define_run(
        AgentSettings(PEOPLE),
        RunSettings(
            limit=follow.limit,
            robot=None if follow.robot is None else parse_body(follow.robot),
        ),
        NEEDS,
        [study.site],
    )
    settings = replace(
        settings,
        instructions=tuple(map(stamp_file, files)),
        sites=(stamp_site(study.site),),
        episodes=len(chosen),
    )
    return TextsToFollow({each.id: each for each in chosen}, settings)
