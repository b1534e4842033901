"""How likely speakers say what they say of a way, and what they leave out.

Every number here is a parameter of one record, `Likelihoods`. Evidence is a ratio: how
likely the words are if this is the place they are about, over how likely they are if it
is any place. Words about places not yet reached therefore count as 1.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import product
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from memorymaze.agents.walking.choices import FORWARD, SLIGHT, Choices
from memorymaze.language.plans import Leg, Length, Passing, Turn

Weights = NDArray[np.float64]
"""Of every speaker there may be: shape (2, len(SPEAKERS)); the second row once
something told has proved wrong."""


@dataclass(frozen=True, slots=True)
class Likelihoods:
    """The parameters; probabilities unless said otherwise."""

    # -- what is told of a turn
    pass_untold: float = 0.95
    """Of going straight past an opening without a word."""
    pass_fitting: float = 0.45
    """The same where the next turn told, about which nothing else is said, fits it."""
    corner_untold: float = 0.37
    """Of a corner without a choice that is not told."""
    bend_untold: float = 0.45
    """The same of one of 45 degrees; the slighter a bend, the less it counts."""
    choice_untold: float = 0.08
    """Of a turn left out where one has to choose (an error)."""
    turn_untold: float = 0.015
    """Of a turn left out where one could go on (an error)."""
    wrong_side: float = 0.03
    """Of a turn told to the wrong side (an error)."""
    wrong_first_side: float = 0.075
    """The same of the first turn: who tells the way does not know how the robot stands."""
    no_turn: float = 0.05
    """Of a turn told that there is not (an error)."""
    no_bend: float = 0.06
    """The same where it was told as a bend, or as slight."""
    wrong_place: float = 0.03
    """That all is wrong that is said of where to turn (an error)."""
    wrong_start: float = 0.03
    """That the way begins in another direction (an error)."""
    lost: float = 0.01
    """That nothing is right that is said of the way (an error)."""
    way_untold: float = 0.9
    """That who tells nothing but the place does not mean straight on."""
    again: float = 2.0
    """How much likelier an error is once there was one (a factor)."""
    # -- lengths
    length_sd: float = 0.3
    """Of the logarithm of a length said, beside the speaker's own factor."""
    length_outlier: float = 0.1
    """Of a length that has nothing to do with the way."""
    factor_sd: float = 0.25
    """Of the logarithm of the speaker's own factor."""
    unit_sd: float = 0.2
    """Added where it was not counted in metres."""
    way_log_sd: float = 0.8
    """Of the logarithm of the lengths that ways between two turns have."""
    # -- counts
    count_right: float = 0.85
    """That a count is right."""
    one_side: float = 0.75
    """That a speaker counts the openings of one side, not of both."""
    # -- kinds of place
    kind_right: float = 0.85
    """That the kind of junction, the end of the way or a bend is told rightly."""
    # -- things
    careful: float = 0.6
    """That a speaker, and who read the words, is careful about things."""
    invented: float = 0.1
    """That a thing a careful one says is not there, or was read wrongly."""
    invented_carelessly: float = 0.65
    """The same of another one."""
    detected: float = 0.8
    """That a thing that is there is seen from the way."""
    detected_at_turn: float = 0.65
    """The same of one that is told at a turn, of which little comes into the picture."""
    side_right: float = 0.75
    """That the side of a thing is told rightly."""
    mistaken: float = 0.04
    """That a turn hangs on a thing that is not there (an error)."""
    floor_right: float = 0.9
    """That the covering of a floor is told rightly."""
    common_rate: float = 0.08
    """Things per metre of a kind that is everywhere, before any is counted."""
    rare_rate: float = 0.004
    """The same of any other thing."""
    # -- the destination
    misnamed: float = 0.45
    """That what is told of the destination is not what is there, or was read wrongly."""
    sign_right: float = 0.75
    """That the way told is the one to which a sign points."""
    name_again: float = 0.15
    """That a name seen is seen again further on, where the place meant is."""
    passed_by: float = 0.12
    """That a destination that is there is not noticed."""
    arrival_open: float = 0.35
    """Of a destination where the way goes on, and nothing tells it."""

    @property
    def speakers(self) -> Weights:
        """How likely each speaker is, before a word; all without an error."""
        return _speakers(self.factor_sd, self.one_side, self.careful)


