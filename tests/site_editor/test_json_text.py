import json
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from memorymaze.site_editor.json_text import is_same, read_written, rewritten

JSON = st.recursive(
    st.none()
    | st.booleans()
    | st.integers(-(2**53), 2**53)
    | st.floats(allow_nan=False, allow_infinity=False)
    | st.text(),
    lambda inner: st.lists(inner) | st.dictionaries(st.text(), inner),
    max_leaves=20,
)


def change(text: str, new: Any) -> str:
    """Return the text with a new meaning."""
    written = read_written(text)
    return text[: written.start] + rewritten(text, written, new) + text[written.end :]


@pytest.mark.parametrize(
    ("text", "new", "expected"),
    [
        pytest.param(
            '{ "a" : 5.0,\n  "b":[1, 2]}\n',
            {"a": 5, "b": [1, 3]},
            '{ "a" : 5.0,\n  "b":[1, 3]}\n',
            id="5 is still 5.0, and blanks stay",
        ),
        pytest.param(
            '{"id": 12345678901234567891}',
            {"id": 12345678901234567000},
            '{"id": 12345678901234567891}',
            id="a number that browsers cannot hold stays",
        ),
        pytest.param(
            '{"a": 1, "b": 2}', {"b": 2, "c": 3}, '{"b": 2, "c": 3}', id="other members"
        ),
        pytest.param(
            '{\n  "a": {"b": 1, "c": [1]}\n}',
            {"a": {"b": 1, "c": [1, 2]}},
            '{\n  "a": {"b": 1, "c": [1, 2]}\n}',
            id="only the list that has another length",
        ),
        pytest.param('{"on": 1}', {"on": True}, '{"on": true}', id="true is not 1"),
        pytest.param('["\\u00e4"]', ["ä"], '["\\u00e4"]', id="escapes stay"),
        pytest.param("{}", {"a": "ä"}, '{"a": "ä"}', id="from nothing"),
    ],
)
def test_what_means_the_same_is_written_the_same(
    text: str, new: Any, expected: str
) -> None:
    assert change(text, new) == expected


@given(old=JSON, new=JSON, indent=st.sampled_from([None, 2]))
def test_the_new_text_means_what_it_should(
    old: Any, new: Any, indent: int | None
) -> None:
    text = json.dumps(old, indent=indent)
    assert read_written(text).value == old
    assert change(text, old) == text
    assert is_same(json.loads(change(text, new)), new)
