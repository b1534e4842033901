"""The story of an episode: what happened, what the agent worked on, and how it ended.

Reports and replays read it; `onlooker` tells it while the episode goes on.
"""

from memorymaze.runs.story.recorded_episode import RecordedEpisode, load_episode
from memorymaze.runs.story.story import Story, story_of

__all__ = ["RecordedEpisode", "Story", "load_episode", "story_of"]
