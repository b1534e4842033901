"""Which episodes an environment has: of one site, by route, study and split."""

from collections.abc import Iterable, Sequence
from pathlib import Path

from memorymaze.errors import SettingsError, did_you_mean
from memorymaze.instructions.corpus import episodes
from memorymaze.instructions.files import load_instructions
from memorymaze.instructions.records import Episode
from memorymaze.sites import Site


def choose_episodes(
    site: Site,
    files: str | Path | Sequence[str | Path] | None = None,
    *,
    route: str | None = None,
    study: str | None = None,
    split: str | None = None,
) -> tuple[Episode, ...]:
    """Return the episodes on a site, in the order of the files.

    Args:
        site: Where.
        files: Of instructions; None for the shipped ones.
        route: Only instructions for this route, such as `R1`.
        study: Only those of this study, `online` or `onsite`.
        split: Only those of this split, `dev` or `test`.

    Raises:
        SettingsError: There are none; says what there would be.
        InstructionFileError: A file cannot be used.
    """
    if isinstance(files, str | Path):
        files = [files]
    told = [each for each in load_instructions(files) if each.site == site.name]
    if not told:
        where = "the shipped ones" if files is None else ", ".join(map(str, files))
        raise SettingsError(
            f"instructions: expected some for the site {site.name!r}, got none in "
            f"{where}; give instructions=FILE"
        )
    wanted = {"route": route, "study": study, "split": split}
    for name, value in wanted.items():
        if value is None:
            continue
        there = sorted({str(getattr(each, name)) for each in told})
        told = [each for each in told if getattr(each, name) == value]
        if not told:
            raise SettingsError(
                f"{name}: expected one of {', '.join(there)}, got {value!r}"
            )
    return tuple(episodes(told, {site.name: site}))


def find_episode(choice: Iterable[Episode], name: object) -> Episode:
    """Return the episode of an id.

    Raises:
        SettingsError: There is none.
    """
    known = {each.id: each for each in choice}
    if isinstance(name, str) and name in known:
        return known[name]
    raise SettingsError(
        f"episode_id: expected one of this environment's {len(known)} (see "
        f"`env.unwrapped.episode_ids`), got {name!r}{did_you_mean(name, known)}"
    )
