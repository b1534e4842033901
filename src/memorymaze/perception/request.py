"""Read what someone asks for: "please look for the red door of the library".

From the sentence to noun phrases, one for each alternative; `noun_phrase.py` takes
these apart.
"""

import re
from dataclasses import replace
from functools import lru_cache

from memorymaze.perception.lexicon import is_adjective, is_noun, singular
from memorymaze.perception.noun_phrase import (
    NounPhrase,
    parse_words,
    plain_text,
    split_words,
    words_of,
)

_LEAD_IN = re.compile(
    r"^(?:(?:please|hey|ok(?:ay)?|robot,|can|could|do|does|did|would|you|i|we|to|now|is|"
    r"are|was|there|find|detect|locate|see|want|need|try|what|where|which|looks?|like|"
    r"such|as|for|whether|if|something|anything|visible|"
    r"(?:look|search|check|show|spot|notice|watch|scan|looking|searching)(?=\s+(?:me|for|"
    r"if|whether|at|out|a|an|the|any|some)\b)|me|at|out)\b[,:]?\s+)+"
)
_PARTITIVE = re.compile(
    r"\b(?:pairs?|rows?|sets?|groups?|bunch|banks?|lines?|couple|flights?|series|"
    r"stacks?|piles?|number|collection|kind|sort|type|piece|lots?|cluster) of\b"
)
_SAYS = re.compile(
    r"(?:^|\s)(?:(?:that|which|and)\s+)?(?:"
    r"says?|saying|reads|that read|inscribed|labell?ed|marked|(?:en)?titled|named|called|"
    r"numbered|reading(?!\s+(?:room|area|corner|lamp|table|nook))|"
    r"(?:with|bearing|has|having|showing|displaying)\s+(?:the |a |an )?(?:words?|text|"
    r"label|sign|name|number|letters?|title|inscription|writing|lettering)"
    r"(?:\s+(?:that says|that reads|saying|reading|of|for))?"
    r")(?:\s+(?:as|with|the (?:words?|text|name|number)|something like))*"
    r"\s*:?(?=\s|$)"
)
_WRITTEN_ON = re.compile(
    r"\s(?:with|has|having) (?P<words>.+?) (?:written|printed|painted|posted|engraved)"
    r"\s+on (?:it|them)$|\s(?:with|having) (?P<number>\w*\d\w*) on (?:it|them)$"
)
_AFTER_WORDS = re.compile(
    r"\s+(?:(?:written |printed |painted )?on (?:it|them|top|the (?:left|right|wall|door|"
    r"other side|side))|on (?:your|my|our) (?:left|right)|in (?:red|blue|green|white|black"
    r"|yellow|big|large|capital|bold) letters?|next to .*|above .*|near .*|beside .*)$"
)
_QUOTED = re.compile(r"\"([^\"]+)\"|(?<!\w)'([^']+(?:'s [^']+)*)'(?!\w)")
_MADE_OF = re.compile(
    r"\s(?:that|which)\s+(?:is|are|looks?)\s+|\s(?:made|built)\s+(?:out\s+)?(?:of|from)\s+|"
    r"\s(?:painted|coloured|colored)\s+(?:in\s+)?"
)
_ALTERNATIVES = re.compile(r"\s*(?:,|/|\bor\b|\band/or\b)\s*")


def without_lead_in(request: str) -> str:
    """Return what is asked for, in lower case, without "please look for" and the like.

    >>> without_lead_in("Can you see a couch?")
    'a couch'
    """
    return _LEAD_IN.sub("", plain_text(request))


@lru_cache(maxsize=4096)
def parse_request(request: str) -> tuple[NounPhrase, ...]:
    """Take a request apart into the things it would accept.

    >>> [phrase.words for phrase in parse_request("a couch or any red arm chairs")]
    [('couch',), ('red', 'arm', 'chairs')]
    >>> parse_request('door labelled "Mail Room"')[0].inscription
    ('mail', 'room')
    """
    text = _PARTITIVE.sub(" ", without_lead_in(request)).strip()
    said: list[str] = []

    def keep(found: re.Match[str]) -> str:
        said.append(found[1] or found[2])
        return " "

    rest = _QUOTED.sub(keep, text)
    if not said and (found := _WRITTEN_ON.search(rest)):
        said.append(found["words"] or found["number"])
        rest = rest[: found.start()]
    if said:
        rest = _SAYS.sub(" ", rest)
    elif (found := _SAYS.search(rest)) and split_words(rest[: found.start()]):
        said.append(_AFTER_WORDS.sub("", rest[found.end() :]))
        rest = rest[: found.start()]
    inscription = words_of(" ".join(said))
    parts = [part for part in _alternatives(rest) if split_words(part)] or [""]
    phrases = [parse_words(_described_before(part), count_first=True) for part in parts]
    return tuple(replace(phrase, inscription=inscription) for phrase in phrases)


def _alternatives(text: str) -> list[str]:
    """Cut at "or", commas and slashes; at "and" where it joins things, not colours."""
    parts: list[str] = []
    for part in _ALTERNATIVES.split(text):
        joined = part.split(" and ")
        ends = [words[-1] for words in map(split_words, joined) if words]
        if all(is_noun(singular(end)) and not is_adjective(end) for end in ends):
            parts.extend(joined)
        else:
            parts.append(part)
    return parts


def _described_before(text: str) -> list[str]:
    """Put "that is red", "made of wood" and "painted green" before the noun."""
    parts = [split_words(part) for part in _MADE_OF.split(" " + text)]
    return [word for part in parts[1:] for word in part] + parts[0]
