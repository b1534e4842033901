import json
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from memorymaze.agents.agent import TOLD_AGAIN, Journal
from memorymaze.agents.plan_readers import (
    BothReader,
    GrammarReader,
    LearnedReader,
    ModelReader,
    WrittenPlanReader,
    read_plan_reply,
)
from memorymaze.agents.reader_doubts import aligned_turns, with_doubted_turns
from memorymaze.basics.errors import LanguageModelError, PlanFileError
from memorymaze.front.cli.main import run_command_line
from memorymaze.front.library.walks import follow
from memorymaze.language.models.scripted_model import ScriptedLanguageModel
from memorymaze.language.plans import (
    Arrival,
    Leg,
    Mention,
    RoutePlan,
    Turn,
    parse_plan,
    plan_record,
)
from memorymaze.runs.episodes.settings import AgentSettings
from memorymaze.world.sites import Site

LEFT = '{"legs": [{"turn": {"way": "left"}}], "arrival": {"destinations": ["desk"]}}'
TEXT = "Left somewhere, and there is the desk."


def test_a_model_writes_the_plan_of_a_text() -> None:
    model = ScriptedLanguageModel([f"Here it is:\n```json\n{LEFT}\n```"])
    plan = ModelReader(model).read(TEXT, Journal())
    expected = RoutePlan(legs=(Leg(Turn("left")),), arrival=Arrival(("desk",)))
    assert plan == expected
    [asked] = model.requests
    assert asked.messages[-1].content == TEXT


def test_what_two_readers_make_of_a_text_counts_as_two_tellings_if_it_differs() -> None:
    text = (
        "Slightly left. You follow it. Bear left at the black bench. "
        "Cinema will be on the right."
    )
    readers = GrammarReader(), LearnedReader()
    plans = [each.read(text, Journal()) for each in readers]
    assert plans[0] != plans[1]
    [both] = BothReader().read_tellings(text, Journal())
    turns = [
        [[leg.turn for leg in plan.legs] for plan in each] for each in (both, plans)
    ]
    assert turns[0] == turns[1]
    twice = BothReader().read_tellings(text + TOLD_AGAIN + text, Journal())
    assert twice == [both, both]
    [[nothing]] = BothReader().read_tellings("", Journal())
    assert nothing.legs == ()


def test_a_room_that_is_only_passed_is_no_destination_once_both_have_read_the_text() -> (
    None
):
    text = "Left at room 1111. On the right there's room 1112. Human Resources, on the right."
    alone = GrammarReader().read(text, Journal())
    assert alone.arrival.destinations == ("door that says 1112",)
    [plans] = BothReader().read_tellings(text, Journal())
    assert {each.arrival.destinations for each in plans} == {("human resource",)}


def test_a_reader_that_finds_no_destination_takes_the_others() -> None:
    text = "Left at the kiosk, then right into Cedar Hall. He is at the front there."
    assert LearnedReader().read(text, Journal()).arrival.destinations == ()
    [plans] = BothReader().read_tellings(text, Journal())
    assert {each.arrival.destinations for each in plans} == {("cedar hall",)}
    assert all(each.arrival.unclear_names[0] > 0.5 for each in plans)


def test_a_name_that_both_readers_have_is_hardly_doubted() -> None:
    text = "Turn left at the kiosk, and the library is on your right."
    [plans] = BothReader().read_tellings(text, Journal())
    for plan in plans:
        assert plan.arrival.destinations == ("library",)
        assert plan.arrival.unclear_names[0] < 0.2


def test_a_word_that_only_sounds_like_a_goal_is_none() -> None:
    text = (
        "Right at the desk, then left, the second one. Mind the step, good luck, Carlo."
    )
    [plans] = BothReader().read_tellings(text, Journal())
    assert GrammarReader().read(text, Journal()).arrival.destinations
    for plan in plans:
        doubts = plan.arrival.unclear_names
        assert all(doubt > 0.5 for doubt in doubts)


def test_a_turn_that_both_readers_have_is_hardly_doubted() -> None:
    text = (
        "Turn left at the kiosk, then right at the lift. The library is on your right."
    )
    [plans] = BothReader().read_tellings(text, Journal())
    assert all(leg.unclear < 0.02 for plan in plans for leg in plan.legs)


