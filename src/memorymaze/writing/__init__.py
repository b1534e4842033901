"""Made-up instructions: told from routes by a grammar or a language model, with errors.

Holds voices, phrases, mistakes and drafts. Does not hold how texts are understood
(`understanding`), nor what people really said (`instructions`).
"""

from memorymaze.writing.drafting import Cell, Draft, cells_of, drafts
from memorymaze.writing.grammar import instructions_of, write_draft
from memorymaze.writing.making import Made, make_instructions
from memorymaze.writing.request import (
    GRAMMAR,
    ErrorRates,
    GenerationRequest,
    parse_rates,
)

__all__ = [
    "GRAMMAR",
    "Cell",
    "Draft",
    "ErrorRates",
    "GenerationRequest",
    "Made",
    "cells_of",
    "drafts",
    "instructions_of",
    "make_instructions",
    "parse_rates",
    "write_draft",
]
