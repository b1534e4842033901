"""Turns of phrase that are put in plainer words before a description is cut up."""

import re

_numbers = r"(?:\d|one|two|three|four|five|six|seven|eight|nine)"
_PLAIN_WORDS = tuple(
    (re.compile(pattern), plain)
    for pattern, plain in (
        (r"(?<!\w)'t'(?!\w)|\bt-? intersection", "t"),
        (
            r"(^|[.;,] ?)\s*(?:(?:starting |standing )?(?:from|at|in|on)"
            rf" (?:(?:position|pos|location|place|spot|p)\.? )?(?:number |#)?{_numbers},?) (?=[a-z])"
            r"(?!is |are |o'?clock|then |and |the |steps|met)",
            r"\1 ",
        ),
        (
            rf"\b(?:position|pos|location|p)\.? (?:number |#)?{_numbers}\b",
            "the destination",
        ),
        (
            r"\b(is|will be|be) " + _numbers + r"\b(?= *[.,;]|$)",
            r"\1 the destination",
        ),
        (
            r"\b(you(?: are|'re) (?:now )?at) " + _numbers + r"\b(?= *[.,;]|$)",
            r"\1 the destination",
        ),
        (
            r"\b(?:face|fave) and (?:move|go|walk) (to|past|towards?|into) "
            r"((?:the |a |an )?[a-z' -]+?)(?= *[.,;]| and | to |$)",
            r"face \2 , go \1 \2",
        ),
        (
            r"\b(intersection|junction|corner|crossing|square|block|hall|space)s?"
            r" (?:that |which )?(?:containing|contains|has|having)\b",
            r"\1 with",
        ),
        (
            r"(?:\bwith )?\byour back (?:is )?(?:to|against|towards?|facing)"
            r" (?=(?:the |a |an )?(?!(?:\w+ ){0,2}wall\b)\w)",
            "face away from ",
        ),
        (r"\b(?:orient|position|point) yourself\b", "turn"),
        (r"\bfoward\b|\bfwd\b", "forward"),
        (r"\binter?sec?tion\b|\bintesection\b", "intersection"),
        (r"(\w)[ -]+-?floored\b", r"\1 floored"),
    )
)
"""Numbered places are where one starts from or where one goes; slips of the keyboard."""


def in_plain_words(text: str) -> str:
    """Return a text in lower case with plainer words for some turns of phrase.

    >>> in_plain_words("you are at 3")
    'you are at the destination'
    """
    for pattern, plain in _PLAIN_WORDS:
        text = pattern.sub(plain, text)
    return text
