"""OpenUSD brings no types: its modules as this project uses them."""

from typing import Any

Gf: Any
Kind: Any
Sdf: Any
Tf: Any
Usd: Any
UsdGeom: Any
UsdPhysics: Any
UsdSemantics: Any
UsdShade: Any
Vt: Any
