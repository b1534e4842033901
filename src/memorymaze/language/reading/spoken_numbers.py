"""Numbers as they are spoken: digit by digit, in pairs, and hours without `o'clock`."""

import re

from memorymaze.language.reading.lengths import read_number
from memorymaze.language.reading.vocabulary import CLOCK, ONES, TENS

_DIGITS = {
    **{word: value for word, value in ONES.items() if value < 10},
    "niner": 9,
    "zero": 0,
    "oh": 0,
}
_digit = "|".join(_DIGITS)
_tens = "|".join(TENS)
_teen = "|".join(word for word, value in ONES.items() if value > 9)
_one = "|".join(word for word, value in ONES.items() if value < 10)
_BY_DIGIT = re.compile(
    rf"\b(?:(?:{_digit})(?:[ -](?:{_digit})){{2,5}}|(?:{_digit})-(?:{_digit}))\b(?! ?o'clock)"
)
_pair = rf"(?:(?:{_tens})(?:[- ](?:{_one}))?|{_teen})"
_BY_PAIRS = re.compile(
    rf"\b(?P<first>{_pair})[ -](?P<second>{_pair}|(?:oh|zero)[ -](?:{_one}))\b"
)
"""`Twenty-three forty-seven`, `eleven oh eight`: the number of a room."""
_below_hundred = rf"(?:{_pair}|{_one}|\d{{1,2}})"
_HUNDREDS = re.compile(
    rf"\b(?:(?P<many>an?|{_teen}|{_one}|\d) )?hundred(?:(?: and)? (?P<rest>{_below_hundred}))?\b"
)
_HALVES = re.compile(rf"\b(?P<whole>{_below_hundred}) and a half\b")
_THOUSANDS = re.compile(r"(?<![\d.,])(\d{1,3}),(\d{3})(?![\d.,]*\d)")
_hour = "|".join(sorted((h for h in CLOCK if h.isalpha()), key=len, reverse=True))
_BY_THE_CLOCK = re.compile(
    r"\bclock (?:system|face|code|positions?|directions?|hours?)|\bby the (?:dial|clock)\b"
    r"|\bwith the clock\b"
    r"|\b(?:on|at|hold|keep|fly|steer|follow|to) twelve(?= *(?:[.,;:!?]|$|to\b|until\b|till\b|and\b|then\b))"
)
"""What shows that directions are told by the hours of a clock."""
_COUNTS = re.compile(r"(?:^|[.;] )one[,.:] .*[.;] two[,.:] ", re.DOTALL)
"""What shows that numbers count the items of a list."""
_ANNOUNCED = re.compile(
    r"(?:\b(?:all|everything|directions?|i'll do it|i do it) )?\b(?:(?:by|with|using|on) the (?:dial|clock(?: face)?)"
    r"|clock (?:system|code|positions|directions|hours)|twelve is (?:always )?(?:your nose|(?:straight |dead )?ahead|in front)"
    r"(?: of you)?)(?= *[.,;:!?])"
)
_HOUR = re.compile(
    r"(?P<verb>\b(?:come|comes|turn|turns|turning|swing|swings|go|goes|alter|steer|bear|haul|round|(?:takes?|turns?|brings?|bends|leads) you)"
    r"(?: (?:round|around|over))? (?:on)?to )?"
    r"(?P<hold>\b(?:start on|hold|keep|fly|steer|follow|on)(?: to)? (?=twelve\b))?"
    r"(?P<bound>\b(?:at|on|to|towards?|from|your|along your) )?"
    rf"(?<!room )(?<!gate )(?<!number )(?<!door )(?<!hall )\b(?P<hour>{_hour})\b"
    r"(?= *(?:[.,;:!?]|$|and\b|again\b|there\b|too\b|stays?\b|is\b|to the\b|until\b|till\b"
    r"|through\b|still\b|then\b|up\b|along\b|past\b|for\b|around\b|round\b"
    r"|at\b|by\b|near\b|when\b|where\b|once\b|before\b|after\b|into\b|onto\b|down\b))"
)
_WORDS: dict[str, str] = {
    "right": "right",
    "left": "left",
    "slight_right": "slightly right",
    "slight_left": "slightly left",
    "forward": "straight ahead",
    "behind": "turn around",
}


def with_plain_numbers(text: str) -> str:
    """Return a text in lower case with numbers and hours as others say them.

    >>> with_plain_numbers("room two-three-four-seven, then two-one metres")
    'room 2347, then 21 metres'
    >>> with_plain_numbers("two hundred and fifty feet, or 1,000 steps")
    '250 feet, or 1000 steps'
    >>> with_plain_numbers("thirty-three-oh-two, right by eleven oh eight")
    '3302, right by 1108'
    >>> with_plain_numbers("hold twelve: come to three. nine again. the door is at ten.")
    "straight ahead: turn to three o'clock. left again. the door is at ten o'clock."
    """
    text = _THOUSANDS.sub(r"\1\2", text)
    text = _HUNDREDS.sub(_joined_hundreds, text)
    text = _HALVES.sub(lambda each: f"{read_number(each['whole']) + 0.5:g}", text)
    text = _BY_PAIRS.sub(_joined_pairs, text)
    text = _BY_DIGIT.sub(_joined_digits, text)
    if not _BY_THE_CLOCK.search(text) or _COUNTS.search(text):
        return text
    return _HOUR.sub(_as_direction, _ANNOUNCED.sub("", text))


def _joined_hundreds(match: re.Match[str]) -> str:
    many, rest = match["many"], match["rest"]
    count = 1.0 if many in {None, "a", "an"} else read_number(many)
    return f"{100 * count + (read_number(rest) if rest else 0):g}"


def _joined_digits(match: re.Match[str]) -> str:
    digits = [_DIGITS[word] for word in re.split("[ -]", match[0])]
    if len(digits) == 2 and digits[1] - digits[0] == 1 and "niner" not in match[0]:
        return match[0]  # "two-three metres": a range
    return "".join(map(str, digits))


def _joined_pairs(match: re.Match[str]) -> str:
    return f"{_value(match['first'])}{_value(match['second']):02}"


def _value(words: str) -> int:
    return sum(TENS.get(word, ONES.get(word, 0)) for word in re.split("[ -]", words))


def _as_direction(match: re.Match[str]) -> str:
    """`Come to three`, `at nine`, and a bare hour, which is a bare direction."""
    hour = match["hour"]
    if match["hold"]:
        return "straight ahead"
    if match["verb"]:
        return f"turn to {hour} o'clock"
    if match["bound"]:
        return f"{match['bound']}{hour} o'clock"
    return _WORDS[CLOCK[hour]]
