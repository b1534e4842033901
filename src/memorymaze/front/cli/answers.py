"""`memorymaze answers`: requests to language models in files, and what came back."""

import argparse
import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from memorymaze.basics.extras import command_here
from memorymaze.basics.wording import counted
from memorymaze.front.cli.agent_options import agent_settings, episode_settings
from memorymaze.front.cli.verbs import Verbs, add_corpus_options

if TYPE_CHECKING:
    from memorymaze.runs.episodes.plan import RunPlan


def add_parser(verbs: Verbs) -> None:
    """Add the verb to the command line."""
    parser = verbs.add_parser(
        "answers",
        help="write requests of agents to files, read answers, and check them",
        description="Have language models answer without a network between them and "
        "the robot: write what an agent would ask as a batch file for OpenAI's batch "
        "service or vLLM's run-batch, read the replies into a store, and again, until "
        "nothing is open; `memorymaze evaluate --replay STORE` runs them.",
        epilog="example: memorymaze answers requests --agent code_generation --model "
        "gpt-4o --store answers.jsonl --out requests.jsonl (docs/language_models.md "
        "has the whole way)",
    )
    actions = parser.add_subparsers(title="actions", metavar="ACTION", required=True)
    _add_requests(actions)
    _add_import(actions)
    _add_check(actions)


def _add_requests(actions: Verbs) -> None:
    parser = actions.add_parser(
        "requests",
        help="write what is open",
        description="Write the next request of each episode to which the store has no "
        "answer. Agents that ask while they walk are followed to that point.",
        epilog="example: memorymaze answers requests --agent code_generation --model "
        "gpt-4o --store answers.jsonl --out requests.jsonl",
    )
    parser.add_argument(
        "--model", metavar="NAME", required=True, help="as the server calls it"
    )
    parser.add_argument(
        "--store", metavar="FILE", required=True, help="answers so far; made if missing"
    )
    _add_what(parser, agent=None)
    parser.add_argument(
        "--max-completion-tokens",
        action="store_true",
        help="call the longest reply so, as OpenAI's newer models want it",
    )
    parser.add_argument("--out", metavar="FILE", required=True, help="batch file")
    parser.set_defaults(run=_write_requests)


def _add_import(actions: Verbs) -> None:
    parser = actions.add_parser(
        "import",
        help="read replies into a store",
        description="Read the replies to `memorymaze answers requests` into the store "
        "that it kept the requests in. Requests that failed stay open.",
        epilog="example: memorymaze answers import replies.jsonl --store answers.jsonl "
        "(what a server replied to requests.jsonl)",
    )
    parser.add_argument("replies", metavar="REPLIES", nargs="+", help="JSONL")
    parser.add_argument("--store", metavar="FILE", required=True)
    parser.set_defaults(run=_import_replies)


def _add_check(actions: Verbs) -> None:
    parser = actions.add_parser(
        "check",
        help="check answers",
        description="Say which instructions lack answers, which answers were given to "
        "another version of the prompt, and how episodes will end before the robot "
        "moves: each program is checked as the sandbox does, and not run.",
        epilog="example: memorymaze answers check answers.jsonl (a store that "
        "`memorymaze answers import` filled)",
    )
    parser.add_argument("file", metavar="FILE", help="recorded, or written by hand")
    parser.add_argument("--model", metavar="NAME", help="of a file with several")
    _add_what(parser, agent="code_generation")
    parser.set_defaults(run=_check)


def _add_what(parser: argparse.ArgumentParser, agent: str | None) -> None:
    default = "" if agent is None else f" (default: {agent})"
    parser.add_argument(
        "--agent",
        metavar="NAME",
        required=agent is None,
        default=agent,
        help=f"whose requests{default}",
    )
    parser.add_argument(
        "--set",
        metavar="NAME=VALUE",
        action="append",
        default=[],
        help="an option of the agent (see `memorymaze agents NAME`)",
    )
    add_corpus_options(parser)
    # Said here again: to read it from the settings would load them for every help text.
    parser.add_argument(
        "--second-telling",
        action="store_const",
        const="true",
        help="requests of the run that hands over both tellings of a way as one text",
    )


def _plan(options: argparse.Namespace, answers: str) -> "RunPlan":
    from memorymaze.runs.episodes.plan import plan_run, settings_for
    from memorymaze.texts.corpus import load_corpus

    corpus = load_corpus(options.instructions, sites=options.sites)
    options.replay = answers
    settings = episode_settings(options, settings_for(corpus))
    return plan_run(agent_settings(options), corpus, settings)


def _write_requests(options: argparse.Namespace) -> None:
    from memorymaze.basics.durable_files import check_new_file, write_new
    from memorymaze.language.models.answer_files import AnswerFile
    from memorymaze.language.models.batch_files import request_line
    from memorymaze.runs.episodes.open_requests import open_requests

    answers = options.store
    if not Path(options.store).exists():
        check_new_file(Path(options.out))
        # It answers as much as a new store, which is made when all else can be used.
        answers = os.devnull
    plan = _plan(options, answers)
    store = AnswerFile.sound(options.store, make=True)
    length = "max_completion_tokens" if options.max_completion_tokens else "max_tokens"
    asked = {
        store.ask(options.model, request): request for request in open_requests(plan)
    }
    lines = [
        request_line(identifier, options.model, request, length_field=length)
        for identifier, request in asked.items()
    ]
    if lines:
        write_new(options.out, "".join(f"{line}\n" for line in lines).encode())
        print(f"{counted(len(lines), 'request')} in {options.out}")
    else:
        print(f"nothing is open: {command_here()} evaluate --replay {options.store}")


def _import_replies(options: argparse.Namespace) -> None:
    from memorymaze.basics.errors import AnswerFileError
    from memorymaze.basics.input_files import refusal
    from memorymaze.language.models.answer_files import AnswerFile
    from memorymaze.language.models.batch_files import read_replies

    store = AnswerFile.sound(options.store)
    replies = read_replies(options.replies).values()
    problems: list[str] = []
    failed = 0
    for reply in replies:
        if reply.completion is None:
            failed += 1
            print(f"memorymaze: no answer: {reply.id}: {reply.error}", file=sys.stderr)
            continue
        try:
            store.answer(reply.id, reply.completion)
        except ValueError as error:
            problems.append(f"{reply.place}: {error}")
    if problems:
        raise refusal(problems, AnswerFileError)
    print(f"{counted(len(replies) - failed, 'answer')} in {options.store}")
    if failed:
        print(f"{counted(failed, 'request')} failed and stay open")


def _check(options: argparse.Namespace) -> int:
    from memorymaze.basics.errors import AnswerFileError
    from memorymaze.runs.episodes.open_requests import remarks_on

    try:
        plan = _plan(options, options.file)
    except AnswerFileError as error:
        print(f"{error}\nthe file cannot be run so")
        return 1
    kinds = {"crash": 0, "unsafe": 0, "model_error": 0, "note": 0}
    for remark in remarks_on(plan):
        kinds[remark.kind] += 1
        print(f"{remark.kind}: {remark.text}")
    print(f"{counted(len(plan.episodes), 'episode')}; {plan.settings.answers}")
    print(
        f"before their robot moves {kinds['crash']} will crash, {kinds['unsafe']} are "
        f"unsafe, and {kinds['model_error']} have no answer that can be used"
    )
    return int(sum(kinds.values()) > kinds["note"])
