"""From the settings of a run to NavGPT on the graph of a site."""

from dataclasses import replace

from memorymaze.agents.navgpt import NavGPTAgent, NavGPTOptions
from memorymaze.evaluation.graph_agents import NavGPTOnGraph
from memorymaze.evaluation.language_models import build_language_model
from memorymaze.evaluation.settings import AgentSettings


def navgpt_for_runs(settings: AgentSettings, options: NavGPTOptions) -> NavGPTOnGraph:
    """Make the agent, and what describes to it what is seen.

    Raises:
        SettingsError: No model is named, or a file cannot be used.
    """
    model = build_language_model(settings)
    agent = NavGPTAgent(model, options)
    if options.captions == "templates":
        return NavGPTOnGraph(agent)
    from memorymaze.evaluation.vision_captions import CaptionStore, VisionCaptions

    looking = model
    if options.caption_model is not None:
        looking = build_language_model(replace(settings, model=options.caption_model))
    store = CaptionStore(options.caption_file)
    return NavGPTOnGraph(agent, VisionCaptions(looking, store).in_episode)
