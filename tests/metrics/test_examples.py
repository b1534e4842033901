import doctest
import pkgutil
from importlib import import_module

import pytest

from memorymaze import metrics

MODULES = [each.name for each in pkgutil.iter_modules(metrics.__path__)]
WITHOUT_EXAMPLES = {"checks", "score"}


@pytest.mark.parametrize("name", MODULES)
def test_examples_in_docstrings_are_true(name: str) -> None:
    outcome = doctest.testmod(import_module(f"{metrics.__name__}.{name}"))
    assert outcome.failed == 0
    assert (outcome.attempted == 0) == (name in WITHOUT_EXAMPLES)
