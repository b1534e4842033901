from dataclasses import replace
from pathlib import Path

import pytest

from memorymaze.errors import SettingsError
from memorymaze.language.caption_store import CaptionKey, CaptionStore
from memorymaze.language.model import Completion, Usage

KEY = CaptionKey("scene", "viewpoint", "model", "prompt")
CAPTIONS = (
    Completion("Hm.", "model", Usage(900, 1, 0.002), 1.5),
    Completion("A hall with é.", "model", Usage(1000, 50), 2.5),
)


def test_what_is_kept_is_found_again_by_another(tmp_path: Path) -> None:
    path = tmp_path / "captions.sqlite"
    assert CaptionStore(path).find(KEY) == ()
    CaptionStore(path).keep(KEY, CAPTIONS)
    assert CaptionStore(path).find(KEY) == CAPTIONS


@pytest.mark.parametrize("part", ["scene", "viewpoint", "model", "prompt"])
def test_captions_hold_for_what_determines_them_only(tmp_path: Path, part: str) -> None:
    store = CaptionStore(tmp_path / "captions.sqlite")
    store.keep(KEY, CAPTIONS)
    assert store.find(replace(KEY, **{part: "other"})) == ()


def test_the_first_captions_stay(tmp_path: Path) -> None:
    store = CaptionStore(tmp_path / "captions.sqlite")
    store.keep(KEY, CAPTIONS)
    assert store.keep(KEY, CAPTIONS[:1]) == CAPTIONS


def test_a_file_that_is_something_else_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "captions.txt"
    path.write_text("no database at all, and long enough to tell that " * 40)
    with pytest.raises(SettingsError, match=r"captions\.txt.*--set caption_file=FILE"):
        CaptionStore(path)
