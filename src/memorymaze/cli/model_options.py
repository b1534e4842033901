"""Options that say how a language model is asked, and what that may cost."""

import argparse
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from memorymaze.evaluation.asking import AskingSettings
    from memorymaze.evaluation.inference_time import InferenceTime

PATIENCE = ("request_timeout", "retries", "max_requests")
SPENDING = ("price", "max_cost", "max_tokens_total")


def add_model_options(parser: argparse.ArgumentParser) -> None:
    """Add the options as a group of their own."""
    group = parser.add_argument_group("what a language model takes and costs")
    group.add_argument(
        "--inference-time",
        metavar="TIME",
        help="how long the robot stands for each reply, in simulated time: measured "
        "(default), none, SECONDS, or a profile in tokens per second such as "
        "start=0.5,prompt=2000,reply=60",
    )
    group.add_argument(
        "--price",
        metavar="PROMPT,COMPLETION",
        help="what the server charges, US dollars per million tokens, such as 0.15,0.60",
    )
    group.add_argument(
        "--max-cost",
        metavar="USD",
        type=float,
        help="end the run when this is spent; what is finished is kept, and --resume "
        "goes on",
    )
    group.add_argument(
        "--max-tokens-total",
        metavar="N",
        type=int,
        help="end the run when requests and replies have had so many tokens together",
    )
    group.add_argument(
        "--max-requests",
        metavar="N",
        type=int,
        help="requests under way at once (default: one per worker)",
    )
    group.add_argument(
        "--request-timeout",
        metavar="SECONDS",
        type=float,
        help="longest wait for a reply (default: 120)",
    )
    group.add_argument(
        "--retries",
        metavar="N",
        type=int,
        help="further attempts where a server is busy, fails or is silent (default: 4)",
    )
    group.add_argument(
        "--grammar",
        metavar="SERVER",
        choices=("llama.cpp", "vllm"),
        help="have the server hold replies to well-formed steps and programs; says which "
        "kind of server it is: llama.cpp or vllm",
    )


def asking_settings(options: argparse.Namespace, *, asks: bool) -> "AskingSettings":
    """Return how the model is asked.

    Raises:
        SettingsError: A value has no meaning, or no model is asked.
    """
    from memorymaze.errors import SettingsError
    from memorymaze.evaluation.asking import AskingSettings
    from memorymaze.language.spending import parse_price

    names = (*PATIENCE, *SPENDING, "grammar")
    given = {name: getattr(options, name) for name in names}
    given = {name: value for name, value in given.items() if value is not None}
    if given and not asks:
        raise SettingsError(
            f"--{next(iter(given)).replace('_', '-')}: the agent {options.agent!r} asks "
            "no language model; leave the option out"
        )
    if "price" in given:
        given["price"] = parse_price(given["price"])
    if "request_timeout" in given:
        given["timeout"] = given.pop("request_timeout")
    return AskingSettings(**given)


def inference_time(options: argparse.Namespace, *, asks: bool) -> "InferenceTime":
    """Return how the simulated clock runs while the model thinks.

    Users' own agents may ask a model that only they know of.

    Raises:
        SettingsError: The text says nothing that is understood, or no model is asked.
    """
    from memorymaze.errors import SettingsError
    from memorymaze.evaluation.inference_time import MEASURED, parse_inference_time

    text = options.inference_time
    if text is not None and not (asks or ":" in options.agent):
        raise SettingsError(
            f"--inference-time: the agent {options.agent!r} asks no language model; leave "
            "the option out"
        )
    return MEASURED if text is None else parse_inference_time(text)
