"""What a run sees with: its detector, its reader of signs, and the looks of things."""

from memorymaze.agents.agent import Need
from memorymaze.evaluation.settings import AgentSettings, RunSettings
from memorymaze.perception.eyes import Eyes
from memorymaze.pictures import Looks
from memorymaze.pictures.furniture.models import check_looks


def checked_eyes(settings: RunSettings) -> Eyes:
    """Return eyes that can be used here."""
    eyes = Eyes(settings.detector, settings.signs)
    if eyes.need_pictures:
        # Only these runs load OpenGL.
        from memorymaze.pictures.rendering.open_gl import choose_backend

        choose_backend()
    eyes.check()
    return eyes


def looks_of_run(
    agent: AgentSettings, needs: frozenset[Need], settings: RunSettings
) -> Looks | None:
    """Return how things look to the cameras of a run; None where nothing is drawn."""
    # An agent of a user's own that declares nothing may take pictures all the same.
    may_look = "camera" in needs or (agent.is_own and not needs)
    if not (may_look or Eyes(settings.detector, settings.signs).need_pictures):
        return None
    return check_looks(settings.looks)
