"""Random sentences of a grammar in GBNF."""

import random
import re
from collections.abc import Callable
from functools import partial

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
