"""Making instructions for runs: by the grammar, or by a language model."""

from memorymaze.evaluation.generation.making import Made, make_instructions
from memorymaze.evaluation.generation.request import GRAMMAR, GenerationRequest

__all__ = ["GRAMMAR", "GenerationRequest", "Made", "make_instructions"]
