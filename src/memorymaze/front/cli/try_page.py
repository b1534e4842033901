"""`memorymaze try`: a page to tell the robot a way, and to watch what it makes of it."""

import argparse

from memorymaze.front.cli.agent_options import (
    add_agent_options,
    add_episode_options,
    agent_settings,
    given_settings,
    one_episode_settings,
)
from memorymaze.front.cli.served_page import (
    add_port,
    check_can_serve,
    serve,
)
from memorymaze.front.cli.verbs import Verbs

SHOWN_PEOPLE = ("memory", "wrong", "empty")


def add_parser(verbs: Verbs) -> None:
    """Add the verb to the command line."""
    verbs.add_parser(
        "try",
        help="a page to tell the robot a way and to watch it",
        description="Serve a page on which anyone can tell the robot a way and watch "
        "it follow, on the plan and through its camera, with what it understood, "
        "believes and says.",
        epilog="example: memorymaze try --site university --port 8000",
        options=_add_options,
    )


def _add_options(parser: argparse.ArgumentParser) -> None:
    parser.usage = "%(prog)s [OPTION …]"
    parser.add_argument(
        "--site",
        metavar="SITE",
        action="append",
        help="a shipped site, or a plan file; may be given several times (default: all "
        "shipped ones)",
    )
    parser.add_argument(
        "--host",
        default="127.0.0.1",
        metavar="ADDRESS",
        help="where to serve (127.0.0.1: for this machine alone)",
    )
    add_port(parser)
    parser.add_argument(
        "--robots",
        type=int,
        default=3,
        metavar="N",
        help="visitors at a time; each robot takes some 600 MB (3)",
    )
    parser.add_argument(
        "--agent",
        metavar="NAME",
        help="follow the same text with this agent too, such as code_generation with "
        "--model; explorer always does",
    )
    add_agent_options(parser)
    add_episode_options(parser)
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> None:
    from memorymaze.basics.errors import SettingsError
    from memorymaze.language.models.model_settings import ModelSettings
    from memorymaze.runs.episodes.agent_catalogue import choose_agent
    from memorymaze.runs.episodes.arena import checked_eyes
    from memorymaze.runs.episodes.named_settings import model_settings
    from memorymaze.runs.episodes.settings import AgentSettings
    from memorymaze.world.looks.catalogue import check_looks
    from memorymaze.world.sites import load_site, load_sites, sites_by_name

    check_can_serve("the page to try")
    from memorymaze.web.serving.web import THIS_MACHINE, make_app
    from memorymaze.web.try_page.pages import TRYING_ROOM, TryPages, ways_of
    from memorymaze.web.try_page.sessions import Visits
    from memorymaze.web.try_page.walk import GUIDE

    if options.robots < 1:
        raise SettingsError(f"--robots: expected 1 or more, got {options.robots}")
    sites = (
        load_sites()
        if options.site is None
        else sites_by_name(map(load_site, options.site))
    )
    for site in sites.values():
        if not ways_of(site):
            raise SettingsError(
                f"--site: expected a plan with a reference route, got none in {site.source}; "
                "draw one with memorymaze sites edit"
            )
    settings = one_episode_settings(options)
    if settings.robot is not None:
        raise SettingsError(
            "--robot: the page to try shows the simulated robot alone; leave it out, or see "
            "memorymaze navigate"
        )
    if settings.passers_by not in SHOWN_PEOPLE:
        raise SettingsError(
            f"passers_by: expected one of {', '.join(SHOWN_PEOPLE)} on this page, got "
            f"{settings.passers_by!r}; see memorymaze navigate"
        )
    beside = [AgentSettings("explorer")]
    if options.agent is not None:
        beside.append(agent_settings(options))
    elif options.set or model_settings(given_settings(options)) != ModelSettings():
        raise SettingsError(
            "options of an agent: expected with --agent, got them alone"
        )
    # What cannot be made is refused before a visitor waits for it.
    checked_eyes(settings)
    if settings.looks is not None:
        check_looks(settings.looks)
    for agent in (GUIDE, *beside):
        choose_agent(agent).make(isolate=settings.isolate)
    hosts = THIS_MACHINE if options.host in THIS_MACHINE else None
    with Visits(settings, beside, most=options.robots) as visits:
        app = make_app(TryPages(visits, sites).routes(), TRYING_ROOM, hosts=hosts)
        serve(app, "try the robot", host=options.host, port=options.port)
