"""The loop of NavGPT: observe, ask the model, go where it says, until it says "there".

Zhou, Hong, Wu 2024, "NavGPT: Explicit Reasoning in Vision-and-Language Navigation with
Large Language Models" (AAAI). What is as in its released code and what is not:
`docs/navgpt.md`.
"""

from collections.abc import Sequence
from dataclasses import asdict

from memorymaze.agents.agent import Journal
from memorymaze.agents.navgpt.parsing import MOVE_ACTION
from memorymaze.agents.navgpt.reply_grammar import reply_grammar
from memorymaze.agents.navgpt.settings import LoopLimits, NavGPTOptions
from memorymaze.agents.navgpt.walk import Walk
from memorymaze.language.model import CompletionRequest, LanguageModel, Message
from memorymaze.language.prompt_texts import load_prompt
from memorymaze.robot.viewpoints import ViewpointRobot


class NavGPTAgent:
    """Follows an instruction by asking a language model for each next viewpoint.

    It drives a `ViewpointRobot`; in a run, one is put round the simulated robot for it.
    """

    def __init__(
        self, model: LanguageModel, options: NavGPTOptions | None = None
    ) -> None:
        """Prepare the agent.

        Args:
            model: Is asked once per step.
            options: The defaults when None.
        """
        self.options = options or NavGPTOptions()
        """What was set."""
        self._model = model
        self._rules = load_prompt("navgpt_rules", move_action=MOVE_ACTION)

    @property
    def name(self) -> str:
        """`navgpt[model]+fair`, and what else is set that changes what it does."""
        options = self.options
        numbers = (
            f"+{name}={value}"
            for name in ("iterations", "scratchpad", "failures")
            if (value := getattr(options, name)) is not None
        )
        return (
            f"navgpt[{self._model.name}]+{options.budget}"
            + "+faithful" * options.faithful
            + "+vision" * (options.captions == "vision")
            + (f"[{options.caption_model}]" if options.caption_model else "")
            + "".join(numbers)
        )

    def follow(
        self,
        instruction: str,
        robot: ViewpointRobot,
        journal: Journal,
        limits: LoopLimits,
    ) -> None:
        """Go from viewpoint to viewpoint until the model says that it has arrived.

        Notes in the journal: `observation`, `model_reply`, `thought`, then `move`,
        `blocked_move`, `refused_move`, `parse_failure` or `final_answer`; at the end, in
        any case, `navgpt` with all counts.

        Raises:
            LanguageModelError: The model did not answer.
            EpisodeOver: `budget` after the last iteration, `stuck` after too many
                failures in a row, or what the robot says.
        """

        def ask(start: str, steps: str, listed: Sequence[str]) -> str:
            return self._ask(instruction, start, steps, listed, journal)

        walk = Walk(ask, robot, journal, limits, faithful=self.options.faithful)
        try:
            walk.run()
        finally:
            journal.note("navgpt", **asdict(walk.counts), **asdict(limits))

    def _ask(
        self,
        instruction: str,
        start: str,
        steps: str,
        listed: Sequence[str],
        journal: Journal,
    ) -> str:
        """Return the model's next reply; counted in the journal."""
        task = load_prompt(
            "navgpt_step",
            instruction=instruction.strip(),
            start=start,
            steps=steps.strip() or "(none yet)",
        )
        completion = self._model.complete(
            CompletionRequest(
                messages=(Message("system", self._rules), Message("user", task)),
                temperature=self.options.temperature,
                max_tokens=self.options.max_tokens,
                seed=self.options.seed,
                grammar=reply_grammar(listed) if self.options.grammar else None,
            )
        )
        journal.count(completion, stage="step")
        return completion.text
