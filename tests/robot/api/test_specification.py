"""What language models and the type checker are told is what a robot can do."""

import ast
import dataclasses
import inspect

import pytest

from memorymaze.robot.api import control as api
from memorymaze.robot.api.specification import (
    API_NAMES,
    API_RECORDS,
    ASKING_NAMES,
    api_specification,
    api_stub,
)

RECORDS = (api.MoveResult, api.TurnResult, api.Detection, api.SignText)


def functions_in(text: str) -> dict[str, ast.FunctionDef]:
    return {
        item.name: item
        for item in ast.parse(text).body
        if isinstance(item, ast.FunctionDef)
    }


def classes_in(text: str) -> dict[str, ast.ClassDef]:
    return {
        item.name: item
        for item in ast.parse(text).body
        if isinstance(item, ast.ClassDef)
    }


def test_names_are_the_protocols_methods_and_hold_the_papers_four():
    members = inspect.getmembers(api.Robot, inspect.isfunction)

    assert set(API_NAMES) == {name for name, _ in members if name[0] != "_"}
    assert {
        "move_forward",
        "detect_turning_point",
        "turn",
        "detect_from_RGB_image",
    } <= set(API_NAMES)


@pytest.mark.parametrize(
    "text", [api_specification(), api_stub()], ids=["spec", "stub"]
)
def test_each_function_has_the_protocols_parameters_and_result(text: str):
    functions = functions_in(text)

    assert tuple(functions) == API_NAMES
    for name, function in functions.items():
        signature = inspect.signature(getattr(api.Robot, name))
        told = {
            argument.arg: ast.unparse(argument.annotation)
            for argument in function.args.args
        }
        meant = {
            parameter.name: inspect.formatannotation(parameter.annotation)
            for parameter in list(signature.parameters.values())[1:]
        }
        assert told == meant
        assert len(function.args.defaults) == sum(
            parameter.default is not parameter.empty
            for parameter in signature.parameters.values()
        )


@pytest.mark.parametrize(
    "text", [api_specification(), api_stub()], ids=["spec", "stub"]
)
def test_each_record_has_the_fields_a_result_has(text: str):
    classes = classes_in(text)

    assert tuple(classes) == API_RECORDS == tuple(r.__name__ for r in RECORDS)
    for record in RECORDS:
        told = [
            statement.target.id
            for statement in classes[record.__name__].body
            if isinstance(statement, ast.AnnAssign)
        ]
        assert told == [field.name for field in dataclasses.fields(record)]


def test_specification_quotes_every_docstring_whole():
    text = api_specification()

    for name, function in functions_in(text).items():
        meant = inspect.getdoc(getattr(api.Robot, name))
        assert ast.get_docstring(function) == meant
    for line in (inspect.getdoc(api.Robot) or "").splitlines():
        assert f"# {line}".rstrip() in text


def test_specification_describes_every_field_of_every_record():
    text = api_specification()

    for record in RECORDS:
        for field in dataclasses.fields(record):
            line = next(
                line for line in text.splitlines() if f"    {field.name}: " in line
            )
            assert "  # " in line


def test_specification_never_mentions_self_or_the_simulator():
    for word in ("self", "simulat", "MuJoCo", "Protocol", "memorymaze"):
        assert word not in api_specification()


def test_how_to_ask_is_told_in_the_track_with_people_alone():
    plain, with_people = api_specification(), api_specification(with_people=True)

    assert with_people.startswith(plain.rstrip("\n"))
    assert tuple(functions_in(with_people)) == (*API_NAMES, *ASKING_NAMES)
    assert tuple(functions_in(api_stub(with_people=True))) == (
        *API_NAMES,
        *ASKING_NAMES,
    )
    assert ASKING_NAMES == (
        "way_to",
        "where_is",
        "is_this",
        "destination",
        "questions_left",
        "ask",
    )
    assert not set(ASKING_NAMES) & set(functions_in(plain))
    assert list(classes_in(with_people))[-1] == "Question"
    for word in ("self", "simulat", "MuJoCo", "Protocol", "memorymaze"):
        assert word not in with_people