FACTORS = (-0.5, -0.25, 0.0, 0.25, 0.5)
SPEAKERS = tuple(product((True, False), FACTORS, (True, False)))
"""Whether a speaker counts the openings of one side only, the logarithm of the factor by
which the lengths said are too long, and whether the things said are mostly there."""

WAY_METRES = 12.0
"""Length of the ways between two turns, in the middle."""
LAST_METRES = 6.0
"""Length of the way from the last turn to the destination, in the middle."""
UNTOLD_METRES = 30.0
"""From here on a way gets the rarer the longer it is, if no length of it was said."""
OF_A_BOUND = 0.6
"""Share of an upper bound that a length is expected to have."""
PLACE_METRES = 8.0
"""From one place where one can turn to the next, where only metres are told."""
BEND = math.radians(45)
SLANT, SLANT_SD = math.radians(42), math.radians(18)
"""Of a way told as slight: its usual angle."""
ONE_OFF = 0.8
"""Of the counts that are wrong so many are one off."""
MOST_SEEN = 30.0
"""What one thing that was seen weighs at most."""
FEWEST_METRES = 1.5
"""Shorter ways are told like this one."""
LEAST_SAID, LEAST_BEYOND = 0.02, 1e-3
"""How likely a length is said, and a way is longer, at least: nothing weighs without end."""
USUAL_COUNT = 0.25
"""How often a stretch has so many places as are said, whatever the number."""
MOST_TOLD, MOST_BEYOND = 50, 12
"""Greater numbers told are like this one; and numbers beyond the one told that are told
apart."""

_ONE_SIDE, _FACTOR_ROW, _CAREFUL = map(np.array, zip(*SPEAKERS, strict=True))


@lru_cache(maxsize=64)
def _speakers(factor_sd: float, one_side: float, careful: float) -> Weights:
    rows = np.exp(-0.5 * (_FACTOR_ROW / factor_sd) ** 2)
    rows *= np.where(_ONE_SIDE, one_side, 1 - one_side)
    rows *= np.where(_CAREFUL, careful, 1 - careful)
    return _fixed(np.stack([rows / rows.sum(), np.zeros(len(SPEAKERS))]))


def then(
    weights: Weights, fine: float | Weights, wrong: float, again: float
) -> Weights:
    """Weigh words: as they are if they are right, and if they are an error."""
    after = weights * fine
    if wrong:
        after[1] += wrong * (weights[0] + again * weights[1])
    return after


def without_turn(model: Likelihoods, weights: Weights, leg: Leg) -> Weights:
    """Weigh that a leg ends with no turn: read wrongly, or told though there is none."""
    doubt = leg.unclear
    error = (1 - doubt) * (model.no_turn + 0.2 * leg.turn.doubt)
    return then(weights, doubt, error, model.again)


# -- lengths


def length_ratio(
    model: Likelihoods, length: Length, walked: float, places: int, junctions: int
) -> Weights:
    """Weigh a length said against a stretch walked, for every speaker.

    `places` are those where one can turn that were come to, the present one included;
    `junctions` are those of them where one has to choose.
    """
    if length.unit == "places":
        count = length.count or length.metres / PLACE_METRES
        off = min(abs(places - count), abs(junctions - count))
        return np.full(
            len(SPEAKERS), _count_right(model.count_right, off) / USUAL_COUNT
        )
    spread = _spread(model, length)
    return _said_over_any(model, _log_metres(_expected(length)), spread, walked)


