# SPDX-License-Identifier: MIT
import os
from collections.abc import Mapping, Sequence
from typing import Any, Literal, NamedTuple, overload

import numpy as np  # of whoever has it: without numpy these are Any
from numpy.typing import NDArray

_Model = Literal["exact", "staged", "float"]
_Rounding = Literal["nearest", "even", "zero"]
_Raster = Literal["spec-d3d", "spec-vulkan", "spec-gl"]
_Layout = Literal["rows", "columns"]
_Array = Any  # other memory of numbers: array.array, memoryview, a list; results are of the same kind and shape
_Codes = NDArray[np.uint16] | NDArray[np.uint32]  # of formats of at most 16 bits, and others
_Single = NDArray[np.float32] | NDArray[np.float16]
_Wide = NDArray[np.float64] | NDArray[np.integer[Any]]

__version__: str

class Error(ValueError):
    status: int

class Decoded(NamedTuple):
    z: Any
    lo: Any
    hi: Any

class Worst(NamedTuple):
    lo: float
    hi: float
    error: float
    error_z: float
    error_code: int
    interval: float
    interval_lo: float
    interval_hi: float
    interval_code: int
    blind_from: float
    separation: float
    separation_z: float

class Camera:
    near: float
    far: float
    format: str
    mapping: str
    ortho: bool
    rounding: _Rounding
    model: _Model
    arith: str
    log_c: float
    viewport: tuple[int, int] | None
    fov: float
    raster: _Raster | None
    subpixel: int | None
    slant: tuple[float, float]
    triangle_class: tuple[float, float, float]
    near_least: float
    near_most: float
    near_digits: int
    far_least: float
    far_most: float
    far_digits: int
    @property
    def code_max(self) -> int: ...
    def __init__(
        self,
        near: float = 0.1,
        far: float = 1000.0,
        format: str = "fp32",
        mapping: str = "d3d",
        *,
        ortho: bool = False,
        rounding: _Rounding = "nearest",
        model: _Model = "exact",
        arith: str = "ieee",
        log_c: float = 1.0,
        viewport: tuple[int, int] | None = None,
        fov: float = 60.0,
        raster: _Raster | None = None,
        subpixel: int | None = None,
        slant: tuple[float, float] = (0.0, 90.0),
        triangle_class: tuple[float, float, float] = (2.0, 512.0, 16.0),
    ) -> None: ...
    @classmethod
    def from_matrix(
        cls, matrix: _Array, mapping: str | None = None, *, layout: _Layout | None = None, **more: Any
    ) -> Camera: ...
    @classmethod
    def preset(cls, name: str, *, unit: str | None = None, **more: Any) -> Camera: ...
    def replace(self, **changes: Any) -> Camera: ...
    @overload
    def encode(self, z: float, *, out: None = None) -> int: ...
    @overload
    def encode(self, z: NDArray[Any], *, out: _Codes | None = None) -> _Codes: ...
    @overload
    def encode(self, z: _Array, *, out: _Array | None = None) -> _Array: ...
    @overload
    def decode(self, codes: int, *, bounds: Literal[False] = False, out: None = None) -> float: ...
    @overload
    def decode(
        self, codes: NDArray[np.integer[Any]], *, bounds: Literal[False] = False, out: None = None
    ) -> NDArray[np.float64]: ...
    @overload
    def decode(self, codes: _Array, *, bounds: Literal[False] = False, out: _Array | None = None) -> _Array: ...
    @overload
    def decode(self, codes: _Array, *, bounds: Literal[True], out: Sequence[_Array] | None = None) -> Decoded: ...
    @overload
    def decode_window(self, depths: float, *, bounds: Literal[False] = False, out: None = None) -> float: ...
    @overload
    def decode_window(
        self, depths: _Single, *, bounds: Literal[False] = False, out: NDArray[np.float32] | None = None
    ) -> NDArray[np.float32]: ...
    @overload
    def decode_window(
        self, depths: _Array, *, bounds: Literal[False] = False, out: _Array | None = None
    ) -> _Array: ...
    @overload
    def decode_window(
        self, depths: _Array, *, bounds: Literal[True], out: Sequence[_Array] | None = None
    ) -> Decoded: ...
    @overload
    def window_depth(self, z: float, *, out: None = None) -> float: ...
    @overload
    def window_depth(self, z: _Single, *, out: NDArray[np.float32] | None = None) -> NDArray[np.float32]: ...
    @overload
    def window_depth(self, z: _Wide, *, out: NDArray[np.float64] | None = None) -> NDArray[np.float64]: ...
    @overload
    def window_depth(self, z: _Array, *, out: _Array | None = None) -> _Array: ...
    @overload
    def separation(self, z: float, *, out: None = None, quick: bool = False) -> float: ...
    @overload
    def separation(self, z: _Single, *, out: NDArray[np.float32] | None = None, quick: bool = False) -> NDArray[np.float32]: ...
    @overload
    def separation(self, z: _Wide, *, out: NDArray[np.float64] | None = None, quick: bool = False) -> NDArray[np.float64]: ...
    @overload
    def separation(self, z: _Array, *, out: _Array | None = None, quick: bool = False) -> _Array: ...
    @overload
    def lattice(self, z: float, *, out: None = None) -> float: ...
    @overload
    def lattice(self, z: _Single, *, out: NDArray[np.float32] | None = None) -> NDArray[np.float32]: ...
    @overload
    def lattice(self, z: _Wide, *, out: NDArray[np.float64] | None = None) -> NDArray[np.float64]: ...
    @overload
    def lattice(self, z: _Array, *, out: _Array | None = None) -> _Array: ...
    @overload
    def interval(self, z: float, *, out: None = None) -> float: ...
    @overload
    def interval(self, z: _Single, *, out: NDArray[np.float32] | None = None) -> NDArray[np.float32]: ...
    @overload
    def interval(self, z: _Wide, *, out: NDArray[np.float64] | None = None) -> NDArray[np.float64]: ...
    @overload
    def interval(self, z: _Array, *, out: _Array | None = None) -> _Array: ...
    def worst(self, lo: float | None = None, hi: float | None = None) -> Worst: ...

def run(
    args: str | Sequence[str | os.PathLike[str]], *, input: str | bytes | None = None, text: bool = False
) -> Any: ...
def solve(camera: Camera | None = None, **options: Any) -> dict[str, Any]: ...
def bias(camera: Camera | None = None, **options: Any) -> dict[str, Any]: ...
def check(requirements: str | os.PathLike[str] | Mapping[str, Any]) -> dict[str, Any]: ...
def recognise(image: _Array, camera: Camera | None = None, **options: Any) -> dict[str, Any]: ...

class Figure(str):
    def save(self, path: str | os.PathLike[str]) -> None: ...

def plot(
    figure: str, camera: Camera | None = None, *, file: str | os.PathLike[str] | None = None, **options: Any
) -> Figure: ...
def read(image: _Array, camera: Camera | None = None, product: str = "eye", **options: Any) -> _Array: ...
def presets() -> list[dict[str, Any]]: ...
def formats() -> list[dict[str, Any]]: ...
