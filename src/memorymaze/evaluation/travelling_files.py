"""Files that a run names and that its workers on other machines need.

Read where the run is driven, written into a folder of each worker, so that no file
system has to be shared. What the driver's machine alone can keep is refused.
"""

import atexit
import shutil
import tempfile
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

from memorymaze.errors import SettingsError
from memorymaze.evaluation.episode_worker import (
    EpisodeDone,
    EpisodeTask,
    EpisodeWorker,
    LimitReached,
)
from memorymaze.evaluation.eyes_for_runs import checked_eyes
from memorymaze.evaluation.looks_for_runs import looks_of_run
from memorymaze.evaluation.settings import AgentSettings, RunSettings
from memorymaze.sites import Site

LOOPBACK = ("//localhost", "//127.", "//[::1]")


@dataclass(frozen=True, slots=True)
class TravellingWorker:
    """An `EpisodeWorker` that brings along the files that its settings name."""

    settings: RunSettings
    sites: dict[str, Site]
    files: dict[str, tuple[str, bytes]]
    """Name and content, by what they are: `agent`, `programs`, `replay`."""

    def __call__(self) -> Callable[[EpisodeTask], EpisodeDone | LimitReached]:
        """Write the files, see that this machine has what the run needs, and prepare."""
        places = _unpack(self.files) if self.files else {}
        settings = replace(self.settings, agent=_placed(self.settings.agent, places))
        _check_here(self.settings)
        try:
            return EpisodeWorker(settings, self.sites)()
        except SettingsError as error:
            if "agent" not in places:
                raise
            raise SettingsError(
                f"{error}; of an agent's files only the one that is named travels: put "
                "into it what it needs, or install that on every node"
            ) from error


def pack_files(settings: RunSettings) -> dict[str, tuple[str, bytes]]:
    """Read the files that the settings of a run name.

    Raises:
        SettingsError: One cannot be read.
    """
    agent = settings.agent
    named = {"programs": agent.programs, "replay": agent.replay}
    file = agent.name.rpartition(":")[0]
    if file.endswith(".py"):
        named["agent"] = file
    packed: dict[str, tuple[str, bytes]] = {}
    for role, name in named.items():
        if name is not None:
            try:
                packed[role] = (Path(name).name, Path(name).read_bytes())
            except OSError as error:
                raise SettingsError(
                    f"{name}: cannot be read ({error.strerror})"
                ) from None
    return packed


def check_can_travel(settings: RunSettings, nodes: int) -> None:
    """Refuse settings that only processes of one machine can keep together.

    Raises:
        SettingsError: Names the option, and what to do instead.
    """
    agent, asking = settings.agent, settings.agent.asking
    here = "leave --ray out: workers on this machine (--workers N) keep it together"
    for option, value in (
        ("--max-cost", asking.max_cost),
        ("--max-tokens-total", asking.max_tokens_total),
    ):
        if value is not None:
            raise SettingsError(
                f"{option} and --ray: workers on several machines do not know what the "
                f"others have spent; set the limit at the server, or {here}"
            )
    if asking.max_requests is not None:
        raise SettingsError(
            "--max-requests and --ray: workers on several machines do not know of each "
            "other's requests; each has at most one under way, so give --workers "
            f"{asking.max_requests} instead"
        )
    if agent.record is not None:
        raise SettingsError(
            "--record and --ray: one file cannot be written from several machines; "
            f"{here}. What is recorded can be replayed on a cluster"
        )
    options = {name.replace("-", "_"): value for name, value in agent.options}
    if options.get("captions", "templates") != "templates":
        raise SettingsError(
            "--set captions and --ray: captions are kept in a file that cannot be "
            f"written from several machines; {here}"
        )
    if nodes > 1:
        for option, url in (
            ("--base-url", agent.base_url),
            ("--detector", settings.detector.url),
            ("--set server", options.get("server")),
        ):
            if url is not None and any(part in url for part in LOOPBACK):
                raise SettingsError(
                    f"{option} {url}: on a cluster of {nodes} nodes this is every node "
                    "itself; give the server's address in the network"
                )


def _unpack(files: dict[str, tuple[str, bytes]]) -> dict[str, str]:
    """Write files into a folder of this process; return where they are."""
    folder = tempfile.mkdtemp(prefix="memorymaze-")
    # Not earlier: recorded replies are read as long as there are episodes.
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    places: dict[str, str] = {}
    for role, (name, content) in files.items():
        place = Path(folder, role, name)
        place.parent.mkdir()
        place.write_bytes(content)
        places[role] = str(place)
    return places


def _placed(agent: AgentSettings, places: dict[str, str]) -> AgentSettings:
    """Return settings that name files where they are here."""
    name = agent.name
    if "agent" in places:
        name = f"{places['agent']}:{name.rpartition(':')[2]}"
    return replace(
        agent,
        name=name,
        programs=places.get("programs"),
        replay=places.get("replay"),
        # The one core that a worker is given.
        asking=replace(agent.asking, threads=1),
    )


def _check_here(settings: RunSettings) -> None:
    """Check on the worker's machine what the plan checked on the driver's."""
    checked_eyes(settings.detector, settings.signs)
    here = looks_of_run(settings.agent.name, settings.detector, settings.signs)
    if here != settings.looks:
        raise SettingsError(
            f"looks of things: expected {settings.looks}, as where the run was begun, "
            f"got {here}; run `memorymaze sites models` on every node or on none, and "
            "give MEMORYMAZE_LOOKS alike"
        )