def length_to_come(
    model: Likelihoods, length: Length, walked: float, places: int
) -> Weights:
    """Weigh a length said against a stretch that is as long already, or longer.

    The mean of what it weighs against all lengths that the stretch may come to have: how
    likely a way goes on that far given what was said, over how likely any does.
    """
    if length.unit == "places":
        count = length.count or length.metres / PLACE_METRES
        off = max(places + 1 - count, 0.0)
        ratio = _count_right(model.count_right, off) / USUAL_COUNT
        return np.full(len(SPEAKERS), min(ratio, 1.0))
    spread = _spread(model, length)
    return _survival_ratio(model, _log_metres(_expected(length)), spread, walked)


def untold_length(model: Likelihoods, walked: float) -> float:
    """Weigh a stretch of which no length was said: one of many metres is rare."""
    if walked <= UNTOLD_METRES:
        return 1.0
    return 2 * _beyond(math.log(walked / UNTOLD_METRES) / model.way_log_sd)


@lru_cache(maxsize=4096)
def ends_after(model: Likelihoods, walked: float) -> float:
    """Return how likely the destination is farther than this from the last turn.

    It is so where no length was said of the way there.
    """
    if walked <= 0:
        return 1.0
    return _beyond(math.log(walked / LAST_METRES) / model.way_log_sd)


@lru_cache(maxsize=4096)
def _said_over_any(
    model: Likelihoods, said: float, spread: float, walked: float
) -> Weights:
    true = math.log(max(walked, FEWEST_METRES))
    right = _density((said - true - _FACTOR_ROW) / spread) / spread
    any_way = _said_of_any(model, said, spread)
    return _fixed((1 - model.length_outlier) * right / any_way + model.length_outlier)


@lru_cache(maxsize=4096)
def _survival_ratio(
    model: Likelihoods, said: float, spread: float, walked: float
) -> Weights:
    prior, noise = model.way_log_sd**2, spread**2
    centre, whole = math.log(WAY_METRES), math.hypot(spread, model.way_log_sd)
    ratio = _density((said - centre - _FACTOR_ROW) / whole) / whole
    ratio /= _said_of_any(model, said, spread)
    if walked > FEWEST_METRES:
        true = math.log(walked)
        mean = (prior * (said - _FACTOR_ROW) + noise * centre) / (prior + noise)
        sd = math.sqrt(prior * noise / (prior + noise))
        on = np.array([_beyond((true - each) / sd) for each in mean])
        ratio *= on / max(_beyond((true - centre) / model.way_log_sd), LEAST_BEYOND)
    return _fixed((1 - model.length_outlier) * ratio + model.length_outlier)


def _fixed(ratio: Weights) -> Weights:
    """Keep what many share from being changed by one."""
    ratio.flags.writeable = False
    return ratio


@lru_cache(maxsize=4096)
def _said_of_any(model: Likelihoods, said: float, spread: float) -> float:
    """Return how likely a length is said of any way, by any speaker."""
    whole = math.hypot(spread, model.way_log_sd)
    off = (said - math.log(WAY_METRES) - _FACTOR_ROW) / whole
    density = _density(off) / whole
    return max(float((model.speakers[0] * density).sum()), LEAST_SAID)


