"""Settings by their names, from the command line, from files and from Python.

A name is that of a field of `RunSettings`, `SimulationSettings` or `ModelSettings`. A file
of settings is flat TOML, `NAME = VALUE` a line; a text is understood as on the command
line, and numbers, `true` and `false` may stand without quotes:

    limit = 60
    turning_points = "lidar"
    obstacles = "heavy,seed=3"
"""

import json
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, fields, replace
from typing import Any, TypeVar

from memorymaze.basics.errors import SettingsError, did_you_mean
from memorymaze.basics.input_files import field_lines, parse_toml, read_text, shown
from memorymaze.basics.options import as_given, check_kind, read_value
from memorymaze.language.models.model_settings import ModelSettings
from memorymaze.robot.simulation.settings import SimulationSettings
from memorymaze.runs.episodes.bodies import options_of_body, parse_body
from memorymaze.runs.episodes.settings import RunSettings

Settings = TypeVar("Settings")

_NOT_NAMED = {"simulation", "shared_folder"}
"""What has names of its own inside, and what a run sets itself."""

SETTINGS: dict[str, type] = {
    each.name: cls
    # The time budget is that of runs: a run works out that of the simulation.
    for cls in (ModelSettings, SimulationSettings, RunSettings)
    for each in fields(cls)
    if each.name not in _NOT_NAMED
}
"""The class of each setting, by its name."""


@dataclass(frozen=True, slots=True)
class GivenSetting:
    """A setting as somebody gave it."""

    name: str
    value: Any
    """A text is read as the field's type says."""
    called: str
    """What messages call it: `--limit`, `--with retries`, `setting limit`."""
    place: str = ""
    """File and line, where it stands in a file."""

    def read(self) -> Any:
        """Return its value; refuse names and texts that say nothing."""
        if self.name not in SETTINGS:
            raise SettingsError(
                f"{self._begin}{self.called}: expected the name of a setting, got "
                f"{self.name!r}{did_you_mean(self.name, SETTINGS)} (memorymaze settings "
                "lists them; options of agents are given with --set)"
            )
        if not isinstance(self.value, str):
            return self.value
        try:
            return read_value(
                SETTINGS[self.name], self.name, self.value, called=self.called
            )
        except SettingsError as error:
            raise SettingsError(f"{self._begin}{error}") from None

    def is_meant_by(self, message: str) -> bool:
        """Tell whether a message begins with its name."""
        subject = message.partition(":")[0].replace(" ", "_").replace("-", "_")
        return subject == self.name or subject.endswith(f"_{self.name}")

    @property
    def _begin(self) -> str:
        return f"{self.place}: " if self.place else ""


def named_in_python(choices: Mapping[str, Any]) -> list[GivenSetting]:
    """Return settings that were given as arguments."""
    return [
        GivenSetting(name, value, f"setting {name}") for name, value in choices.items()
    ]


def run_settings(base: RunSettings, given: Iterable[GivenSetting]) -> RunSettings:
    """Return settings of a run with what was given, but for those of a language model.

    Later ones win. SettingsError says what is no setting, or has no meaning, and where.
    """
    listed = with_robot_options(given)
    simulation = _values_of(SimulationSettings, listed)
    values = _values_of(RunSettings, listed)
    if simulation:
        start = values.get("simulation", base.simulation)
        values["simulation"] = _changed(start, simulation, listed)
    return _changed(base, values, listed)


def with_robot_options(given: Iterable[GivenSetting]) -> list[GivenSetting]:
    """Return settings where options of the robot's body stand behind its name."""
    listed = list(given)
    named = [each for each in listed if each.name == "robot"]
    robot = named[-1] if named else None
    if robot is None or not isinstance(robot.value, str) or robot.value == "none":
        return listed
    known = options_of_body(parse_body(robot.value)) - SETTINGS.keys()
    told = [
        f"{each.name}={as_given(each.value)}" for each in listed if each.name in known
    ]
    others = [each for each in listed if each.name not in known and each is not robot]
    return [*others, replace(robot, value=",".join([robot.value, *told]))]


def model_settings(given: Iterable[GivenSetting]) -> ModelSettings:
    """Return settings of a language model with what was given, without all others."""
    listed = with_robot_options(given)
    return _changed(ModelSettings(), _values_of(ModelSettings, listed), listed)


def with_choices(settings: RunSettings, choices: Mapping[str, Any]) -> RunSettings:
    """Return settings with some values changed, by their names.

    Names are the fields of `RunSettings` and of `SimulationSettings`; texts are understood
    as on the command line, such as `obstacles="medium"`.

    Raises:
        SettingsError: There is no such setting, or a value has no meaning.
    """
    check_kind("settings", settings, RunSettings, "RunSettings(…)")
    choices = dict(choices)
    simulation = choices.pop("simulation", settings.simulation)
    for name in choices:
        if SETTINGS.get(name) is ModelSettings:
            raise SettingsError(
                f"setting {name}: is of a language model; hand over "
                f"language_model=ModelSettings({name}=…)"
            )
    base = replace(settings, simulation=simulation)
    return run_settings(base, named_in_python(choices))


def read_settings(path: str) -> list[GivenSetting]:
    """Read a file of settings.

    Raises:
        SettingsError: It is no such file; names the line.
    """
    text = read_text(path, SettingsError)
    lines = field_lines(text)
    return [
        given_in_file(name, value, f"{path}:{lines.get(name, 1)}")
        for name, value in parse_toml(text, path, SettingsError).items()
    ]


def given_in_file(name: str, value: Any, place: str) -> GivenSetting:
    """Return what a file says of a setting, as the text that says it elsewhere."""
    name = name.replace("-", "_")
    match value:
        case bool() | int() | float() | str():
            text = as_given(value)
        case [*parts] if all(isinstance(each, int | float | str) for each in parts):
            text = as_given(tuple(parts))
        case _:
            raise SettingsError(
                f"{place}: {name}: expected a text, a number, true or false, got "
                f"{shown(value)}"
            )
    return GivenSetting(name, text, name, place)


def settings_file(run: RunSettings, model: ModelSettings) -> str:
    """Write the settings of a run as a file that `read_settings` reads."""
    lines: list[str] = []
    for name, cls in SETTINGS.items():
        owner = {RunSettings: run, ModelSettings: model}.get(cls, run.simulation)
        value = getattr(owner, name)
        if not isinstance(value, bool | int | float):
            value = json.dumps(as_given(value), ensure_ascii=False)
        lines.append(f"{name} = {as_given(value)}\n")
    return "".join(lines)


def _values_of(cls: type, given: Sequence[GivenSetting]) -> dict[str, Any]:
    """Return the values of the settings of one class; all names are checked."""
    return {
        each.name: each.read() for each in given if SETTINGS.get(each.name, cls) is cls
    }


def _changed(
    settings: Settings, values: Mapping[str, Any], given: Sequence[GivenSetting]
) -> Settings:
    """Change values; what is refused then names the line that says so."""
    try:
        return replace(settings, **values)  # pyright: ignore[reportArgumentType, reportCallIssue, reportUnknownVariableType]
    except SettingsError as error:
        for each in given:
            if each.place and each.is_meant_by(str(error)):
                raise SettingsError(f"{each.place}: {error}") from None
        raise
