"""Made-up instructions: right ones from routes, and the same with known errors."""

from memorymaze.instructions.generation.drafting import Cell, Draft, cells_of, drafts
from memorymaze.instructions.generation.grammar import instructions_of, write_draft
from memorymaze.instructions.generation.kinds import (
    ERROR_KINDS,
    SURFACE_KINDS,
    kinds_of,
    meaning_of,
)
from memorymaze.instructions.generation.rates import ErrorRates, parse_rates

__all__ = [
    "ERROR_KINDS",
    "SURFACE_KINDS",
    "Cell",
    "Draft",
    "ErrorRates",
    "cells_of",
    "drafts",
    "instructions_of",
    "kinds_of",
    "meaning_of",
    "parse_rates",
    "write_draft",
]
