"""What cameras show in a run, which is a setting of runs that have cameras."""

from memorymaze.evaluation.agents_for_runs import agent_needs
from memorymaze.perception.eyes import TRUTH, DetectorSettings
from memorymaze.pictures.furniture.cache import Looks, looks_in_use


def looks_of_run(agent: str, detector: DetectorSettings, signs: str) -> Looks | None:
    """Return how things look to the cameras of a run; None where it has none.

    Users' own agents may take pictures, so their runs say it too.

    Raises:
        SettingsError: `MEMORYMAZE_LOOKS` asks for what is not there.
    """
    looks = looks_in_use()
    blind = detector.name == TRUTH.name and signs == "truth"
    if blind and ":" not in agent and "camera" not in agent_needs(agent):
        return None
    return looks
