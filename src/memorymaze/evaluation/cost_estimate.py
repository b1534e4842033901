"""What a run will cost, said before it begins: an estimate, with what it rests on."""

from memorymaze.evaluation.plan import RunPlan
from memorymaze.language.model import CompletionRequest
from memorymaze.options import read_options

CHARACTERS_PER_TOKEN = 4.0
"""Assumed of English text and code."""
REPLY_TOKENS = 1000
"""Assumed of a reply, where it may be longer."""


def cost_estimate(plan: RunPlan) -> str | None:
    """Return a line on what a run's model will cost, at the prices that were given.

    Returns:
        None where no prices were given, or nothing is asked.
    """
    agent = plan.settings.agent
    price = agent.asking.price
    if price is None or agent.replay is not None:
        return None
    limit = agent.asking.max_cost
    end = "" if limit is None else f"; the run ends when {limit:g} USD are spent"
    if agent.name != "code_generation" or agent.programs is not None:
        return (
            f"cost: cannot be told beforehand, because {agent.name} asks again and "
            f"again until it arrives or gives up{end or '; set --max-cost'}"
        )
    requests = _requests(plan)
    read = sum(map(_characters, requests)) / CHARACTERS_PER_TOKEN
    written = sum(min(REPLY_TOKENS, each.max_tokens) for each in requests)
    most = sum(each.max_tokens for each in requests)
    about, at_most = (price.cost(round(read), tokens) for tokens in (written, most))
    return (
        f"cost: about {about:.2f} USD, an ESTIMATE for {len(requests)} requests of "
        f"{read:.0f} tokens together ({CHARACTERS_PER_TOKEN:g} characters a token) and "
        f"{REPLY_TOKENS} tokens a reply; {at_most:.2f} USD if every reply is as long as it "
        f"may be{end}"
    )


def _requests(plan: RunPlan) -> list[CompletionRequest]:
    """Return what code generation will ask, with instructions in the place of steps."""
    from memorymaze.agents.code_generation import (
        CodeGenerationOptions,
        CodeGenerationRequests,
    )

    agent = plan.settings.agent
    options = read_options(CodeGenerationOptions, agent.options, agent=agent.name)
    maker = CodeGenerationRequests(options, parser=agent.parser is not False)
    requests: list[CompletionRequest] = []
    for episode in plan.episodes:
        text = episode.instruction.text
        if maker.parser:
            requests.append(maker.parse(text))
        requests.append(maker.program(text))
        if options.repair:
            requests.append(maker.program(text))
    return requests


def _characters(request: CompletionRequest) -> int:
    return sum(len(message.content) for message in request.messages)