def test_a_turn_is_doubted_more_where_the_other_reader_has_others() -> None:
    told = RoutePlan(legs=(Leg(Turn("left")), Leg(Turn("right"))))
    sure = RoutePlan(
        legs=(Leg(Turn("left"), unclear=0.01), Leg(Turn("right"), unclear=0.3))
    )
    more = RoutePlan(legs=(*told.legs, Leg(Turn("right"))))
    (left, right), (first, second) = (
        [leg.unclear for leg in each.legs] for each in with_doubted_turns(told, sure)
    )
    assert left == first < second == right
    parsed, marked = with_doubted_turns(more, sure)
    assert first < marked.legs[0].unclear < parsed.legs[2].unclear < 0.5


def test_turns_of_two_plans_correspond_in_their_order() -> None:
    one, two = (
        RoutePlan(legs=tuple(Leg(Turn(way)) for way in ways))
        for ways in (("left", "right", "left"), ("left", "left"))
    )
    assert aligned_turns(one, two) == [(0, 0), (2, 1)]
    assert aligned_turns(two, one) == [(0, 0), (1, 2)]
    assert aligned_turns(RoutePlan(), two) == []


def test_a_reply_that_is_no_plan_is_asked_for_once_more_with_what_is_wrong() -> None:
    model = ScriptedLanguageModel([LEFT.replace("left", "leftish"), LEFT])
    journal = Journal()
    assert ModelReader(model).read(TEXT, journal).legs == (Leg(Turn("left")),)
    assert "leftish" in model.requests[1].messages[-1].content
    numbers = [each.question.number for each in model.requests if each.question]
    assert numbers == [1, 2]
    assert journal.model_calls == 2


def test_a_reply_is_asked_for_once_more_only_where_what_is_missing_has_no_default() -> (
    None
):
    def told(**thing: str) -> str:
        return json.dumps({"arrival": {"mentions": [thing]}})

    whole = told(phrase="desk", kind="object", place="along")
    model = ScriptedLanguageModel([told(phrase="desk", kind="object"), whole])
    plan = ModelReader(model).read(TEXT, Journal())
    assert (plan, len(model.requests)) == (read_plan_reply(whole), 1)
    model = ScriptedLanguageModel([told(kind="object", place="along"), whole])
    assert ModelReader(model).read(TEXT, Journal()) == plan
    assert "phrase" in model.requests[1].messages[-1].content


@pytest.mark.parametrize("reply", ["I cannot.", "{]}", '{"legs": 3}', "[1, 2]"])
def test_two_replies_without_a_plan_are_the_models_failure(reply: str) -> None:
    with pytest.raises(
        LanguageModelError, match="scripted: no plan in 2 replies: plan"
    ):
        ModelReader(ScriptedLanguageModel([reply, reply])).read(TEXT, Journal())


@pytest.mark.proof
def test_the_guide_walks_the_plans_in_a_file_of_answers(
    tmp_path: Path, tiny_instructions: Path, tiny_files: list[str]
) -> None:
    """With what the grammar reads as the answers, the walks are those of the grammar."""
    answers = tmp_path / "plans.jsonl"
    with answers.open("w", encoding="utf-8") as file:
        for line in tiny_instructions.read_text("utf-8").splitlines():
            told = json.loads(line)
            plan = plan_record(GrammarReader().read(told["text"], Journal()))
            record = {"instruction_id": told["id"], "model": "somebody"}
            record |= {"stage": "plan", "reply": json.dumps(plan)}
            file.write(json.dumps(record) + "\n")
    run = ["evaluate", "--agent", "guide", "--workers", "1", *tiny_files, "--out"]
    by_grammar = ["--set", "reader=grammar"]
    assert run_command_line([*run, str(tmp_path / "grammar"), *by_grammar]) == 0
    by_model = ["--set", "reader=model", "--replay", str(answers)]
    assert run_command_line([*run, str(tmp_path / "model"), *by_model]) == 0

    def walks(name: str) -> list[tuple[object, ...]]:
        lines = (tmp_path / name / "episodes.jsonl").read_text("utf-8").splitlines()
        kept = ("episode_id", "spd", "path_length", "api_calls")
        return sorted(tuple(json.loads(line)[key] for key in kept) for line in lines)

    assert walks("model") == walks("grammar")
    [line, *_] = (tmp_path / "model" / "episodes.jsonl").read_text("utf-8").splitlines()
    assert json.loads(line)["agent"] == "guide[somebody]"


@pytest.mark.parametrize("name", ["guide", "explorer"])
def test_a_text_that_is_a_plan_is_walked_as_it_stands(
    name: str, crossing_site: Site
) -> None:
    route = crossing_site.find_route("R1")
    turns = tuple(Leg(Turn(each.direction)) for each in route.turns)
    plan = RoutePlan(legs=turns, arrival=Arrival((route.goal,)))
    agent = AgentSettings(name, options=(("reader", "plan"),))
    walk = follow(json.dumps(plan_record(plan)), agent, site=crossing_site)
    assert walk.success
    assert walk.result.agent == f"{name}[plan]"


