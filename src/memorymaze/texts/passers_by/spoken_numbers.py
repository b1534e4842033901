"""Numbers as people say them in passing: rounded, and in words."""

import math

LENGTH_UNITS = {
    "metres": 1.0,
    "steps": 1.4,
    "feet": 3.28,
    "yards": 1.09,
    "seconds": 0.8,
}
"""How many of a unit one metre of walking is."""
_NUMBERS = {
    2: "two",
    3: "three",
    4: "four",
    5: "five",
    6: "six",
    8: "eight",
    10: "ten",
    12: "twelve",
    15: "fifteen",
    20: "twenty",
    25: "twenty-five",
    30: "thirty",
    40: "forty",
    50: "fifty",
    60: "sixty",
    80: "eighty",
    100: "one hundred",
    120: "one hundred and twenty",
    150: "one hundred and fifty",
    200: "two hundred",
    250: "two hundred and fifty",
    300: "three hundred",
    400: "four hundred",
    500: "five hundred",
    1000: "one thousand",
}
_ORDINALS = (
    "first",
    "second",
    "third",
    "fourth",
    "fifth",
    "sixth",
    "seventh",
    "eighth",
)


def spoken_number(number: float) -> str:
    """Return in words the round number, from two, that somebody would say instead."""
    return _NUMBERS[
        min(_NUMBERS, key=lambda said: abs(math.log(said / max(number, 1))))
    ]


def ordinal_word(ordinal: int) -> str:
    """Return `second` for 2; above eight in digits, such as `12th`."""
    if ordinal <= len(_ORDINALS):
        return _ORDINALS[ordinal - 1]
    teen = 10 < ordinal % 100 < 20
    return f"{ordinal}{'th' if teen else {1: 'st', 2: 'nd', 3: 'rd'}.get(ordinal % 10, 'th')}"
