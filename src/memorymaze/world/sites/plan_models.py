"""Pydantic models of the GeoJSON members a site plan has; degrees, as in the file.

They hold for one feature at a time. What features mean to each other is checked on the
records made from them.
"""

from typing import Annotated, Any, Generic, Literal, TypeVar

from pydantic import AfterValidator, BaseModel, ConfigDict, Field

from memorymaze.basics.input_files import writable

FARTHEST = 100_000.0
"""No coordinate of a building is farther than this many metres from the origin."""

Coordinate = Annotated[float, Field(ge=-FARTHEST, le=FARTHEST)]
_Position = Annotated[list[Coordinate], Field(min_length=2)]
_AnyText = Annotated[str, AfterValidator(writable)]
_Text = Annotated[_AnyText, Field(min_length=1)]


def _with_a_word(text: str) -> str:
    if not text.split():
        raise ValueError("expected a word, got blanks alone")
    return text


Identity = Annotated[str, Field(pattern=r"^[^\p{C}]+$")]
"""Any text without control characters, so that a message about it is one line."""
Degrees = Annotated[float, Field(ge=-360_000, le=360_000)]
_Size = Annotated[float, Field(gt=0, le=1000)]


_Geometry = TypeVar("_Geometry", bound=BaseModel)
_Properties = TypeVar("_Properties", bound=BaseModel)


class _Model(BaseModel):
    model_config = ConfigDict(
        strict=True, extra="ignore", allow_inf_nan=False, frozen=True
    )


class _OpenModel(_Model):
    """Keeps what else is said."""

    model_config = ConfigDict(extra="allow")


class AnchorModel(_Model):
    """Where the origin lies on the globe."""

    latitude: Annotated[float, Field(ge=-90, le=90)]
    longitude: Annotated[float, Field(ge=-180, le=180)]
    bearing_deg: Degrees


class PlanHeader(_OpenModel):
    """Members of the plan beside its features."""

    type: Literal["FeatureCollection"]
    name: Identity
    title: _Text
    floor: _Text
    ceiling_height_m: Annotated[float, Field(ge=1.0, le=100.0)]
    anchor: AnchorModel | None
    description: _AnyText


class PolygonGeometry(_Model):
    """Rings, the outline first."""

    type: Literal["Polygon"]
    coordinates: Annotated[list[list[_Position]], Field(min_length=1)]


class _LineGeometry(_Model):
    type: Literal["LineString"]
    coordinates: Annotated[list[_Position], Field(min_length=2)]


class _SegmentGeometry(_Model):
    type: Literal["LineString"]
    coordinates: Annotated[list[_Position], Field(min_length=2, max_length=2)]


class PointGeometry(_Model):
    """A place."""

    type: Literal["Point"]
    coordinates: _Position


class FeatureModel(_Model, Generic[_Geometry, _Properties]):
    """A feature of a plan."""

    type: Literal["Feature"]
    id: Identity
    geometry: _Geometry
    properties: _Properties


AnyFeature = FeatureModel[Any, Any]


class _FloorProperties(_OpenModel):
    name: _AnyText | None
    floor_material: _Text
    wall_material: _Text


class _AreaProperties(_FloorProperties):
    open_air: bool


class _ExitModel(_Model):
    to: Identity
    heading_deg: Degrees


class _TurningPointProperties(_OpenModel):
    name: _AnyText | None
    shape: Literal["corner", "t_junction", "crossing", "opening", "dead_end"]
    exits: Annotated[list[_ExitModel], Field(min_length=1)]


class _RoomProperties(_OpenModel):
    name: _AnyText
    use: _Text


class _DoorProperties(_OpenModel):
    room: _AnyText | None
    style: _Text
    color: _Text
    label: _AnyText | None
    state: Literal["closed", "open"]


class _LandmarkProperties(_OpenModel):
    category: Annotated[_Text, AfterValidator(_with_a_word)]
    color: _AnyText | None
    name: _AnyText | None
    text: _AnyText | None
    heading_deg: Degrees
    size_m: Annotated[list[_Size], Field(min_length=3, max_length=3)]
    mount: Literal["floor", "wall", "ceiling"]
    obstacle: bool


class _TurnModel(_Model):
    at: Identity
    direction: Literal["left", "right", "slight_left", "slight_right"]


class _RouteProperties(_OpenModel):
    route: Identity
    role: Literal["reference", "alternative"]
    start_heading_deg: Degrees
    goal: _Text
    goal_landmark: Identity
    length_m: Annotated[float, Field(gt=0, le=FARTHEST)] | None = None
    """None: as long as its line."""
    turns: list[_TurnModel]
    note: _AnyText


FEATURE_MODELS: dict[str, type[AnyFeature]] = {
    "corridor": FeatureModel[PolygonGeometry, _FloorProperties],
    "area": FeatureModel[PolygonGeometry, _AreaProperties],
    "turning_point": FeatureModel[PolygonGeometry, _TurningPointProperties],
    "room": FeatureModel[PolygonGeometry, _RoomProperties],
    "door": FeatureModel[_SegmentGeometry, _DoorProperties],
    "landmark": FeatureModel[PointGeometry, _LandmarkProperties],
    "route": FeatureModel[_LineGeometry, _RouteProperties],
}
