# SPDX-License-Identifier: MIT
"""The library by ctypes: its structures, as include/depthprec has them, and its functions. No arithmetic."""
import ctypes
import os
from ctypes import POINTER, byref, c_char, c_char_p, c_double, c_float, c_int, c_size_t, c_uint32, c_uint64, c_void_p

OLD = "; on a system older than the wheel, 'pip install depthprec-*.tar.gz' builds it from its sources"
try:
    library = ctypes.CDLL(os.path.join(os.path.dirname(os.path.abspath(__file__)), "libdepthprec.so.0"))
except OSError as _error:
    raise ImportError("depthprec: its library cannot be loaded: %s%s" % (_error, OLD)) from None

TASKS = ("code", "eye", "width", "encode", "decode", "lo", "hi", "window", "separation", "interval")
TASK = {name: number for number, name in enumerate(TASKS)}
WINDOWS = ("eye", "lo", "hi")  # what dp_batch_windows() writes
MODELS = ("exact", "staged", "float")
ROUNDINGS = ("nearest", "even", "zero")
STATUSES = ("OK", "NULL", "NEAR", "FAR", "PLANES", "INFINITE", "ORTHO", "LOG_C", "FORMAT", "MAPPING", "ROUNDING",
            "MODEL", "ARITH", "DEPTH", "RANGE", "BINARY32", "BATCH", "ORTHO_NEAR", "ORTHO_FAR", "TRIANGLES", "MATRIX",
            "CONVENTION", "WINDOW")  # DP_OK, DP_ERROR_...
LAYOUTS = {None: 0, "rows": 1, "columns": 2}
MAPPING_FOUND = 10  # DP_MAPPING_COUNT
ANCHORS = 4  # DP_ANCHOR_COUNT
RASTERS = {"spec-d3d": (8, True), "spec-vulkan": (4, False), "spec-gl": (4, False)}  # bits; whether they are all


def _structure(title, /, **fields):
    return type(title, (ctypes.Structure,), {"_fields_": list(fields.items())})


Format = _structure("dp_format", name=c_char * 16, kind=c_int, bits=c_int, exponent_bits=c_int, mantissa_bits=c_int,
                    bias=c_int, code_max=c_uint32)
PlaneError = _structure("dp_plane_error", value=c_double, box=c_double, range=c_double, origin=c_double)
AnchorRow = _structure("dp_anchor_row", name=c_char_p, plane=PlaneError, note=c_char_p)
Triangles = _structure("dp_triangles", width=c_int, height=c_int, fov_y=c_double, subpixel=c_int, plane=PlaneError,
                       slant_lo=c_double, slant_hi=c_double, depth=c_double, pixels=c_double, slim=c_double)
Spec = _structure("dp_spec", znear=c_double, zfar=c_double, ortho=c_int, mapping=c_int, format=Format, rounding=c_int,
                  model=c_int, arith=c_size_t, log_c=c_double, depth_range=c_double * 2, triangles=Triangles)
Setup = _structure("dp_setup", spec=Spec, curve=c_int, reversed=c_int, shader=c_int, ranged=c_int, anchor=c_double,
                   log_c=c_double, log_by=c_double, spans_zero=c_int, ends=c_double * 2, low=c_double, span=c_double,
                   kappa=c_double, scale=c_double, den=c_double, log_hi=c_double,
                   log_lo=c_double, code_near=c_uint32, code_far=c_uint32, matrix=c_float * 2, inside=c_float * 2)
Batch = _structure("dp_batch", setup=Setup, task=c_int, real=c_int, word=c_int, path=c_int, in_size=c_size_t,
                   out_size=c_size_t, opaque=c_uint64 * 48)
Worst = _structure("dp_worst", lo=c_double, hi=c_double, error=c_double, error_z=c_double, error_code=c_uint32,
                   interval=c_double, interval_lo=c_double, interval_hi=c_double, interval_code=c_uint32,
                   blind_from=c_double)
SeparationWorst = _structure("dp_separation_worst", lo=c_double, hi=c_double, bound=c_double, separation=c_double,
                             z=c_double)
