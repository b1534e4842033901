"""A grammar that holds vision models to answers that can be read, in GBNF."""

import functools

from memorymaze.agents.navid.motions import Motions


@functools.cache
def reply_grammar(motions: Motions) -> str:
    """Return the grammar of the JSON object that the prompt asks for.

    Args:
        motions: The primitives; only whole multiples can be answered.
    """
    rules = [
        r'root ::= "{\"reason\": \"" reason "\", \"action\": \"" action "}"',
        "reason ::= [A-Z] [a-zA-Z0-9 ,.'-]{4,140}",
        r'action ::= "stop\"" | forward | turn',
        rf'forward ::= "forward\", \"amount\": " {_one_of(motions.amounts("forward"))}',
        r'turn ::= ("left" | "right") "\", \"amount\": " '
        + _one_of(motions.amounts("left")),
    ]
    return "\n".join(rules) + "\n"


def _one_of(amounts: tuple[int, ...]) -> str:
    return "(" + " | ".join(f'"{amount}"' for amount in amounts) + ")"