@given(data=st.data(), name=st.sampled_from(["guide", "explorer"]))
def test_any_plan_is_walked_to_an_end(
    any_plans: st.SearchStrategy[RoutePlan],
    crossing_site: Site,
    data: st.DataObject,
    name: str,
) -> None:
    plan = json.dumps(plan_record(data.draw(any_plans)))
    agent = AgentSettings(name, options=(("reader", "plan"),))
    walk = follow(plan, agent, site=crossing_site)
    assert walk.result.error is None
    assert walk.result.stopped_by in {"agent", "budget"}


@pytest.mark.parametrize("name", ["guide", "explorer"])
def test_a_sentence_that_was_taken_for_a_thing_is_not_looked_for(
    name: str, crossing_site: Site
) -> None:
    sentence = "the red door " * 30
    walk = follow(f"Walk to the {sentence}.", name, site=crossing_site)
    assert walk.result.error is None


def test_a_reply_full_of_brackets_is_refused_at_once() -> None:
    with pytest.raises(PlanFileError, match="expected one JSON object"):
        read_plan_reply("{" * 1_000_000)


@pytest.mark.parametrize("told", ["carpet", "carpet floor"])
def test_a_floor_that_a_model_names_by_its_covering_is_a_floor(told: str) -> None:
    floor = Mention(told, kind="floor", place="along")
    plan = RoutePlan(
        legs=(Leg(Turn("left"), mentions=(floor,)),),
        arrival=Arrival(mentions=(floor, Mention("carpet", kind="object"))),
    )
    read = read_plan_reply(json.dumps(plan_record(plan)))
    told_of = [each.mentions for each in (*read.legs, read.arrival)]
    assert [[each.phrase for each in some] for some in told_of] == [
        ["carpet floor"],
        ["carpet floor", "carpet"],
    ]


def test_of_a_reply_full_of_mistakes_the_model_is_told_the_first() -> None:
    wrong = plan_record(RoutePlan(legs=(Leg(Turn("left")),) * 150))
    for leg in wrong["legs"]:
        leg["turn"]["way"] = "leftish"
    with pytest.raises(PlanFileError, match="and 130 more") as refused:
        read_plan_reply(json.dumps(wrong))
    assert len(str(refused.value)) < 4000


@pytest.mark.parametrize(
    ("legs", "expected"),
    [
        ([{"turn": {"way": "left", "ordinal": 10**400}}], "ordinal"),
        ([{"turn": {"way": "left"}, "passings": [{"count": 10**400}]}], "count"),
        ([{"turn": {"way": "left"}}] * 10_000, "at most 200 items"),
        ([{"turn": {"way": "left", "counted_after": "\ud800"}}], "whole characters"),
    ],
)
def test_what_no_speaker_means_is_no_plan(legs: object, expected: str) -> None:
    with pytest.raises(PlanFileError, match=expected):
        parse_plan({"legs": legs, "arrival": {}}, "plan")


def test_a_text_that_should_be_a_plan_and_is_none_is_refused() -> None:
    with pytest.raises(PlanFileError, match="expected one JSON object, got 'Go left"):
        WrittenPlanReader().read("Go left.", Journal())


def test_the_guide_asks_no_model_unless_it_is_its_reader(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert (
        run_command_line(["evaluate", "--agent", "guide", "--model", "some-model"]) == 2
    )
    assert "asks no language model" in capsys.readouterr().err


def test_every_recorded_plan_can_be_read() -> None:
    recorded = Path(__file__).parents[2] / "examples" / "recorded" / "plans.jsonl"
    lines = [json.loads(line) for line in recorded.read_text("utf-8").splitlines()]
    plans = [parse_plan(json.loads(each["reply"]), each["stage"]) for each in lines]
    assert len({each["instruction_id"] for each in lines}) == len(plans) == 564


def test_each_telling_is_read_by_itself_and_asked_about_by_number() -> None:
    right = LEFT.replace("left", "right")
    model = ScriptedLanguageModel([LEFT, right])
    told = ModelReader(model).read_tellings(TEXT + TOLD_AGAIN + "Or right.", Journal())
    plans = [plan for [plan] in told]
    assert [plan.legs[0].turn.way for plan in plans] == ["left", "right"]
    assert [each.messages[-1].content for each in model.requests] == [TEXT, "Or right."]
    numbers = [each.question.number for each in model.requests if each.question]
    assert numbers == [1, 2]
