"""`memorymaze prompts`: an agent's requests to its language model, into a file."""

import argparse
import sys

from memorymaze.cli.agent_options import given_options
from memorymaze.cli.verbs import Verbs
from memorymaze.wording import counted


def add_parser(verbs: Verbs) -> None:
    """Add the verb to the command line."""
    parser = verbs.add_parser(
        "prompts",
        help="write requests for offline inference",
        description="Write what an agent would ask its language model, as a batch file "
        "for OpenAI's batch service or vLLM's run-batch: first the requests for steps; "
        "then, with the replies to these in --steps, the requests for programs.",
        epilog="example: memorymaze prompts --agent code_generation --model gpt-4o "
        "--out parse.jsonl (docs/code_generation.md has the whole way)",
    )
    parser.add_argument(
        "--agent",
        choices=["code_generation"],
        required=True,
        help="whose requests; the other agents ask while they walk",
    )
    parser.add_argument(
        "--model", metavar="NAME", required=True, help="as the server calls it"
    )
    parser.add_argument(
        "--instructions",
        metavar="FILE",
        nargs="+",
        help="JSONL files (default: the shipped texts, written by a language model)",
    )
    parser.add_argument(
        "--no-parser",
        action="store_true",
        help="ask for programs from the instructions themselves",
    )
    parser.add_argument(
        "--steps",
        metavar="FILE",
        nargs="+",
        help="replies to the requests for steps; asks for programs",
    )
    parser.add_argument(
        "--set",
        metavar="NAME=VALUE",
        action="append",
        default=[],
        help="an option of the agent (see `memorymaze agents code_generation`)",
    )
    parser.add_argument(
        "--max-completion-tokens",
        action="store_true",
        help="call the longest reply so, as OpenAI's newer models want it",
    )
    parser.add_argument("--out", metavar="FILE", required=True, help="batch file")
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> int:
    from memorymaze.agents.code_generation import (
        CodeGenerationOptions,
        CodeGenerationRequests,
    )
    from memorymaze.durable_files import write_new
    from memorymaze.evaluation.offline_inference import offline_requests
    from memorymaze.instructions.files import load_instructions
    from memorymaze.language.batch_files import read_replies
    from memorymaze.options import read_options

    given = read_options(
        CodeGenerationOptions, given_options(options.set), agent=options.agent
    )
    asked = offline_requests(
        load_instructions(options.instructions),
        CodeGenerationRequests(given, parser=not options.no_parser),
        options.model,
        None if options.steps is None else read_replies(options.steps),
        length_field="max_completion_tokens"
        if options.max_completion_tokens
        else "max_tokens",
    )
    write_new(options.out, "".join(f"{line}\n" for line in asked.lines).encode())
    for reason in asked.failed:
        print(f"memorymaze: no request: {reason}", file=sys.stderr)
    what = "steps" if asked.stage == "parse" else "programs"
    print(f"{counted(len(asked.lines), 'request')} for {what} in {options.out}")
    return 0
