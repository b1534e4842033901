"""What a run will ask and cost, said before it begins: estimates, with what they rest on."""

from collections.abc import Iterator

from memorymaze.agents.navid.agent import NavidOptions
from memorymaze.evaluation.budgets import fair_steps, fewest_answers
from memorymaze.evaluation.plan import RunPlan
from memorymaze.language.model import CompletionRequest
from memorymaze.options import read_options

SECONDS_PER_ANSWER = 2.0
"""Assumed where the time of a whole run is told."""


CHARACTERS_PER_TOKEN = 4.0
"""Assumed of English text and code."""
REPLY_TOKENS = 1000
"""Assumed of a reply, where it may be longer."""


def said_beforehand(plan: RunPlan) -> Iterator[str]:
    """Yield what is worth knowing before a run begins, a line each."""
    if plan.settings.answers is not None:
        yield str(plan.settings.answers)
    yield from filter(None, (answers_estimate(plan), cost_estimate(plan)))


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
    if agent.name != "code_generation":
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


def answers_estimate(plan: RunPlan) -> str | None:
    """Return a line on how many answers a run of the NaVid protocol asks for.

    From what walks without a mistake need to what the budget of steps allows.

    Returns:
        None for runs of other agents, and for those that replay answers.
    """
    agent = plan.settings.agent
    if agent.name != "navid" or agent.replay is not None:
        return None
    options = read_options(NavidOptions, agent.options, agent=agent.name)
    motions = options.motions
    fewest = most = 0
    for episode in plan.episodes:
        told = episode.instruction
        site = plan.sites[told.site]
        fair = fair_steps(site.routes, motions.forward_m, motions.turn_deg)
        limit = options.step_limit(fair) or 0
        perfect = fewest_answers(
            site.route(told.reference_route), motions.most, motions.turn_deg
        )
        # Where the budget does not suffice for the route, it ends the walk.
        fewest += min(perfect, limit)
        most += limit
    hours = [answers * SECONDS_PER_ANSWER / 3600 for answers in (fewest, most)]
    return (
        f"the policy will be asked about {fewest} times if it makes no mistake, and at "
        f"most about {most} times; with {SECONDS_PER_ANSWER:g} s for an answer that is "
        f"{hours[0]:.1f} to {hours[1]:.1f} hours for one worker"
    )
