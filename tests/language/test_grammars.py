"""Whatever a grammar allows is a program that runs, or steps that are read."""

import random
import re
from collections.abc import Callable
from functools import partial

import pytest

from memorymaze.errors import EpisodeOver
from memorymaze.language.grammars import program_grammar, steps_grammar
from memorymaze.language.reply_reading import read_program, read_steps
from memorymaze.language.sandbox import run_program
from memorymaze.robot.specification import API_NAMES

TOKEN = re.compile(r'"(?:\\.|[^"\\])*"|\[[^\]]*\]|\{\d+(?:,\d+)?\}|[\w-]+|[()|?*+]')


class Sentences:
    """Says random sentences of a grammar in GBNF, as far as our grammars use it."""

    def __init__(self, grammar: str, rng: random.Random) -> None:
        rules = re.findall(r"^([\w-]+) ::= (.*)$", grammar, re.MULTILINE)
        self.rules = {name: TOKEN.findall(text) for name, text in rules}
        self.rng = rng

    def say(self, name: str = "root") -> str:
        text, end = self._choice(self.rules[name], 0)
        assert end == len(self.rules[name])
        return text()

    def _repeat(self, part: Callable[[], str], low: int, high: int) -> str:
        return "".join(part() for _ in range(self.rng.randint(low, high)))

    def _choice(self, tokens: list[str], at: int) -> tuple[Callable[[], str], int]:
        choices: list[list[Callable[[], str]]] = [[]]
        while at < len(tokens) and tokens[at] != ")":
            if tokens[at] == "|":
                choices.append([])
                at += 1
                continue
            part, at = self._part(tokens, at)
            choices[-1].append(part)
        return lambda: "".join(part() for part in self.rng.choice(choices)), at

    def _part(self, tokens: list[str], at: int) -> tuple[Callable[[], str], int]:
        token = tokens[at]
        if token == "(":
            part, at = self._choice(tokens, at + 1)
        elif token[0] == '"':
            text = token[1:-1].replace(r"\n", "\n").replace(r"\"", '"')
            part = partial(str, text)
        elif token[0] == "[":
            letters = re.sub(
                r"(.)-(.)",
                lambda m: "".join(map(chr, range(ord(m[1]), ord(m[2]) + 1))),
                token[1:-1],
            )
            part = partial(self.rng.choice, letters)
        else:
            part = partial(self.say, token)
        at += 1
        times = {"?": (0, 1), "*": (0, 5), "+": (1, 5)}
        if at < len(tokens) and (tokens[at] in times or tokens[at][0] == "{"):
            numbers = [int(each) for each in re.findall(r"\d+", tokens[at])]
            low, high = times.get(tokens[at]) or (numbers[0], numbers[-1])
            part = partial(self._repeat, part, low, high)
            at += 1
        return part, at


@pytest.mark.parametrize("seed", range(25))
def test_every_program_of_the_grammar_runs_to_its_stop(make_robot, seed: int):
    reply = Sentences(program_grammar(), random.Random(seed)).say()
    robot = make_robot(call_budget=10**6)
    with pytest.raises(EpisodeOver, match="agent"):
        run_program(read_program(reply), robot)


@pytest.mark.parametrize("seed", range(25))
def test_every_reply_of_the_grammar_is_a_list_of_steps(seed: int):
    reply = Sentences(steps_grammar(), random.Random(seed)).say()
    steps = read_steps(reply)
    assert 1 <= len(steps) <= 12
    assert len(steps) == len(reply.splitlines())


def test_the_grammar_knows_the_whole_control_api():
    grammar = program_grammar()
    assert [name for name in API_NAMES if f'"{name}(' not in grammar] == []


def test_no_program_is_longer_than_a_reply_may_be():
    longest = max(
        len(Sentences(program_grammar(), random.Random(seed)).say())
        for seed in range(300)
    )
    assert longest < 4096 * 3
