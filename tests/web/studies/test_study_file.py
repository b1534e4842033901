from collections.abc import Callable
from pathlib import Path

import pytest

from memorymaze.basics.errors import SettingsError, StudyError
from memorymaze.basics.input_files import field_lines
from memorymaze.web.studies.study_file import (
    STUDY_KINDS,
    Study,
    StudyKind,
    load_study,
    new_study,
)
from memorymaze.world.sites import load_site

MakeStudy = Callable[..., Study]


@pytest.mark.parametrize("kind", STUDY_KINDS)
@pytest.mark.parametrize("site", ["university", "museum_5f"])
def test_a_new_study_file_can_be_read_as_it_is(
    tmp_path: Path, kind: StudyKind, site: str
) -> None:
    path = tmp_path / "mine.toml"
    new_study(path, load_site(site), kind, site)
    study = load_study(path)
    assert (study.design.kind, study.site.name) == (kind, site)
    assert [each.route for each in study.design.routes] == ["R1", "R2"]


def test_a_plan_of_ones_own_is_found_from_the_study_file(make_study: MakeStudy) -> None:
    assert make_study().site.name == "t_junction"


def test_a_study_file_that_is_there_is_not_written_over(
    make_study: MakeStudy, tmp_path: Path
) -> None:
    study = make_study()
    with pytest.raises(SettingsError, match="exists already"):
        new_study(study.path, study.site, "online", "university")


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        pytest.param("quota = 0", "field 'quota': expected", id="out of range"),
        pytest.param('quota = "ten"', "field 'quota': expected", id="another type"),
        pytest.param('kind = "offline"', "field 'kind': expected 'online'", id="kind"),
        pytest.param('site = "universty"', "did you mean 'university'", id="site"),
        pytest.param(
            'answer = "A dog"', "expected an answer among the choices", id="no choice"
        ),
        pytest.param('route = "R9"', "field 'routes[0].route': expected one of R1, R2"),
        pytest.param("fps = 0.5", "field 'walkthrough.fps'", id="in a table"),
    ],
)
def test_what_is_wrong_is_told_with_line_and_field(
    make_study: MakeStudy, wrong: str, said: str
) -> None:
    study = make_study()
    lines = study.text.splitlines()
    name = wrong.partition("=")[0] + "="
    # The last attention check's answer, else the first field of that name.
    places = [number for number, line in enumerate(lines) if line.startswith(name)]
    place = places[-1] if name == "answer =" else places[0]
    lines[place] = wrong
    study.path.write_text("\n".join(lines), encoding="utf-8")
    with pytest.raises(StudyError) as caught:
        load_study(study.path)
    assert said in str(caught.value)
    told = [line for line in str(caught.value).splitlines() if said in line]
    number = int(told[0].split(":")[1])
    # A rule about several fields is told at their table.
    assert place - 4 <= number <= place + 1


def test_a_field_that_is_missing_is_named(make_study: MakeStudy) -> None:
    study = make_study()
    without = study.text.replace('complete = "THANKYOU"\n', "")
    study.path.write_text(without, encoding="utf-8")
    line = without.splitlines().index("[codes]") + 1
    with pytest.raises(StudyError, match=f":{line}: field 'codes.complete': .*add it"):
        load_study(study.path)


def test_a_misspelt_field_is_named(make_study: MakeStudy) -> None:
    study = make_study()
    study.path.write_text(study.text.replace("quota =", "qouta ="), encoding="utf-8")
    with pytest.raises(StudyError, match="did you mean 'quota'"):
        load_study(study.path)


def test_what_is_no_toml_is_told_with_its_line(make_study: MakeStudy) -> None:
    study = make_study()
    study.path.write_text("format = 1\nname = \n", encoding="utf-8")
    with pytest.raises(StudyError, match=r"expected TOML, got a mistake.*line 2"):
        load_study(study.path)


def test_a_delay_belongs_to_memory_only(make_study: MakeStudy) -> None:
    study = make_study("memory")
    study.path.write_text(
        study.text.replace('kind = "memory"', 'kind = "online"'), encoding="utf-8"
    )
    with pytest.raises(StudyError, match="delay_minutes for the kind memory"):
        load_study(study.path)


def test_lines_in_longer_texts_are_no_fields() -> None:
    text = (
        'a = """\nb = 1\n"""\n# """\n[[c]]\nd = 1\n[[c]]\nd = 2\n[e]\n[[e.f]]\ng = 1\n'
    )
    assert field_lines(text) == {
        "a": 1,
        "c[0]": 5,
        "c[0].d": 6,
        "c[1]": 7,
        "c[1].d": 8,
        "e": 9,
        "e.f[0]": 10,
        "e.f[0].g": 11,
    }


def test_data_lie_beside_the_file_and_made_up_data_apart(make_study: MakeStudy) -> None:
    study = make_study()
    assert study.data_folder().name == "online.data"


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        pytest.param(
            'start = "Main Hallway"\n', "", "expected start of R1", id="start"
        ),
        pytest.param(
            "[familiarity]",
            "[codes]\ncomplete = 'x'\nexcluded = 'x'\nfull = 'x'\n"
            "return_address = ''\n[familiarity]",
            "expected no codes for the kind onsite",
            id="of others",
        ),
        pytest.param("{start} and", "it and", "expected {start} in fam", id="question"),
    ],
)
def test_an_interview_needs_places_and_nothing_of_other_kinds(
    make_study: MakeStudy, old: str, new: str, said: str
) -> None:
    study = make_study("onsite")
    assert old in study.text
    study.path.write_text(study.text.replace(old, new), encoding="utf-8")
    with pytest.raises(StudyError) as caught:
        load_study(study.path)
    assert said in str(caught.value)


def test_what_only_interviews_have_is_refused_elsewhere(make_study: MakeStudy) -> None:
    study = make_study("online")
    added = "[interview]\nerrors_found = 'x'\nno_errors = 'y'\n"
    study.path.write_text(study.text + added, encoding="utf-8")
    with pytest.raises(StudyError, match="for the kind onsite only"):
        load_study(study.path)
    without = study.text.replace('platform_ids = ["PROLIFIC_PID"]\n', "")
    study.path.write_text(without, encoding="utf-8")
    with pytest.raises(StudyError, match="expected platform_ids for online, got none"):
        load_study(study.path)
