# SPDX-License-Identifier: MIT
# Types of elements and shapes are numpy's: without numpy all of them are Any.
import os
from array import array
from collections.abc import Mapping, Sequence
from typing import Any, Final, Generic, Literal, NamedTuple, TypeVar, overload

import numpy as np
from numpy.typing import NDArray

_Model = Literal["exact", "staged", "float"]
_Rounding = Literal["nearest", "even", "zero"]
_Raster = Literal["spec-d3d", "spec-vulkan", "spec-gl"]
_Layout = Literal["rows", "columns"]
_Path = str | os.PathLike[str]
_Number = float | np.floating[Any] | np.integer[Any]
_Lists = Sequence[float] | Sequence[Sequence[float]] | Sequence[Sequence[Sequence[float]]]
_Whole = Sequence[int] | Sequence[Sequence[int]] | Sequence[Sequence[Sequence[int]]]

_T = TypeVar("_T", covariant=True)
_S = TypeVar("_S", bound=Any)  # the shape, which stays
_Memory = TypeVar("_Memory", array[Any], memoryview)  # results are of the same kind
_Out = TypeVar("_Out")
_Code = np.dtype[np.uint16 | np.uint32]  # uint16 of formats of at most 16 bits
_Narrow = np.dtype[np.float16 | np.float32]
_Wide = np.dtype[np.float64 | np.integer[Any]]
_F4 = np.dtype[np.float32]
_F8 = np.dtype[np.float64]

__version__: str

class Error(ValueError):
    status: int

