from dataclasses import replace

import memorymaze
from memorymaze.runs.episodes.provenance import code_stamp


def test_the_stamp_names_version_and_packages() -> None:
    stamp = code_stamp()
    assert stamp.version == memorymaze.__version__
    assert {"mujoco", "numpy"} <= set(stamp.packages)


def test_equal_code_does_not_differ_whatever_the_commit() -> None:
    stamp = code_stamp()
    assert stamp.differences(replace(stamp, commit="other", python="3.12.1")) == []


def test_edited_code_differs() -> None:
    stamp = code_stamp()
    [said] = stamp.differences(replace(stamp, sha256="ff", commit="c0ffee"))
    assert said.endswith(f"{memorymaze.__version__}, commit c0ffee, files ff here")
