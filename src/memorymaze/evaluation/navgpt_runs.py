"""From the settings of a run to NavGPT on the graph of a site."""

from collections.abc import Callable
from dataclasses import replace

from memorymaze.agents.navgpt import NavGPTAgent, NavGPTOptions
from memorymaze.evaluation.graph_agents import NavGPTOnGraph
from memorymaze.evaluation.language_models import build_language_model
from memorymaze.evaluation.settings import AgentSettings
from memorymaze.instructions.records import Episode
from memorymaze.language.answers import AboutInstruction


def navgpt_for_runs(
    settings: AgentSettings, options: NavGPTOptions
) -> Callable[[Episode], NavGPTOnGraph]:
    """Return what makes the agent of an episode, and what describes what it sees.

    Raises:
        SettingsError: No model is named, or a file cannot be used.
    """
    model = build_language_model(settings)
    describe = None
    if options.captions == "vision":
        from memorymaze.evaluation.vision_captions import CaptionStore, VisionCaptions

        looking = model
        if options.caption_model is not None:
            looking = build_language_model(
                replace(settings, model=options.caption_model)
            )
        store = CaptionStore(options.caption_file)
        describe = VisionCaptions(looking, store).in_episode

    def agent_for(episode: Episode) -> NavGPTOnGraph:
        asked = AboutInstruction(model, episode.instruction.id)
        return NavGPTOnGraph(NavGPTAgent(asked, options), describe)

    return agent_for
