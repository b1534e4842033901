"""How often a run will ask its policy, said before it begins."""

from memorymaze.agents.navid.agent import NavidOptions
from memorymaze.evaluation.plan import RunPlan
from memorymaze.evaluation.step_budgets import fair_steps, fewest_answers
from memorymaze.options import read_options

SECONDS_PER_ANSWER = 2.0
"""Assumed where the time of a whole run is told."""


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
