"""A grammar that holds small local models to replies that can be read, in GBNF."""

from collections.abc import Sequence

from memorymaze.agents.navgpt.parsing import MOVE_ACTION


def reply_grammar(viewpoints: Sequence[str]) -> str:
    """Return the grammar of one thought with a move or a final answer."""
    rules = [
        r'root ::= "Thought: " thought "\n" (finish | move)'
        if viewpoints
        else r'root ::= "Thought: " thought "\n" finish',
        r"thought ::= [A-Z] [a-zA-Z0-9 ,.'-]{9,160}",
        'finish ::= "Final Answer: arrived"',
    ]
    if viewpoints:
        known = " | ".join(f'"{each}"' for each in viewpoints)
        rules += [
            rf'move ::= "Action: {MOVE_ACTION}\nAction Input: " id',
            f"id ::= {known}",
        ]
    return "\n".join(rules) + "\n"