Projection = _structure("dp_projection", ortho=c_int, reversed=c_int, backwards=c_int, oblique=c_int, mapping=c_int,
                        scale=c_double * 2, half=c_double * 2, centre=c_double * 2, znear=c_double, zfar=c_double,
                        tilt=c_double * 2, base=c_double * 2, pull=c_double)
MatrixFault = _structure("dp_matrix_fault", rule=c_char_p, got=c_double * 4)
Planes = _structure("dp_planes", near_least=c_double, near_most=c_double, far_least=c_double, far_most=c_double,
                    near_digits=c_int, far_digits=c_int)

STRUCTURES = (Format, PlaneError, AnchorRow, Triangles, Spec, Setup, Batch, Worst, SeparationWorst, Projection, MatrixFault,
              Planes)


def _function(name, result, *arguments):
    function = getattr(library, name)
    function.restype = result
    function.argtypes = arguments
    return function


version = _function("dp_version", c_char_p)
status_text = _function("dp_status_text", c_char_p, c_int)
spec_default = _function("dp_spec_default", Spec)
setup_init = _function("dp_setup_init", c_int, POINTER(Setup), POINTER(Spec))
setup_guaranteed = _function("dp_setup_guaranteed", Setup, POINTER(Setup))
triangles_default = _function("dp_triangles_default", Triangles)
triangles_fault = _function("dp_triangles_fault", c_char_p, POINTER(Triangles))
format_parse = _function("dp_format_parse", c_size_t, c_char_p, POINTER(Format))
mapping_parse = _function("dp_mapping_parse", c_int, c_char_p, POINTER(c_int))
arith_parse = _function("dp_arith_parse", c_int, c_char_p, POINTER(c_size_t))
mapping_get = _function("dp_mapping_get", POINTER(c_char_p), c_int)  # a row begins with its name
arith_get = _function("dp_arith_get", POINTER(c_char_p), c_size_t)
anchor_get = _function("dp_anchor_get", POINTER(AnchorRow), c_int)
path_best = _function("dp_path_best", c_int)
batch_init = _function("dp_batch_init", c_int, POINTER(Batch), POINTER(Setup), c_int, c_int, c_int, c_int)
batch_run = _function("dp_batch_run", None, POINTER(Batch), c_void_p, c_void_p, c_size_t)
batch_keep = _function("dp_batch_keep", None, POINTER(Batch), c_void_p)
KEEP = 40960  # DP_BATCH_KEEP
batch_windows = _function("dp_batch_windows", c_int, POINTER(Setup), c_int, c_void_p, c_void_p, c_void_p, c_void_p,
                          c_size_t)
worst_over = _function("dp_worst_over", c_int, POINTER(Setup), c_double, c_double, POINTER(Worst))
separation_over = _function("dp_separation_over", c_int, POINTER(Setup), c_double, c_double, c_double,
                            POINTER(SeparationWorst))
projection_find = _function("dp_projection_find", c_int, POINTER(Projection), POINTER(c_double), c_int, c_int,
                            POINTER(MatrixFault))
projection_planes = _function("dp_projection_planes", c_int, POINTER(Planes), POINTER(Projection), POINTER(c_double),
                              POINTER(c_double), POINTER(c_double))


class Error(ValueError):
    """What the library or the program refuses, in its own sentence; `status` is its number."""

    def __init__(self, text, status=0):
        super().__init__(text)
        self.status = status


def demand(status):
    """Raises what a dp_status, or its name, says."""
    number = STATUSES.index(status) if isinstance(status, str) else status
    if number != 0:
        raise Error(status_text(number).decode(), number)


def parsed(parse, name, kind, what):
    """What `parse` finds under a name."""
    found = kind()
    demand(parse(word(name, what).encode(), byref(found)))
    return found.value


def word(value, what):
    if not isinstance(value, str):
        raise TypeError("%s must be a word, got %s" % (what, type(value).__name__))
    return value
separation_runs = _function("dp_separation_runs", c_int, POINTER(Setup), c_void_p, c_void_p, c_void_p, c_size_t)
