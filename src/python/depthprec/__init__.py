# SPDX-License-Identifier: MIT
"""What a depth buffer resolves, exact and proven.

Camera has encode, decode, decode_window, window_depth, separation, lattice, interval and worst; solve, check, recognise,
bias, plot, read, write, presets, formats and run are commands. Depths are eye depths along the view axis, in scene units;
window depths are from 0 to 1; codes are what the buffer stores.

Arrays are any memory of float16, float32, float64 or integers, in either order of bytes: numpy, array.array,
memoryview, lists. Contiguous input of float32, float64 and codes is not copied, float16 becomes float32, other threads
run meanwhile, and results come as the kind that was given. `out` takes the result into memory of the caller's. A number
in gives a number out.

Camera is the library itself (MIT). The functions run the command beside it, a program of its own (GPL-3.0-or-later).
Every formula and bound is derived in depthprec(7).
"""
import ctypes as _ctypes
import decimal as _decimal
import math as _math
from collections import namedtuple as _namedtuple
from functools import partial as _partial

from . import _arrays, _core, _table
from ._core import Error
from ._program import Figure, answer as _answer, bias, check, formats, plot, presets, read, recognise, run, solve, \
    write

__all__ = ["Camera", "Decoded", "Error", "Figure", "Worst", "bias", "check", "formats", "plot", "presets", "read",
           "recognise", "run", "solve", "write"]
__version__ = _core.version().decode()

Decoded = _namedtuple("Decoded", "z lo hi")
Decoded.__class_getitem__ = classmethod(lambda cls, kind: cls)  # Decoded[float] of the stubs
Decoded.__doc__ = "Eye depths, and the ends of the cells around them: what else the surface may be at."

_SLOW = {"separation": 1 << 16, "lattice": 1 << 13, "interval": 1 << 13}  # elements of a block, where they take long

Worst = _namedtuple("Worst", "lo hi error error_z error_code interval interval_lo interval_hi interval_code blind_from "
                             "separation separation_z")
Worst.__doc__ = """The worst over a range, proven bounds over every depth in it; see Camera.worst()."""


