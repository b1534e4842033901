"""How much stands in the way and how many people walk about in a run, and of which kinds."""

from dataclasses import dataclass, field
from typing import Literal

from memorymaze.basics.errors import SettingsError, did_you_mean
from memorymaze.basics.options import check_number, parse_options, write_options

MOST_PEOPLE = 1000
"""On a floor. With far more, an episode does not begin within a minute."""

PassersBy = Literal["memory", "wrong", "empty", "model"]
"""Who answers for people whom a robot asks: their memory; as controls, all wrongly, or all
that they do not know; or a language model from their memory."""


def _kinds() -> tuple[str, ...]:
    # The table of things needs the records of plans, which settings alone do not.
    from memorymaze.robot.simulation.obstacles.movables import left_standing

    return tuple(left_standing())


@dataclass(frozen=True, slots=True)
class ObstacleSettings:
    """What a building is filled with beyond its plan.

    Raises:
        SettingsError: A value has no meaning; the message names it and the range.
    """

    things_per_100m: float = field(default=4.0, metadata={"given_as": "things"})
    """Things left standing, per 100 m of corridor."""
    people_per_100m2: float = field(default=1.0, metadata={"given_as": "density"})
    """People walking about, per 100 square metres of floor."""
    people: int | None = None
    """Number of people, whatever the size of the floor; None goes by the density."""
    kinds: tuple[str, ...] = field(default_factory=_kinds)
    """Kinds of things, by their names in `movables.left_standing`; they take turns."""
    patience: float = 15.0
    """Seconds a move waits for people before it reports an obstacle."""
    seed: int = 0
    """Of where things stand and how people walk; apart from the seed of the run."""

    def __post_init__(self) -> None:
        """Check every value."""
        named = "obstacle setting {}".format
        things, density = "things (things_per_100m)", "density (people_per_100m2)"
        check_number(named(things), self.things_per_100m, 0, 100)
        # At 50 people stand shoulder to shoulder.
        check_number(named(density), self.people_per_100m2, 0, 50)
        check_number(named("patience"), self.patience, 0, 1000)
        check_number(named("seed"), self.seed, 0, whole=True)
        if self.people is not None:
            check_number(named("people"), self.people, 0, MOST_PEOPLE, whole=True)
        known = _kinds()
        unknown = [kind for kind in self.kinds if kind not in known]
        if unknown or not self.kinds:
            raise SettingsError(
                f"obstacle setting kinds: expected some of {', '.join(known)}, "
                f"got {', '.join(map(repr, unknown)) or 'none'}"
            )

    def __str__(self) -> str:
        """Return them as `parse_obstacles` reads them."""
        return write_options(self)

    def things_on(self, length: float) -> int:
        """Return how many things stand along so many metres."""
        return round(self.things_per_100m * length / 100)

    def people_on(self, area: float) -> int:
        """Return how many people walk about on so many square metres."""
        if self.people is not None:
            return self.people
        return round(self.people_per_100m2 * area / 100)


LEVELS = {"light": (2.0, 0.5), "medium": (4.0, 1.0), "heavy": (8.0, 2.0)}
"""Things per 100 m and people per 100 square metres that have a name."""


def parse_obstacles(text: str) -> ObstacleSettings:
    """Read settings as the command line gives them.

    A level, or settings joined by commas, or both: `light`, `heavy,seed=3`,
    `things=4,people=12,kinds=cart+suitcase`. `density` is people per 100 square
    metres, `people` their number; what is left out is as in `medium`.

    Raises:
        SettingsError: A part is neither a level nor a setting.
    """
    level, _, rest = (part.strip() for part in text.partition(","))
    if "=" in level:
        level, rest = "medium", text
    if level not in LEVELS:
        raise SettingsError(
            f"obstacles: expected a level ({', '.join(LEVELS)}), settings such as "
            f"things=4,people=12,seed=1, or both joined by a comma, got {level!r}"
            f"{did_you_mean(level, LEVELS)}"
        )
    return parse_options(
        ObstacleSettings,
        rest,
        subject="obstacle setting",
        start=ObstacleSettings(*LEVELS[level]),
    )