def _density(z: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the normal density, without its constant."""
    return np.exp(-0.5 * z * z)


def _beyond(z: float) -> float:
    return 0.5 * math.erfc(z / math.sqrt(2))


def _log_metres(metres: float) -> float:
    return math.log(max(metres, FEWEST_METRES))


def _expected(length: Length) -> float:
    """Return the metres that one stretch is expected to have."""
    return length.metres * (OF_A_BOUND if length.at_most else 1.0) / length.stretches


def _spread(model: Likelihoods, length: Length) -> float:
    """Return the standard deviation of the logarithm of what is said."""
    wide = length.at_most or length.stretches > 1
    units = 2 if wide else {"metres": 0, "steps": 1}.get(length.unit, 2)
    return (model.length_sd + units * model.unit_sd) * (1.0 + length.doubt)


# -- counts


def ordinal_ratio(
    model: Likelihoods, turn: Turn, on_side: int, of_all: int, choices: Choices
) -> float | Weights:
    """Weigh `the second left` against the openings met, this one included."""
    if turn.ordinal is None:
        return 1.0
    if turn.ordinal == -1:
        right = model.kind_right
        return (1 - right) * 2 if choices.forward is not None else 2 * right
    count = _count(model.count_right, _ordinals(turn))
    return np.where(_ONE_SIDE, count.at(on_side - 1), count.at(of_all - 1))


def ordinal_to_come(
    model: Likelihoods, turn: Turn, on_side: int, of_all: int
) -> Weights:
    """Weigh a count where so many openings were passed already, and the turn is to come."""
    if turn.ordinal is None or turn.ordinal < 0:
        return np.ones(len(SPEAKERS))
    count = _count(model.count_right, _ordinals(turn))
    return np.where(_ONE_SIDE, count.beyond(on_side), count.beyond(of_all))


def _ordinals(turn: Turn) -> tuple[int, ...]:
    """Return how many openings are passed before the one told, in each reading."""
    told = (turn.ordinal, turn.or_ordinal)
    return tuple(each - 1 for each in told if each is not None)


def passings_ratio(
    model: Likelihoods,
    passings: Sequence[Passing],
    left: int,
    right: int,
    crossings: int,
    *,
    going_on: bool = False,
) -> float:
    """Weigh the openings said to be left alone against those left alone.

    Where the way goes on, those that are missing may still come.
    """
    told: dict[str | None, int] = {}
    doubt = 0.0
    for passing in passings:
        if passing.count is not None:
            told[passing.side] = told.get(passing.side, 0) + passing.count
            doubt = max(doubt, passing.doubt)
    ratio = 1.0
    for side, count in told.items():
        met = left if side == "left" else right if side == "right" else crossings
        if met == count or (going_on and met < count):
            ratio *= 1.6
        else:
            off = count - met if count > met else 0.5 * (met - count)
            ratio *= max(1.0 - 0.45 * off, 0.12)
    return ratio ** (1.0 - doubt)


class _Count:
    """How a number said weighs for each number that may be true.

    Each is half as often true as the one before it. What is to come is worth the mean of
    what it may turn out to be.
    """

    def __init__(self, right: float, told: tuple[int, ...]) -> None:
        told = tuple(min(each, MOST_TOLD) for each in told)
        numbers = np.arange(max(told) + MOST_BEYOND)
        usual = 0.5 ** (numbers + 1.0)
        usual[-1] *= 2
        said = [
            max(_count_right(right, abs(int(n) - each)) for each in told)
            for n in numbers
        ]
        ratios = np.array(said) / float((usual * said).sum())
        beyond = (usual * ratios)[::-1].cumsum() / usual[::-1].cumsum()
        self._at, self._beyond = ratios.tolist(), beyond[::-1].tolist()

    def at(self, number: int) -> float:
        """Weigh that so many it is."""
        return float(self._at[min(number, len(self._at) - 1)])

    def beyond(self, number: int) -> float:
        """Weigh that so many it is, or more."""
        return float(self._beyond[min(number, len(self._beyond) - 1)])


_count = lru_cache(maxsize=1024)(_Count)


def _count_right(right: float, off: float) -> float:
    if off < 0.5:
        return right
    wrong = 1.0 - right
    if off < 1.5:
        return ONE_OFF * wrong
    return max((1.0 - ONE_OFF) * wrong, 0.01) / off


# -- turns and kinds of place


def way_ratio(turn: Turn, angle: float) -> float:
    """Weigh the direction of a turn told against the angle of a way out, left positive.

    0 where the direction is another one.
    """
    if turn.way == "either":
        return 0.8 if abs(angle) > FORWARD else 0.2
    if turn.way.endswith("right"):
        angle = -angle
    if angle < math.radians(-20):
        return 0.0
    if turn.way.startswith("slight"):
        off = (angle - SLANT) / SLANT_SD
        return 0.5 + 1.4 * math.exp(-0.5 * off * off)
    if angle <= FORWARD:
        return 0.0
    if angle <= SLIGHT:
        return 1.1 if turn.forced else 0.4
    return 1.8 if angle <= math.radians(125) else 1.1


def untold_bend(model: Likelihoods, angle: float) -> float:
    """Weigh a bend of the way of which nothing was said."""
    return 1 - (1 - model.bend_untold) * min(abs(angle) / BEND, 2.0)


def junction_ratio(model: Likelihoods, turn: Turn, choices: Choices) -> float:
    """Weigh the kind of junction against what was said of it."""
    goes_on = choices.forward is not None
    right, wrong = 2 * model.kind_right, 2 * (1 - model.kind_right)
    ratio = 1.0
    if turn.at_end:
        ratio *= wrong if goes_on else right
    if turn.junction == "t":
        if goes_on:
            ratio *= 2 * wrong if turn.at_end else wrong
        else:
            ratio *= right if len(choices.ways) > 1 else 0.7
    elif turn.junction == "crossing":
        if len(choices.ways) < 2:
            ratio *= wrong
        else:
            ratio *= right if goes_on else 0.7
    elif turn.junction == "corner":
        ratio *= 0.55 if goes_on and len(choices.ways) > 1 else 1.2
    if turn.forced:
        forced = len(choices.ways) == 1
        ratio *= right if forced else wrong if goes_on else 0.6
    return ratio


# -- things


class Heard(NamedTuple):
    """What something weighs if it is said by a careful speaker, and by another one."""

    careful: float
    careless: float

    def __mul__(self, other: object) -> "Heard":  # pyright: ignore[reportIncompatibleMethodOverride]
        """Weigh two things said, or one of them by a number."""
        if isinstance(other, Heard):
            return Heard(self.careful * other.careful, self.careless * other.careless)
        assert isinstance(other, float | int)
        return Heard(self.careful * other, self.careless * other)

    def __pow__(self, power: float) -> "Heard":
        """Weigh it more, or less."""
        return Heard(self.careful**power, self.careless**power)

    def or_else(self, other: "Heard", chance: float) -> "Heard":
        """Weigh what is so with some chance, and else is another thing."""
        return Heard(
            chance * self.careful + (1 - chance) * other.careful,
            chance * self.careless + (1 - chance) * other.careless,
        )

    @property
    def of_all(self) -> Weights:
        """Of every speaker there may be."""
        if self == NOTHING:
            return _ALIKE
        return np.where(_CAREFUL, self.careful, self.careless)


NOTHING = Heard(1.0, 1.0)
_ALIKE = _fixed(np.ones(len(SPEAKERS)))


@lru_cache(maxsize=4096)
def seen_ratio(
    rate: float,
    reach: float,
    there: float,
    most: float = MOST_SEEN,
) -> float:
    """Weigh that a thing said was seen where it should be.

    `rate` is how often such a thing is met per metre in this building, `reach` the metres
    of way on which it would count, `there` how likely it is seen if it was said.
    """
    by_chance = 1.0 - math.exp(-rate * reach)
    ratio = (there + (1 - there) * by_chance) / by_chance
    return min(ratio, most)


def seen_as_said(
    model: Likelihoods, rate: float, reach: float, detected: float
) -> Heard:
    """Weigh that a thing said was seen where it should be, for each kind of speaker.

    `detected` is how likely it is seen if it is there.
    """
    return Heard(
        seen_ratio(rate, reach, (1 - model.invented) * detected),
        seen_ratio(rate, reach, (1 - model.invented_carelessly) * detected),
    )


def not_seen(model: Likelihoods, detected: float) -> Heard:
    """Weigh that it was not seen though it was looked for: overlooked, or invented."""
    return Heard(
        1 - (1 - model.invented) * detected,
        1 - (1 - model.invented_carelessly) * detected,
    )