class Camera:
    """A camera's planes and how its depth is stored, checked once; it does not change: replace() makes another.

    near, far  scene units: near in [1e-12, 1e12], far at most 1e18 or math.inf, or up to 1e28 with near and C times
               it at most 1e30; orthographic: either sign, or 0
    format     "unorm24", "d24", "fp32", "unorm16", ...: names as APIs write them, unormN, floatE.M[bB]
    mapping    "d3d", "gl", "reversed", "gl-reversed", "linear", "log", "three-webgl", "three-webgpu", "cesium",
               "osgearth"
    ortho      an orthographic projection
    rounding   "nearest", "even", "zero"
    model      of codes and intervals: "exact", the lattice of real arithmetic; "staged"; "float"
    arith      the binary32 arithmetic that separation() counts: "ieee", "fused", ... (depthprec list arithmetics)
    log_c      the constant C of logarithmic mappings
    depth_range
               (lo, hi), the window depths where NDC depth begins and ends, as glDepthRange or a viewport sets them:
               from 0 to 1, at least 1e-6 apart, in either order; of perspective mappings alone
    viewport   (width, height) in pixels: separation() then holds for slanted triangles; with them fov (vertical,
               degrees), slant ((lo, hi), degrees), triangle_class ((depth, pixels, slim)), raster and subpixel
    raster     "spec-d3d", "spec-vulkan", "spec-gl": any rasterizer that does what the API asks for, with at least
               `subpixel` bits, 4 where it is None; None: a plane anchored at a vertex, of 8 bits or `subpixel`

    near_least, near_most, near_digits and far_least, far_most, far_digits are what from_matrix() says of its planes; of
    other cameras the planes themselves, and 17.

    Raises Error, a ValueError, with the library's sentence. Source: depthprec(3), setup.h.
    """

    __slots__ = ("_given", "_planes", "_setups", "_calls", "_words", "_direct")

    def __init__(self, near=0.1, far=1000.0, format="fp32", mapping="d3d", *, ortho=False, rounding="nearest",
                 model="exact", arith="ieee", log_c=1.0, depth_range=(0.0, 1.0), viewport=None, fov=60.0, raster=None, subpixel=None,
                 slant=(0.0, 90.0), triangle_class=(2.0, 512.0, 16.0)):
        spec = _core.spec_default()
        spec.znear, spec.zfar = _arrays.real(near, "near"), _arrays.real(far, "far")
        formats = (_core.Format * 2)()
        count = _core.format_parse(_core.word(format, "format").encode(), formats)
        if count == 0:
            _core.demand("FORMAT")
        if count == 2:
            raise Error("%s is %s or %s, as the implementation chooses: name one"
                        % (format, formats[0].name.decode(), formats[1].name.decode()))
        spec.format = formats[0]
        spec.mapping = _core.parsed(_core.mapping_parse, mapping, _ctypes.c_int, "mapping")
        spec.arith = _core.parsed(_core.arith_parse, arith, _ctypes.c_size_t, "arith")
        spec.rounding = _index(_core.ROUNDINGS, rounding, "rounding", "ROUNDING")
        spec.model = _index(_core.MODELS, model, "model", "MODEL")
        spec.ortho, spec.log_c = bool(ortho), _arrays.real(log_c, "log_c")
        spec.depth_range[:] = lo, hi = [_arrays.real(end, "depth_range") for end in _several(depth_range, "depth_range", 2)]
        if lo == hi:
            _core.demand("WINDOW")
        if viewport is not None:
            spec.triangles = _triangles(viewport, fov, raster, subpixel, slant, triangle_class)
            subpixel = spec.triangles.subpixel if subpixel is not None else None
        else:
            view = {"fov": fov, "raster": raster, "subpixel": subpixel, "slant": tuple(slant),
                    "triangle_class": tuple(triangle_class)}
            for name in (name for name, value in view.items() if value != Camera.__init__.__kwdefaults__[name]):
                raise Error("%s needs a viewport: surfaces face the camera" % name)
        setup = _core.Setup()
        _core.demand(_core.setup_init(setup, spec))
        self._setups, self._calls, self._words = {"own": setup}, {}, "HI" if spec.format.bits <= 16 else "I"
        self._direct = {format for format, code in _arrays.KINDS.items() if code in self._words}
        self._given = {"near": spec.znear, "far": spec.zfar, "format": spec.format.name.decode(),
                       "mapping": _core.mapping_get(spec.mapping)[0].decode(), "ortho": bool(ortho),
                       "rounding": rounding, "model": model, "arith": _core.arith_get(spec.arith)[0].decode(),
                       "log_c": spec.log_c, "depth_range": (lo, hi),
                       "viewport": None if viewport is None else (spec.triangles.width, spec.triangles.height),
                       "fov": fov, "raster": raster, "subpixel": subpixel, "slant": tuple(slant),
                       "triangle_class": tuple(triangle_class)}
        self._planes = {"near_least": spec.znear, "near_most": spec.znear, "far_least": spec.zfar,
                        "far_most": spec.zfar, "near_digits": 17, "far_digits": 17}

    @classmethod
    def from_matrix(cls, matrix, mapping=None, *, layout=None, **more):
        """The camera of a 4x4 projection matrix.

        matrix   16 numbers: 4x4 or flat, float32 or float64 or lists; clip = M (x, y, z, 1)
        mapping  "d3d", "gl", "reversed" or "gl-reversed"; None: as the matrix has it. A perspective tells whether it is
                 reversed; whether NDC depth begins at 0 or at -1 only a reversed one with far >= 2 near tells.
                 Read the wrong way near would be half or twice as far, so that it has to be said else
        layout   "rows", "columns"; None: as the fourth row tells
        more     format, rounding, ... of Camera

        near and far are those of the entries as they are: of float32 entries those that a shader has, too. The planes
        that the matrix was made of lie from near_least to near_most and from far_least to far_most, by what rounding
        took from the entries: to float32 if all are such numbers, else to float64. near_digits and far_digits are
        the fewest digits that lie there, which repr() shows. Of entries of at most 20 bits, where all are, none was
        rounded.
        Raises Error where it is no projection, where its planes differ from pixel to pixel, and where more than one
        convention fits, naming what each would be. Source: depthprec(3), projection.h.
        """
        numbers = _sixteen(matrix)
        if layout not in _core.LAYOUTS:
            raise Error("layout must be 'rows', 'columns' or None, got %r" % (layout,))
        asked = _core.MAPPING_FOUND if mapping is None else \
            _core.parsed(_core.mapping_parse, mapping, _ctypes.c_int, "mapping")
        status, found, fault = _find(numbers, layout, asked)
        if status == _core.STATUSES.index("MATRIX"):
            raise Error("%s, got %s" % (fault.rule.decode(), " ".join("%.9g" % x for x in fault.got)), status)
        if status == _core.STATUSES.index("CONVENTION"):
            raise Error("%s: %s" % (_core.status_text(status).decode(), _readings(numbers, layout, asked)), status)
        _core.demand(status)
        made, planes = cls(found.znear, found.zfar, mapping=_core.mapping_get(found.mapping)[0].decode(),
                           ortho=bool(found.ortho), **more), _core.Planes()
        _core.demand(_core.projection_planes(planes, found, numbers, None, None))
        made._planes = {name: getattr(planes, name) for name in made._planes}
        return made

    @classmethod
    def preset(cls, name, *, unit=None, **more):
        """The camera that an engine starts with: "unity", "unreal", "godot-forward", "three", ...; presets() has them
        with their sources.

        unit  "m", "cm", ...: the length of a scene unit, to which planes and the constant C are converted; None: the
              engine's own
        more  near, far, format, ... of Camera in place of the engine's. With a viewport its field of view and the grid
              of its vertices hold, too, where none are named

        Runs the command. Raises Error for another name, and where the engine leaves the format open.
        """
        asked = {key: more[key] for key in ("near", "far", "format", "mapping", "ortho", "log_c") if key in more}
        if more.get("viewport") is not None:
            asked.update({key: more[key] for key in ("fov", "raster", "subpixel") if key in more},
                         viewport="%sx%s" % _several(more["viewport"], "viewport", 2))
        found = _answer(["table", "--quiet"], {"preset": _core.word(name, "a preset"), "unit": unit, **asked})
        if len(found["setups"]) > 1:
            raise Error("the format of %s is %s, as the implementation chooses: name one"
                        % (name, " or ".join(setup["format"] for setup in found["setups"])))
        row, seen = found["setups"][0], found.get("triangles")
        own = {key: row[key] for key in ("near", "mapping", "format", "log_c") if key in row}
        own["far"] = _math.inf if row["far"] is None else row["far"]
        if seen is not None:
            own.update(fov=seen["fov"])
            if seen.get("raster") is not None and not {"raster", "subpixel"} & set(more):
                own.update(raster=seen["raster"])
        return cls(**{**more, **own})

    def __getattr__(self, name):
        for fields in () if name.startswith("_") else (self._given, self._planes):
            if name in fields:
                return fields[name]
        raise AttributeError("'Camera' has no attribute '%s'" % name)

    def __setattr__(self, name, value):
        if not name.startswith("_"):
            raise AttributeError("a camera does not change: camera.replace(%s=%r) makes another" % (name, value)
                                 if name in self._given else "'Camera' has no attribute '%s'" % name)
        object.__setattr__(self, name, value)

    def replace(self, **changes):
        """This camera but for what is named: ``camera.replace(near=0.5, format="d24")``. Raises as Camera does."""
        made = Camera(**{**self._given, **changes})
        made._planes = {name: value if name.split("_")[0] in changes else self._planes[name]
                        for name, value in made._planes.items()}
        return made

    __replace__ = replace

    def __dir__(self):
        return [*super().__dir__(), *self._given, *self._planes]

    def __repr__(self):
        usual = Camera.__init__.__kwdefaults__
        rounded = self.near_least < self.near_most or self.far_least < self.far_most
        shown = [self._plane(name) if rounded else repr(self._given[name]) for name in ("near", "far")]
        shown += [repr(self._given[name]) for name in ("format", "mapping")]
        shown += ["%s=%r" % (name, self._given[name]) for name in usual if self._given[name] != usual[name]]
        return ("<Camera of a matrix: %s>" if rounded else "Camera(%s)") % ", ".join(shown)

    def _repr_html_(self):
        depths = [] if _math.isinf(self.far) or self.near <= 0 else \
            [self.near * (self.far / self.near) ** (i / 4) for i in range(1, 4)]
        rows = "".join("<tr><td>%.4g</td><td>%.3g</td><td>%.3g</td></tr>" % (z, self.separation(z), self.lattice(z))
                       for z in depths or [self.near + k for k in (1.0, 10.0, 100.0)])
        return "<p><code>%s</code></p><table><tr><th>z</th><th>guaranteed separation</th><th>of the lattice</th></tr>%s" \
               "</table>" % (repr(self).replace("<", "&lt;").replace(">", "&gt;"), rows)

    def _plane(self, name):
        """A plane in the digits that it has, and between what it lies."""
        text = "%s %r" % (name, float("%.*g" % (self._planes[name + "_digits"], self._given[name])))
        least, most = self._planes[name + "_least"], self._planes[name + "_most"]
        return text if least == most else "%s (%s to %s)" % (
            text, _nine(least, _decimal.ROUND_FLOOR), _nine(most, _decimal.ROUND_CEILING))

    def __eq__(self, other):
        return self._given == other._given if isinstance(other, Camera) else NotImplemented

    def __hash__(self):
        return hash(tuple(self._given.values()))

    def __reduce__(self):
        return _again, (self._given, self._planes)

    @property
    def code_max(self):
        """The code of window depth 1."""
        return self._setups["own"].spec.format.code_max

    @_arrays.as_it_lies
    def encode(self, z, *, out=None):
        """The codes that are stored for eye depths, correctly rounded for every double.

        z    scene units, float32 or float64, any shape; outside [near, far] clamped, as a depth clamp does; NaN in an
             array counts as near
        out  uint16 (formats of at most 16 bits) or uint32, as many elements

        Returns uint16 for formats of at most 16 bits, else uint32, of the same shape; an int of a number.
        Source: depthprec(3), DP_TASK_CODE: dp_code() of each element, to the bit.
        """
        read = _arrays.given(z, "eye depths")
        if read is None:
            return self._number("code", _number(z, "an eye depth"), write=_ctypes.c_uint32)
        return self._fill("code", z, read, out)

    @_arrays.as_it_lies
    def decode(self, codes, *, bounds=False, out=None):
        """The eye depths that codes give back; those of window depths are decode_window()'s.

        codes   integers of any width; above code_max they count as code_max, a single one must be at most that
        bounds  also the ends of the cells: every surface that is stored so lies from lo to hi. Those of float32 are
                rounded outward
        out     float32 or float64, as many elements; with bounds three of them

        Returns scene units, float64, with bounds Decoded(z, lo, hi). To float32, into `out`, they are within 1.85e-7
        relative and the fastest. math.inf for the code of an infinite far. In the model "float" a code has no cell: lo
        and hi are NaN.
        Source: depthprec(3), DP_TASK_EYE, _LO and _HI: dp_stored() and dp_cell_of().
        """
        read = _arrays.given(codes, "codes", self._direct)
        if read is not None:
            return self._decoded(codes, read, out) if bounds else self._fill("eye", codes, read, out)
        code = codes.item() if hasattr(codes, "item") else codes
        if isinstance(code, bool) or not isinstance(code, int):
            raise TypeError("a code must be a whole number: window depths are for decode_window(), got %r" % (code,))
        if not 0 <= code <= self.code_max:
            raise Error("a code must be from 0 to %d, got %d" % (self.code_max, code))
        names = ("eye", "lo", "hi") if bounds else ("eye",)
        got = [self._number(name, code, read=_ctypes.c_uint32) for name in names]
        return Decoded(*got) if bounds else got[0]

    @_arrays.as_it_lies
    def decode_window(self, depths, *, bounds=False, out=None):
        """The eye depths that window depths give back, as they are read from a buffer: each counts as the nearest code.

        depths       float16, float32 or float64; outside [0, 1] clamped, NaN gives NaN; a single one must be in [0, 1]
        bounds, out  as decode() has them; out of the type of the depths

        Returns the type of the depths, float32 of float16.
        Source: depthprec(3), dp_batch_windows().
        """
        read = _arrays.given(depths, "window depths")
        if read is not None:
            kind = None if read.obj is depths or isinstance(depths, (list, tuple)) else memoryview(depths)
            if kind is not None and kind.nbytes and _arrays.element(kind)[0] not in "efd":
                raise TypeError("window depths must be float16, float32 or float64: codes are for decode(), got %s"
                                % _arrays.name_of(kind))
            return self._decoded(depths, read, out) if bounds else self._fill("eye", depths, read, out)
        depth = _number(depths, "a window depth")
        if not 0 <= depth <= 1:
            raise Error("a window depth must be from 0 to 1, got %r" % depth)
        given, got = _ctypes.c_double(depth), [_ctypes.c_double() for _ in range(3)]
        _core.demand(_core.batch_windows(self._setups["own"], 1, _ctypes.byref(given), *map(_ctypes.byref, got), 1))
        return Decoded(*(x.value for x in got)) if bounds else got[0].value

    @_arrays.as_it_lies
    def window_depth(self, z, *, out=None):
        """The window depth in [0, 1] of eye depths, before the buffer rounds it: within 2^-50 relative, and rounded
        once more where z is float32.

        z, out  scene units and their result, float32 or float64, any shape; NaN outside [near, far]

        Of a number it raises Error there. Source: depthprec(3), dp_window().
        """
        return self._map("window", z, out)

    @_arrays.as_it_lies
    def separation(self, z, *, out=None, quick=False):
        """How far behind z a surface must lie to be resolved: guaranteed, despite the rounding of shader, viewport and
        buffer. With a viewport: how far in front of z, along the normal, at any slant.

        z, out  as window_depth(); float32 is rounded up
        quick   arrays of numpy by a table, which grows with the depths that are met: the worst of the 4096th of a
                binade that z lies in. It holds as well, and is hardly more but where a step doubles, there up to twice. Needs
                numpy and near above 0, and takes no `out`

        Returns scene units; math.inf where nothing is certain. Nor is anything where z + separation(z) > far: far ends
        no separation. For "linear", which no pipeline computes, a lattice.
        Source: depthprec(3), dp_separation() of dp_setup_guaranteed(); quick dp_separation_runs().
        """
        if quick:
            read, numpy = _arrays.given(z, "eye depths"), _arrays.numpy_module()
            if out is not None or self.near <= 0 or numpy is None:
                raise Error("quick needs numpy, a near above 0 and no out")
            if read is not None:
                if "table" not in self._calls:
                    self._calls["table"] = _table.Table(numpy, self._setup_of("separation"))
                return self._calls["table"].at(numpy.asarray(read))
        return self._map("separation", z, out)

    @_arrays.as_it_lies
    def lattice(self, z, *, out=None):
        """The same in exact arithmetic: one step of the format, what no implementation can be better than.

        z, out  as window_depth(); float32 is rounded up
        Source: depthprec(3), dp_separation() in the model exact.
        """
        return self._map("lattice", z, out)

    @_arrays.as_it_lies
    def interval(self, z, *, out=None):
        """The z-fighting interval: the width of the cell around z, whose depths all get the same code.

        z, out  as window_depth()
        Returns scene units; math.inf in the last cell of an infinite far; NaN in the model "float", which has no cells.
        Source: depthprec(3), dp_cell_of().
        """
        return self._map("interval", z, out)

    def worst(self, lo=None, hi=None):
        """The worst over the eye depths [lo, hi], by default [near, far]: proven bounds over every depth, no samples.

        Returns Worst: the range; the largest `error` of a stored depth, where (`error_z`) and in which code; the
        widest cell, `interval`, with its ends and code; where an unbounded cell begins (`blind_from`, else NaN); the
        largest guaranteed `separation`, at most 2^-10 above the truth, and where one nearly as large was found. In the
        model "float", which has no cells, the first of these are NaN.
        Raises Error where the range is reversed or leaves [near, far]. Source: depthprec(3), bounds.h.
        """
        lo = self.near if lo is None else _arrays.real(lo, "lo")
        hi = self.far if hi is None else _arrays.real(hi, "hi")
        cells, apart = _core.Worst(), _core.SeparationWorst()
        _core.demand(_core.worst_over(self._setups["own"], lo, hi, cells))
        _core.demand(_core.separation_over(self._setup_of("separation"), lo, hi, 0.0, apart))
        return Worst(*(getattr(cells, name) for name, _ in _core.Worst._fields_), apart.bound, apart.z)

    # ---- What the methods share --------------------------------------------------------------------------------

    def _setup_of(self, name):
        """The set-up that a method asks; each lives as long as the camera."""
        if name not in self._setups:
            made = _core.Setup()
            if name == "separation":
                made = _core.setup_guaranteed(self._setups["own"])
            else:  # the lattice, which knows of no triangles
                spec = _core.Spec.from_buffer_copy(self._setups["own"].spec)
                spec.model, spec.triangles.width = _core.MODELS.index("exact"), 0
                _core.demand(_core.setup_init(made, spec))
            self._setups[name] = made
        return self._setups[name]

    def _written(self, name, read):
        """The types of elements that a method writes, the first of them unasked."""
        return self._words if name == "code" else _arrays.KINDS[read] if read in _arrays.REALS else "df"

    def _call(self, name, read, write):
        """What a method asks of the library, made once for elements of one format and those of another: a function of
        their addresses and count, whether it works in place, and whether _keep() makes it faster."""
        codes = self._written(name, read)
        if _arrays.KINDS.get(write, "?") not in codes:
            raise TypeError("out must have elements of type '%s', got '%s'" % ("' or '".join(codes), write))
        kinds = _arrays.KINDS[read] + _arrays.KINDS[write]
        real, word = int("f" not in kinds), int("H" not in kinds)
        setup = self._setup_of(name if name in ("separation", "lattice") else "own")
        task = {"lattice": "separation", "z": "eye"}.get(name, name)
        windows = task in _core.WINDOWS and read in _arrays.REALS
        if windows:
            before = (None,) * _core.WINDOWS.index(task)
            after = (None,) * (2 - len(before))

            def call(start, to, count):
                status = _core.batch_windows(setup, real, start, *before, to, *after, count)
                if status != 0:
                    _core.demand(status)
        else:
            batch = _core.Batch()
            _core.demand(_core.batch_init(batch, setup, _core.TASK[task], real, word, _core.path_best()))
            call = _partial(_core.batch_run, _ctypes.byref(batch))
        made = self._calls[name, read, write] = call, not windows and name not in Decoded._fields, name == "separation"
        return made

    def _keep(self, kind):
        """The function of such a call, with what many elements need. Others may run the one before meanwhile."""
        call, in_place, _ = self._calls[kind]
        batch, memory = _core.Batch.from_buffer_copy(call.args[0]._obj), (_ctypes.c_double * (_core.KEEP // 8))()
        _core.batch_keep(batch, memory)
        batch.memory = memory
        self._calls[kind] = _partial(_core.batch_run, _ctypes.byref(batch)), in_place, False
        return self._calls[kind][0]

    def _fill(self, name, values, read, out, run=True):
        """`out`, or new memory of the kind of `values`, with what a method makes of `read`."""
        if out is None:
            out = _arrays.made(values, read, self._written(name, read.format)[0])
        _arrays.refuse_mask(out)
        write = memoryview(out)
        if write.readonly or not write.c_contiguous:
            raise ValueError("out must be contiguous memory that can be written")
        kind = name, read.format, write.format
        call, in_place, keeps = self._calls.get(kind) or self._call(*kind)
        start, to, count = _arrays.places(read, write, in_place)
        if keeps and count > 99:
            call = self._keep(kind)
        # Between blocks Ctrl-C is heard: at most some hundredths of a second each.
        block = _SLOW.get(name, 1 << 18)
        if run and count <= block:
            call(start, to, count)
            return out
        for at in range(0, count if run else 0, block):
            call(start + at * read.itemsize, to + at * write.itemsize, min(block, count - at))
        return out

    def _decoded(self, values, read, out):
        outs = (None,) * 3 if out is None else tuple(out)
        if len(outs) != 3:
            raise ValueError("out must be three arrays with bounds, got %d" % len(outs))
        for run in (False, True):  # all are looked at before one is written
            outs = [self._fill(name, values, read, each, run) for name, each in zip(Decoded._fields, outs)]
        return Decoded(*outs)

    def _map(self, name, z, out):
        read = _arrays.given(z, "eye depths")
        if read is not None:
            return self._fill(name, z, read, out)
        z = _number(z, "an eye depth")
        if not self.near <= z <= self.far:
            _core.demand("DEPTH")
        return self._number(name, z)

    def _number(self, name, value, read=_ctypes.c_double, write=_ctypes.c_double):
        got = write()
        kind = name, read._type_, write._type_
        call, _, _ = self._calls.get(kind) or self._call(*kind)
        call(_ctypes.byref(read(value)), _ctypes.byref(got), 1)
        return got.value

    def _options(self, command):
        """As options of the command, or keys of a requirement file."""
        usual = Camera.__init__.__kwdefaults__
        taken = {"texture": ("ortho", "log_c", "rounding", "depth_range"),
                 "check": ("ortho", "log_c", "rounding", "depth_range", "model", "arith")}
        names = taken.get(command, ("ortho", "log_c", "rounding", "depth_range", "arith"))
        given = {name: self._given[name] for name in ("near", "far", "format", "mapping")}
        given.update({name: self._given[name] for name in names if self._given[name] != usual[name]})
        if "depth_range" in given and command != "check":
            given["depth_range"] = "%r:%r" % self.depth_range
        if self.viewport is not None and command not in taken:
            depth, pixels, slim = self.triangle_class
            given.update(viewport="%dx%d" % self.viewport, fov=self.fov, raster=self.raster, subpixel=self.subpixel,
                         slant="%r:%r" % self.slant,
                         triangle_class="depth=%r,pixels=%r,slim=%r" % (depth, pixels, slim))
        return given


def _again(given, planes):
    made = Camera(**given)
    made._planes = planes
    return made


def _nine(x, way):
    return "%.9g" % (x if _math.isinf(x) else _decimal.Context(prec=9, rounding=way).create_decimal(x))


def _number(value, what):
    number = _arrays.real(value, what)
    if number != number:
        raise Error("%s must be a number, got nan" % what)
    return number


def _index(names, name, what, status):
    if _core.word(name, what) not in names:
        _core.demand(status)
    return names.index(name)


def _triangles(viewport, fov, raster, subpixel, slant, triangle_class):
    made = _core.triangles_default()
    made.width, made.height = (_arrays.whole(side, "viewport") for side in _several(viewport, "viewport", 2))
    made.slant_lo, made.slant_hi = (_arrays.real(end, "slant") for end in _several(slant, "slant", 2))
    made.depth, made.pixels, made.slim = (
        _arrays.real(most, "triangle_class") for most in _several(triangle_class, "triangle_class", 3))
    made.fov_y = _arrays.real(fov, "fov")
    if raster is not None:
        if _core.word(raster, "raster") not in _core.RASTERS:
            raise Error("raster must be %s or None, got %r" % (", ".join(_core.RASTERS), raster))
        anchors = [_core.anchor_get(i).contents.plane for i in range(_core.ANCHORS)]
        made.plane = _core.PlaneError(*(max(getattr(plane, name) for plane in anchors)
                                        for name, _ in _core.PlaneError._fields_))
        made.subpixel, fixed = _core.RASTERS[raster]
        if subpixel is not None and (fixed or not _arrays.whole(subpixel, "subpixel") >= made.subpixel):
            raise Error("subpixel %s with %s, got %s"
                        % ("does not apply" if fixed else "must be at least 4", raster, subpixel))
    if subpixel is not None:
        made.subpixel = _arrays.whole(subpixel, "subpixel")
    fault = _core.triangles_fault(made)
    if fault is not None:
        raise Error(fault.decode(), _core.STATUSES.index("TRIANGLES"))
    return made


def _several(values, what, count):
    """So many numbers."""
    try:
        given = tuple(values)
    except TypeError:
        raise TypeError("%s must be %d numbers, got %s" % (what, count, type(values).__name__)) from None
    if len(given) != count:
        raise Error("%s must be %d numbers, got %d" % (what, count, len(given)))
    return given


def _sixteen(matrix):
    if isinstance(matrix, (list, tuple)) and all(isinstance(row, (list, tuple)) for row in matrix):
        matrix = [value for row in matrix for value in row]
    read = _arrays.given(matrix, "a matrix")
    count = 1 if read is None else read.nbytes // read.itemsize
    if count != 16:
        raise Error("a matrix must have 16 numbers, got %d" % count)
    return (_ctypes.c_double * 16)(*memoryview(read.tobytes()).cast(_arrays.KINDS[read.format]))


def _find(numbers, layout, mapping):
    found, fault = _core.Projection(), _core.MatrixFault()
    status = _core.projection_find(found, numbers, _core.LAYOUTS[layout], mapping, fault)
    return status, found, fault


def _readings(numbers, layout, asked):
    """What a matrix is in each convention that fits."""
    read = []
    for mapping in range(_core.MAPPING_FOUND) if asked == _core.MAPPING_FOUND else (asked,):
        for way in ("rows", "columns") if layout is None else (layout,):
            status, found, _ = _find(numbers, way, mapping)
            if status == 0:
                shown = "%s by %s near %.9g, far %.9g" % (_core.mapping_get(mapping)[0].decode(), way, found.znear,
                                                          found.zfar)
                read.append(shown)
    return "; ".join(read)
