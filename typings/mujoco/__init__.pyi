"""Types of the part of MuJoCo that this project uses; MuJoCo brings none itself."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

_Floats = NDArray[np.float64]
_Ints = NDArray[np.int32]
_Numbers = Sequence[float] | _Floats

class mjtGeom:
    mjGEOM_PLANE: int
    mjGEOM_SPHERE: int
    mjGEOM_CYLINDER: int
    mjGEOM_BOX: int
    mjGEOM_MESH: int

class mjtJoint:
    mjJNT_HINGE: int

class mjtTrn:
    mjTRN_JOINT: int

class mjtIntegrator:
    mjINT_IMPLICITFAST: int

class MjsJoint: ...
class MjsGeom: ...
class MjsCamera: ...
class MjsLight: ...

class MjsMesh:
    inertia: int

class MjsMaterial:
    rgba: _Numbers
    emission: float
    specular: float
    shininess: float
    textures: dict[int, str]

class MjsTexture:
    name: str
    width: int
    height: int
    nchannel: int
    data: bytes
    file: str

class MjsActuator:
    forcelimited: bool
    forcerange: _Numbers
    def set_to_velocity(self, kv: float) -> None: ...

class MjsBody:
    def add_body(
        self,
        *,
        name: str = ...,
        pos: _Numbers = ...,
        quat: _Numbers = ...,
        mocap: bool = ...,
    ) -> MjsBody: ...
    def add_freejoint(self) -> MjsJoint: ...
    def add_joint(
        self, *, name: str = ..., type: int = ..., axis: _Numbers = ..., armature: float
    ) -> MjsJoint: ...
    def add_geom(
        self,
        *,
        name: str = ...,
        type: int = ...,
        size: _Numbers = ...,
        pos: _Numbers = ...,
        quat: _Numbers = ...,
        fromto: _Numbers = ...,
        meshname: str = ...,
        material: str = ...,
        mass: float = ...,
        density: float = ...,
        group: int = ...,
        contype: int = ...,
        conaffinity: int = ...,
        condim: int = ...,
        priority: int = ...,
        friction: _Numbers = ...,
    ) -> MjsGeom: ...
    def add_light(
        self,
        *,
        type: int,
        dir: _Numbers,
        diffuse: _Numbers,
        ambient: _Numbers,
        specular: _Numbers,
        castshadow: bool,
    ) -> MjsLight: ...
    def add_camera(
        self, *, name: str, pos: _Numbers, xyaxes: _Numbers, fovy: float
    ) -> MjsCamera: ...

class _Option:
    timestep: float
    integrator: int

class _Map:
    znear: float
    zfar: float

class _Headlight:
    active: int
    ambient: _Numbers
    diffuse: _Numbers
    specular: _Numbers

class _Global:
    offwidth: int
    offheight: int

class _Quality:
    offsamples: int
    shadowsize: int

class _Visual:
    map: _Map
    headlight: _Headlight
    global_: _Global
    quality: _Quality

class _Statistic:
    extent: float

class MjSpec:
    modelname: str
    option: _Option
    visual: _Visual
    stat: _Statistic
    worldbody: MjsBody
    modelfiledir: str
    textures: Sequence[MjsTexture]
    def __init__(self) -> None: ...
    def add_actuator(self, *, name: str, target: str, trntype: int) -> MjsActuator: ...
    def add_mesh(
        self,
        *,
        name: str,
        uservert: _Floats,
        userface: _Ints,
        usernormal: _Floats,
        userfacenormal: _Ints,
        usertexcoord: _Floats,
        userfacetexcoord: _Ints,
    ) -> MjsMesh: ...
    def add_material(self, *, name: str) -> MjsMaterial: ...
    def add_texture(
        self, *, name: str, type: int, width: int, height: int, nchannel: int
    ) -> MjsTexture: ...
    def add_text(self, *, name: str, data: str) -> object: ...
    def compile(self) -> MjModel: ...
    def to_xml(self) -> str: ...

class _ModelBody:
    id: int
    jntadr: _Ints

class MjModel:
    @staticmethod
    def from_xml_string(xml: str) -> MjModel: ...
    vis: _Visual
    ngeom: int
    nbody: int
    geom_aabb: _Floats
    geom_group: _Ints
    geom_size: _Floats
    geom_pos: _Floats
    geom_quat: _Floats
    geom_contype: _Ints
    geom_type: _Ints
    geom_bodyid: _Ints
    body_mocapid: _Ints
    jnt_qposadr: _Ints
    def body(self, name: str) -> _ModelBody: ...

class _DataCamera:
    xpos: _Floats
    xmat: _Floats

class _Contacts:
    geom: _Ints
    pos: _Floats

class MjData:
    qpos: _Floats
    qvel: _Floats
    qacc_warmstart: _Floats
    ctrl: _Floats
    ncon: int
    contact: _Contacts
    geom_xpos: _Floats
    geom_xmat: _Floats
    mocap_pos: _Floats
    mocap_quat: _Floats
    def __init__(self, model: MjModel) -> None: ...
    def cam(self, name: str) -> _DataCamera: ...

def mj_step(m: MjModel, d: MjData, nstep: int = ...) -> None: ...
def mj_kinematics(m: MjModel, d: MjData) -> None: ...
def mj_camlight(m: MjModel, d: MjData) -> None: ...
def mj_multiRay(
    m: MjModel,
    d: MjData,
    pnt: _Floats,
    vec: _Floats,
    geomgroup: NDArray[np.uint8] | None,
    flg_static: bool,
    bodyexclude: int,
    geomid: _Ints,
    dist: _Floats,
    normal: _Floats | None,
    nray: int,
    cutoff: float,
) -> None: ...
def __getattr__(name: str) -> Any: ...
