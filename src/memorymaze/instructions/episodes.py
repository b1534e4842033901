"""Turn instructions into episodes on the sites they speak of."""

from collections.abc import Iterable, Mapping

from memorymaze.errors import did_you_mean
from memorymaze.instructions.problems import (
    InstructionProblem,
    place_of,
    refusal,
    repeated_ids,
)
from memorymaze.instructions.records import Episode, Instruction
from memorymaze.sites.records import Site


def episodes(
    instructions: Iterable[Instruction], sites: Mapping[str, Site]
) -> list[Episode]:
    """Turn instructions into episodes, in order.

    An episode starts where its reference route starts and its goal is that route's
    last point; its id is the instruction's.

    Args:
        instructions: What to follow.
        sites: Sites by name.

    Raises:
        InstructionFileError: A site or route does not exist, or an id repeats.
    """
    chosen = list(instructions)
    problems = repeated_ids(chosen) + site_problems(chosen, sites)
    if problems:
        raise refusal(problems)
    return [_episode(instruction, sites) for instruction in chosen]


def site_problems(
    instructions: Iterable[Instruction], sites: Mapping[str, Site]
) -> list[InstructionProblem]:
    """List the instructions whose site or route does not exist."""
    problems: list[InstructionProblem] = []
    for instruction in instructions:
        message = _misplaced(instruction, sites)
        if message is not None:
            problems.append(InstructionProblem(place_of(instruction), message))
    return problems


def _episode(instruction: Instruction, sites: Mapping[str, Site]) -> Episode:
    route = sites[instruction.site].route(instruction.reference_route)
    path = tuple((float(x), float(y)) for x, y, *_ in route.line.coords)
    return Episode(instruction.id, instruction, route.start, path[-1], path)


def _misplaced(instruction: Instruction, sites: Mapping[str, Site]) -> str | None:
    site = sites.get(instruction.site)
    if site is None:
        return _not_found("site", instruction.site, sites)
    routes = {route.id: route for route in site.routes}
    names = {route.route for route in site.routes}
    if instruction.route not in names:
        return _not_found("route", instruction.route, names)
    route = routes.get(instruction.reference_route)
    if route is None:
        return _not_found("reference_route", instruction.reference_route, routes)
    if route.route != instruction.route:
        fitting = sorted(r.id for r in site.routes if r.route == instruction.route)
        return (
            f"field 'reference_route': expected a way of {instruction.route} "
            f"({', '.join(fitting)}), got {route.id!r}, a way of {route.route}"
        )
    return None


def _not_found(field: str, got: str, known: Iterable[str]) -> str:
    names = sorted(known)
    return (
        f"field {field!r}: expected one of {', '.join(names)}, got {got!r}"
        f"{did_you_mean(got, names)}"
    )
