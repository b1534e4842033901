"""Made-up instructions: told from routes by a grammar or a language model, with errors.

Holds voices, phrases, mistakes and outlines. Does not hold how texts are understood
(`reading`), nor what people really said (`corpus`).
"""

from memorymaze.texts.writing.grammar import write_texts
from memorymaze.texts.writing.making import Made, make_instructions
from memorymaze.texts.writing.request import (
    GRAMMAR,
    ErrorRates,
    GenerationRequest,
    parse_rates,
)
from memorymaze.texts.writing.sampling import Cell, Outline, cells_of, sample_outlines

__all__ = [
    "GRAMMAR",
    "Cell",
    "ErrorRates",
    "GenerationRequest",
    "Made",
    "Outline",
    "cells_of",
    "make_instructions",
    "parse_rates",
    "sample_outlines",
    "write_texts",
]
