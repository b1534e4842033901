"""The network that marks words: a small transformer encoder, run by NumPy."""

from collections.abc import Sequence
from dataclasses import dataclass, fields
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.special import log_softmax, softmax

from memorymaze.language.reading.marking.word_pieces import Word, WordPieces, cases_of

_Floats = NDArray[np.float32]
_Weights = tuple[_Floats, _Floats]

LONGEST = 512
"""Pieces of a text that are looked at at once."""
HEADS = 12
EPSILON = 1e-12


class Encoded(NamedTuple):
    """A text as numbers."""

    pieces: list[int]
    cases: list[int]
    first: list[int]
    """Which piece is the first of each word; words beyond the longest have none."""


class Judged(NamedTuple):
    """What the network makes of each word."""

    labels: NDArray[np.float64]
    """Logarithms of the probabilities, (words, states); words beyond the longest text have
    none."""
    steps: NDArray[np.float64]
    """Probabilities that a mark is of the same leg, the next, or another, (words, 3)."""


@dataclass(frozen=True)
class _Layer:
    query: _Weights
    key: _Weights
    value: _Weights
    output: _Weights
    norm: _Weights
    inner: _Weights
    outer: _Weights
    last_norm: _Weights


def encoded(pieces: WordPieces, words: Sequence[Word]) -> Encoded:
    """Return the words of a text as numbers, between the signs of its begin and end."""
    numbers, cases, first = [pieces.begin], [0], list[int]()
    for word, case in zip(words, cases_of(words), strict=True):
        parts = pieces.of(word.text)
        if len(numbers) < LONGEST - 1:
            first.append(len(numbers))
        numbers += parts
        cases += [case] * len(parts)
    most = LONGEST - 1
    return Encoded([*numbers[:most], pieces.end], [*cases[:most], 0], first)


class Network:
    """Devlin et al. 2019, "BERT", with weights of MiniLM (Wang et al. 2020) to begin with."""

    def __init__(self, path: Path) -> None:
        """Read the weights: 8-bit numbers with one factor a row."""
        with np.load(path) as stored:
            weights = {name: stored[name] for name in stored.files}
        self.pieces = WordPieces(bytes(weights.pop("vocabulary")).decode().splitlines())
        self.kinds = bytes(weights.pop("kinds")).decode().splitlines()
        """Labels of marks; of each there is a state for its first word and one for others."""
        self.follows = weights.pop("follows").astype(np.float64)
        """How likely one state follows another, (states, states)."""
        self.weights = {
            name.removesuffix(".rows"): _as_floats(weights, name)
            for name in weights
            if not name.endswith(".factors")
        }
        count = sum(name.endswith(".query.weight") for name in self.weights)
        self._layers = [
            _Layer(
                *(self._linear(f"layers.{n}.{part.name}") for part in fields(_Layer))
            )
            for n in range(count)
        ]

    def judge(self, words: Sequence[Word]) -> Judged:
        """Return what each word is likely to be."""
        text = encoded(self.pieces, words)
        state = self.weights["words"][text.pieces]
        state = state + self.weights["places"][: len(text.pieces)]
        state = _normal(state + self.weights["cases"][text.cases], self._linear("norm"))
        for layer in self._layers:
            state = _through(layer, state)
        at = state[text.first]
        labels, steps = (_times(at, self._linear(head)) for head in ("labels", "steps"))
        return Judged(
            log_softmax(labels.astype(np.float64), axis=1),
            softmax(steps.astype(np.float64), axis=1),
        )

    def _linear(self, name: str) -> _Weights:
        return self.weights[f"{name}.weight"], self.weights[f"{name}.bias"]


def _through(layer: _Layer, state: _Floats) -> _Floats:
    count, size = state.shape
    query, key, value = (
        _times(state, each).reshape(count, HEADS, size // HEADS).transpose(1, 0, 2)
        for each in (layer.query, layer.key, layer.value)
    )
    near = softmax(
        query @ key.transpose(0, 2, 1) / np.float32(np.sqrt(size // HEADS)), axis=2
    )
    seen = (near @ value).transpose(1, 0, 2).reshape(count, size)
    state = _normal(state + _times(seen, layer.output), layer.norm)
    inner = _times(state, layer.inner)
    return _normal(state + _times(_gelu(inner), layer.outer), layer.last_norm)


def _gelu(inner: _Floats) -> _Floats:
    # By tanh, as Hendrycks & Gimpel 2016 approximate it: a tenth of the time of erf.
    cubic = inner + np.float32(0.044715) * inner * inner * inner
    return (
        np.float32(0.5)
        * inner
        * (np.float32(1.0) + np.tanh(np.float32(np.sqrt(2 / np.pi)) * cubic))
    )


def _as_floats(weights: dict[str, NDArray[np.generic]], name: str) -> _Floats:
    if not name.endswith(".rows"):
        return weights[name].astype(np.float32)
    factors = weights[name.removesuffix("rows") + "factors"].astype(np.float32)
    return weights[name].astype(np.float32) * factors[:, None]


def _times(state: _Floats, weights: _Weights) -> _Floats:
    return state @ weights[0].T + weights[1]


def _normal(state: _Floats, weights: _Weights) -> _Floats:
    off = state - state.mean(axis=1, keepdims=True)
    return (
        off / np.sqrt((off**2).mean(axis=1, keepdims=True) + EPSILON) * weights[0]
        + weights[1]
    )