class Decoded(NamedTuple, Generic[_T]):
    z: _T
    lo: _T
    hi: _T

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
    near: Final[float]
    far: Final[float]
    format: Final[str]
    mapping: Final[str]
    ortho: Final[bool]
    rounding: Final[_Rounding]
    model: Final[_Model]
    arith: Final[str]
    log_c: Final[float]
    depth_range: Final[tuple[float, float]]
    viewport: Final[tuple[int, int] | None]
    fov: Final[float]
    raster: Final[_Raster | None]
    subpixel: Final[int | None]
    slant: Final[tuple[float, float]]
    triangle_class: Final[tuple[float, float, float]]
    near_least: Final[float]
    near_most: Final[float]
    near_digits: Final[int]
    far_least: Final[float]
    far_most: Final[float]
    far_digits: Final[int]
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
        depth_range: tuple[float, float] = (0.0, 1.0),
        viewport: tuple[int, int] | None = None,
        fov: float = 60.0,
        raster: _Raster | None = None,
        subpixel: int | None = None,
        slant: tuple[float, float] = (0.0, 90.0),
        triangle_class: tuple[float, float, float] = (2.0, 512.0, 16.0),
    ) -> None: ...
    @classmethod
    def from_matrix(
        cls,
        matrix: NDArray[Any] | array[Any] | memoryview | _Lists,
        mapping: str | None = None,
        *,
        layout: _Layout | None = None,
        # keys of __init__ but near, far, mapping, ortho, by package.py
    ) -> Camera: ...
    @classmethod
    def preset(
        cls,
        name: str,
        *,
        unit: str | None = None,
        # keys of __init__, by package.py
    ) -> Camera: ...
    def replace(
        self,
        *,
        # keys of __init__, by package.py
    ) -> Camera: ...
    @overload
    def encode(self, z: _Number, *, out: None = None) -> int: ...
    @overload
    def encode(
        self, z: np.ndarray[_S, np.dtype[np.floating[Any] | np.integer[Any]]], *, out: None = None
    ) -> np.ndarray[_S, _Code]: ...
    @overload
    def encode(self, z: _Memory, *, out: None = None) -> _Memory: ...
    @overload
    def encode(self, z: _Lists, *, out: None = None) -> NDArray[np.uint16 | np.uint32]: ...
    @overload
    def encode(self, z: Any, *, out: _Out) -> _Out: ...
    @overload
    def decode(self, codes: int | np.integer[Any], *, bounds: Literal[False] = False, out: None = None) -> float: ...
    @overload
    def decode(
        self, codes: np.ndarray[_S, np.dtype[np.integer[Any]]], *, bounds: Literal[False] = False, out: None = None
    ) -> np.ndarray[_S, _F8]: ...
    @overload
    def decode(self, codes: _Memory, *, bounds: Literal[False] = False, out: None = None) -> _Memory: ...
    @overload
    def decode(self, codes: _Whole, *, bounds: Literal[False] = False, out: None = None) -> NDArray[np.float64]: ...
    @overload
    def decode(self, codes: Any, *, bounds: Literal[False] = False, out: _Out) -> _Out: ...
    @overload
    def decode(self, codes: int | np.integer[Any], *, bounds: Literal[True], out: None = None) -> Decoded[float]: ...
    @overload
    def decode(
        self, codes: np.ndarray[_S, np.dtype[np.integer[Any]]], *, bounds: Literal[True], out: None = None
    ) -> Decoded[np.ndarray[_S, _F8]]: ...
    @overload
    def decode(self, codes: _Memory, *, bounds: Literal[True], out: None = None) -> Decoded[_Memory]: ...
    @overload
    def decode(self, codes: _Whole, *, bounds: Literal[True], out: None = None) -> Decoded[NDArray[np.float64]]: ...
    @overload
    def decode(self, codes: Any, *, bounds: Literal[True], out: Sequence[_Out]) -> Decoded[_Out]: ...
    @overload
    def decode_window(self, depths: _Number, *, bounds: Literal[False] = False, out: None = None) -> float: ...
    @overload
    def decode_window(
        self, depths: np.ndarray[_S, _Narrow], *, bounds: Literal[False] = False, out: None = None
    ) -> np.ndarray[_S, _F4]: ...
    @overload
    def decode_window(
        self, depths: np.ndarray[_S, _F8], *, bounds: Literal[False] = False, out: None = None
    ) -> np.ndarray[_S, _F8]: ...
    @overload
    def decode_window(self, depths: _Memory, *, bounds: Literal[False] = False, out: None = None) -> _Memory: ...
    @overload
    def decode_window(
        self, depths: _Lists, *, bounds: Literal[False] = False, out: None = None
    ) -> NDArray[np.float64]: ...
    @overload
    def decode_window(self, depths: Any, *, bounds: Literal[False] = False, out: _Out) -> _Out: ...
    @overload
    def decode_window(self, depths: _Number, *, bounds: Literal[True], out: None = None) -> Decoded[float]: ...
    @overload
    def decode_window(
        self, depths: np.ndarray[_S, _Narrow], *, bounds: Literal[True], out: None = None
    ) -> Decoded[np.ndarray[_S, _F4]]: ...
    @overload
    def decode_window(
        self, depths: np.ndarray[_S, _F8], *, bounds: Literal[True], out: None = None
    ) -> Decoded[np.ndarray[_S, _F8]]: ...
    @overload
    def decode_window(self, depths: _Memory, *, bounds: Literal[True], out: None = None) -> Decoded[_Memory]: ...
    @overload
    def decode_window(
        self, depths: _Lists, *, bounds: Literal[True], out: None = None
    ) -> Decoded[NDArray[np.float64]]: ...
    @overload
    def decode_window(self, depths: Any, *, bounds: Literal[True], out: Sequence[_Out]) -> Decoded[_Out]: ...
    @overload
    def window_depth(self, z: _Number, *, out: None = None) -> float: ...
    @overload
    def window_depth(self, z: np.ndarray[_S, _Narrow], *, out: None = None) -> np.ndarray[_S, _F4]: ...
    @overload
    def window_depth(self, z: np.ndarray[_S, _Wide], *, out: None = None) -> np.ndarray[_S, _F8]: ...
    @overload
    def window_depth(self, z: _Memory, *, out: None = None) -> _Memory: ...
    @overload
    def window_depth(self, z: _Lists, *, out: None = None) -> NDArray[np.float64]: ...
    @overload
    def window_depth(self, z: Any, *, out: _Out) -> _Out: ...
    @overload
    def separation(self, z: _Number, *, out: None = None, quick: bool = False) -> float: ...
    @overload
    def separation(
        self, z: np.ndarray[_S, _Narrow], *, out: None = None, quick: bool = False
    ) -> np.ndarray[_S, _F4]: ...
    @overload
    def separation(self, z: np.ndarray[_S, _Wide], *, out: None = None, quick: bool = False) -> np.ndarray[_S, _F8]: ...
    @overload
    def separation(self, z: _Memory, *, out: None = None, quick: bool = False) -> _Memory: ...
    @overload
    def separation(self, z: _Lists, *, out: None = None, quick: bool = False) -> NDArray[np.float64]: ...
    @overload
    def separation(self, z: Any, *, out: _Out, quick: bool = False) -> _Out: ...
    @overload
    def lattice(self, z: _Number, *, out: None = None) -> float: ...
    @overload
    def lattice(self, z: np.ndarray[_S, _Narrow], *, out: None = None) -> np.ndarray[_S, _F4]: ...
    @overload
    def lattice(self, z: np.ndarray[_S, _Wide], *, out: None = None) -> np.ndarray[_S, _F8]: ...
    @overload
    def lattice(self, z: _Memory, *, out: None = None) -> _Memory: ...
    @overload
    def lattice(self, z: _Lists, *, out: None = None) -> NDArray[np.float64]: ...
    @overload
    def lattice(self, z: Any, *, out: _Out) -> _Out: ...
    @overload
    def interval(self, z: _Number, *, out: None = None) -> float: ...
    @overload
    def interval(self, z: np.ndarray[_S, _Narrow], *, out: None = None) -> np.ndarray[_S, _F4]: ...
    @overload
    def interval(self, z: np.ndarray[_S, _Wide], *, out: None = None) -> np.ndarray[_S, _F8]: ...
    @overload
    def interval(self, z: _Memory, *, out: None = None) -> _Memory: ...
    @overload
    def interval(self, z: _Lists, *, out: None = None) -> NDArray[np.float64]: ...
    @overload
    def interval(self, z: Any, *, out: _Out) -> _Out: ...
    def worst(self, lo: float | None = None, hi: float | None = None) -> Worst: ...

@overload
def run(args: str | Sequence[_Path], *, input: str | bytes | None = None, text: Literal[True]) -> str | bytes: ...
@overload
def run(args: str | Sequence[_Path], *, input: str | bytes | None = None, text: bool = False) -> Any: ...
def solve(camera: Camera | None = None, **options: Any) -> dict[str, Any]: ...
def bias(camera: Camera | None = None, **options: Any) -> dict[str, Any]: ...
def check(requirements: _Path | Mapping[str, Any]) -> dict[str, Any]: ...

_Image = _Path | NDArray[Any] | array[Any] | memoryview

def recognise(image: _Image, camera: Camera | None = None, **options: Any) -> dict[str, Any]: ...

class Figure(str):
    def save(self, path: _Path) -> None: ...

def plot(figure: str, camera: Camera | None = None, *, file: _Path | None = None, **options: Any) -> Figure: ...
def read(
    image: _Image, camera: Camera | None = None, product: str = "eye", **options: Any
) -> NDArray[np.float32 | np.float64]: ...
def write(
    path: _Path, image: _Image, camera: Camera | None = None, product: str = "eye", **options: Any
) -> dict[str, Any]: ...
def presets() -> list[dict[str, Any]]: ...
def formats() -> list[dict[str, Any]]: ...
