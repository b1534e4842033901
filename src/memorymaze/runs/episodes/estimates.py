"""What a run will ask and cost, said before it begins: estimates, with what they rest on."""

from collections.abc import Iterator

from memorymaze.agents.agent import asking_of
from memorymaze.language.models.model import CompletionRequest
from memorymaze.runs.episodes.budgets import fair_limits, perfect_steps
from memorymaze.runs.episodes.in_words import track_notes
from memorymaze.runs.episodes.plan import RunPlan

SECONDS_PER_ANSWER = 2.0
"""Assumed where the time of a whole run is told."""


CHARACTERS_PER_TOKEN = 4.0
"""Assumed of English text and code."""
REPLY_TOKENS = 1000
"""Assumed of a reply, where it may be longer."""


def said_beforehand(plan: RunPlan) -> Iterator[str]:
    """Yield what is worth knowing before a run begins, a line each."""
    yield from track_notes(plan.settings)
    if plan.settings.answers is not None:
        yield str(plan.settings.answers)
    yield from filter(None, (answers_estimate(plan), cost_estimate(plan)))


def cost_estimate(plan: RunPlan) -> str | None:
    """Return a line on what a run's model will cost, at the prices that were given.

    None where no prices were given, or nothing is asked.
    """
    settings = plan.settings.agent.language_model
    price = settings.price
    if price is None or settings.replay is not None:
        return None
    limit = settings.max_cost
    end = "" if limit is None else f"; the run ends when {limit:g} USD are spent"
    if plan.settings.passers_by == "model":
        return (
            "cost: cannot be told beforehand, because nobody knows how many people will "
            f"be asked{end or '; set --max-cost'}"
        )
    requests: list[CompletionRequest] = []
    for episode in plan.episodes:
        # Agents that ask before the robot moves can tell what.
        asked = asking_of(plan.ready.agent, episode.instruction.text).requests
        if asked is None:
            return (
                f"cost: cannot be told beforehand, because {plan.settings.agent.name} "
                "asks again and again until it arrives or gives up"
                f"{end or '; set --max-cost'}"
            )
        requests += asked
    read = sum(map(_characters, requests)) / CHARACTERS_PER_TOKEN
    written = sum(min(REPLY_TOKENS, each.max_tokens) for each in requests)
    most = sum(each.max_tokens for each in requests)
    about, at_most = (price.cost(round(read), tokens) for tokens in (written, most))
    return (
        f"cost: about {about:.2f} USD, an ESTIMATE for {len(requests)} requests of the "
        f"whole run, answers kept included, of {read:.0f} tokens together "
        f"({CHARACTERS_PER_TOKEN:g} characters a token) and {REPLY_TOKENS} tokens a reply; "
        f"{at_most:.2f} USD if every reply is as long as it may be{end}"
    )


def _characters(request: CompletionRequest) -> int:
    return sum(len(message.content) for message in request.messages)


def answers_estimate(plan: RunPlan) -> str | None:
    """Return a line on how many answers agents ask for that go step by step.

    From what walks without a mistake need to what the budget of steps allows.

    None for runs of other agents, and for those that replay answers.
    """
    agent = plan.settings.agent
    if "steps" not in plan.settings.needs or agent.language_model.replay is not None:
        return None
    fewest = most = 0
    for episode in plan.episodes:
        told = episode.instruction
        site = plan.sites[told.site]
        asking = asking_of(plan.ready.agent, told.text, fair_limits(site.routes))
        if asking.stride is None or asking.most is None:
            return None
        way = site.find_route(told.reference_route)
        # The last answer says stop.
        perfect = perfect_steps(way, *asking.stride) + 1
        # Where the budget does not suffice for the route, it ends the walk.
        fewest += min(perfect, asking.most)
        most += asking.most
    hours = [answers * SECONDS_PER_ANSWER / 3600 for answers in (fewest, most)]
    return (
        f"the policy will be asked about {fewest} times in the whole run, answers kept "
        f"included, if it makes no mistake, and at most about {most} times; with "
        f"{SECONDS_PER_ANSWER:g} s for an answer that is "
        f"{hours[0]:.1f} to {hours[1]:.1f} hours for one worker"
    )
