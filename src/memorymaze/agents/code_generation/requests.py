"""What code generation asks a language model, word for word, and its variants.

The agent asks with these requests, and `memorymaze answers requests` writes them to
files, so that inference online and offline cannot differ.
"""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from memorymaze.agents.agent import tellings_of
from memorymaze.agents.code_generation.replies import program_grammar, steps_grammar
from memorymaze.basics.options import check_least, check_number
from memorymaze.language.models.model import CompletionRequest, Message, ModelQuestion
from memorymaze.language.models.prompt_texts import load_prompt, prompt_version
from memorymaze.robot.api.specification import api_specification

_FIRST_STAGE = re.compile(r"^First (\w+):\n.*?^Refined \1:", re.MULTILINE | re.DOTALL)
"""In an example: from the first output to where the refined one begins."""


@dataclass(frozen=True, slots=True)
class CodeGenerationOptions:
    """How the language model is asked."""

    parser: bool | None = None
    """Whether the instruction is parsed into steps first; none for as recorded answers
    were given, else true."""
    stages: Literal["two", "single"] = "two"
    """Prompting in two stages as in the paper (thought, output, second thought, refined
    output), or in a single one (thought, output)."""
    repair: bool = False
    """Whether a program that fails is mended once, by a second inference that is told the
    error and what the robot did until then."""
    temperature: float = 0.0
    """Of all requests."""
    max_tokens: int = 4096
    """Longest reply to a request, all its parts together."""
    seed: int | None = None
    """Passed to the model; none sends no seed."""
    grammar: bool = True
    """Whether models that can be held to a grammar (local ones, and servers with
    `grammar`) are held to well-formed steps and programs, which leaves no room for
    thoughts."""

    def __post_init__(self) -> None:
        """Refuse values without meaning."""
        check_number("--set temperature", self.temperature, 0, 2)
        check_least(self, max_tokens=1)


class CodeGenerationRequests:
    """Makes the requests of one variant of code generation."""

    def __init__(
        self,
        options: CodeGenerationOptions | None = None,
        *,
        with_people: bool = False,
    ) -> None:
        """Prepare the prompts; with people, programs are told how to ask them."""
        self.options = options or CodeGenerationOptions()
        self.parser = self.options.parser is not False
        self._parsing = self._prompt("parse_instruction", "steps")
        specification = api_specification(with_people=with_people).strip()
        self._writing = self._prompt(
            "write_program", "program", api_specification=specification
        )

    @property
    def variant(self) -> str:
        """What tells this variant from the plain one in tables, such as `+parser`."""
        single = "+single_stage" * (self.options.stages == "single")
        return "+parser" * self.parser + single + "+repair" * self.options.repair

    def parse(self, instruction: str) -> CompletionRequest:
        """Return the request that turns an instruction into steps."""
        turns = [_told("Description", instruction)]
        return self._request(
            "parse", self._parsing, turns, steps_grammar(), instruction
        )

    def program(self, way: str) -> CompletionRequest:
        """Return the request for a program."""
        turns = [_told("Way", way)]
        return self._request("program", self._writing, turns, program_grammar(), way)

    def repair(
        self, way: str, reply: str, error: str, done: Sequence[str]
    ) -> CompletionRequest:
        """Return the request for a program in the place of one that failed."""
        if done:
            where = load_prompt("repair_on_the_way", calls="\n".join(done))
        else:
            where = load_prompt("repair_at_the_start")
        said = load_prompt("repair_program", error=error, where=where)
        turns = [_told("Way", way), Message("assistant", reply), Message("user", said)]
        return self._request("repair", self._writing, turns, program_grammar(), way)

    def _prompt(self, name: str, output: str, **slots: str) -> str:
        single = self.options.stages == "single"
        form = load_prompt(f"answer_{output}{'_single_stage' * single}")
        prompt = load_prompt(name, answer=form, **slots)
        if not single:
            return prompt
        return _FIRST_STAGE.sub(lambda stage: f"{stage[1].capitalize()}:", prompt)

    def _request(
        self,
        stage: str,
        prompt: str,
        turns: Sequence[Message],
        grammar: str,
        told: str,
    ) -> CompletionRequest:
        variant = self.variant.removesuffix("+repair")
        told_twice = [load_prompt("told_twice")] if len(tellings_of(told)) > 1 else []
        return CompletionRequest(
            messages=(Message("system", prompt), *turns),
            temperature=self.options.temperature,
            max_tokens=self.options.max_tokens,
            seed=self.options.seed,
            grammar=grammar if self.options.grammar else None,
            question=ModelQuestion(
                stage + variant, prompt_version(prompt, *told_twice)
            ),
        )


def _told(heading: str, text: str) -> Message:
    """Return what was told as it is quoted to the model: once, or twice."""
    tellings = [_quote(each) for each in tellings_of(text)]
    if len(tellings) == 1:
        return Message("user", f"{heading}:\n{tellings[0]}")
    first, second = tellings
    told = ["First telling:", first, "Second telling:", second]
    return Message("user", "\n".join([f"{heading}:", load_prompt("told_twice"), *told]))


def _quote(text: str) -> str:
    """Return a text between quotes that it cannot close."""
    quotes = '"""'
    while quotes in text:
        quotes += '"'
    return f"{quotes}\n{text.strip()}\n{quotes}"
