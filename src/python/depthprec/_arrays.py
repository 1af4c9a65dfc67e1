# SPDX-License-Identifier: MIT
"""Memory of any kind: buffers of numbers in, buffers of the same kind out. No element is touched here."""
import array
import ctypes
import functools
import importlib.util
import math
import numbers
import operator
import sys

# Types of elements, as the struct module and array.array call them; those of this machine's order of bytes.
_HERE = ("", "@", "=", "<" if sys.byteorder == "little" else ">")
_INTEGERS = {1: "bB", 2: "hH", 4: "iI", 8: "qQ"}  # by how many bytes they have, which the order of bytes decides, too
_NAMES = {"e": "float16", "f": "float32", "d": "float64"}
KINDS = {order + code: code for order in _HERE for code in "fdbBhHiIlLqQnN"}
REALS = {format for format, code in KINDS.items() if code in "fd"}
_PLAIN = {array.array, memoryview}  # types that have no mask; numpy's, once it is met
_lent = (ctypes.c_char * 0).from_buffer
_LENDS = sys.implementation.name == "cpython"  # memory that cannot be written has an address, too


class _View(ctypes.Structure):
    """Py_buffer of CPython."""

    _fields_ = [("buf", ctypes.c_void_p), ("obj", ctypes.c_void_p), ("len", ctypes.c_ssize_t),
                ("itemsize", ctypes.c_ssize_t), ("readonly", ctypes.c_int), ("ndim", ctypes.c_int),
                ("format", ctypes.c_void_p), ("shape", ctypes.c_void_p), ("strides", ctypes.c_void_p),
                ("suboffsets", ctypes.c_void_p), ("internal", ctypes.c_void_p)]


def address(view):
    """Of contiguous memory, which `view` keeps there."""
    if not view.readonly:
        return ctypes.addressof(_lent(view))
    raw = _View()
    ctypes.pythonapi.PyObject_GetBuffer(ctypes.py_object(view), ctypes.byref(raw), 0)
    ctypes.pythonapi.PyBuffer_Release(ctypes.byref(raw))
    return raw.buf or 0


@functools.lru_cache(maxsize=None)
def numpy_module():
    """numpy, or None where there is none."""
    return importlib.import_module("numpy") if importlib.util.find_spec("numpy") else None


def as_it_lies(method):
    """Arrays of numpy in Fortran's order are read as they lie, and their results lie so, too, where no `out` is given."""
    @functools.wraps(method)
    def work(self, values, *, out=None, **options):
        if out is not None or not getattr(getattr(values, "flags", None), "fnc", False):
            return method(self, values, out=out, **options)
        made = method(self, values.T, **options)
        return type(made)(*(each.T for each in made)) if isinstance(made, tuple) else made.T

    return work


def is_scalar(value):
    return isinstance(value, numbers.Number) or (type(value).__module__ == "numpy" and getattr(value, "shape", 0) == ())


def real(value, what):
    """A number as a double; no complex numbers, no words."""
    if isinstance(value, (bool, str, bytes)) or not (isinstance(value, numbers.Real) or is_scalar(value)):
        raise TypeError("%s must be a number, got %s" % (what, type(value).__name__))
    try:
        return float(value)
    except OverflowError:
        return math.inf if value > 0 else -math.inf


def whole(value, what):
    """A whole number as a C int; beyond what one holds, out of every range that the library has."""
    try:
        return max(-1, min(operator.index(value), 0x7fffffff))
    except TypeError:
        raise TypeError("%s must be a whole number, got %s" % (what, type(value).__name__)) from None


def refuse_mask(values):
    """The memory of a masked array of numpy says nothing of its mask."""
    kind = type(values)
    if kind in _PLAIN:
        return
    if kind.__module__ == "numpy" and kind.__name__ == "ndarray":
        _PLAIN.add(kind)
    masked = getattr(sys.modules.get("numpy.ma"), "MaskedArray", None)
    if masked is not None and isinstance(values, masked) and values.mask.any():
        raise ValueError("an array must have no mask, which would be lost: .filled(numpy.nan), or of integers .filled(0), "
                         "says what masked elements are")


def _from_list(values):
    numpy = numpy_module()
    if numpy is not None:
        found = numpy.asarray(values)
        return memoryview(found if found.size or found.dtype.kind in "iuf" else found.astype("d"))
    flat = list(values)
    for value in flat:
        real(value, "an element")
    whole = flat and all(isinstance(value, int) for value in flat)
    return memoryview(array.array("q" if whole else "d", flat))


def given(values, what, direct=REALS):
    """Numbers as contiguous memory, as they are where `direct` has their format; None where it is a single one."""
    kind = type(values)
    if kind is float or kind is int:
        return None
    refuse_mask(values)
    try:
        view = memoryview(values)
    except (TypeError, ValueError, BufferError):
        if is_scalar(values):
            return None
        if isinstance(values, (str, dict, set)) or not hasattr(values, "__len__"):
            raise TypeError("%s must be a number or an array of numbers, got %s" % (what, kind.__name__)) from None
        view = _from_list(values)
    if view.format in direct and view.c_contiguous and view.ndim and (_LENDS or not view.readonly):
        return view
    return _copied(values, view, what, direct) if view.ndim else None


def element(view):
    """The type of elements, "e" of float16, None of what is no number; whether their bytes are in the other order."""
    order, letter = (view.format[0], view.format[1:]) if view.format[:1] in tuple("@=<>!") else ("", view.format)
    if letter in tuple("bBhHiIlLqQnN"):
        letter = _INTEGERS[view.itemsize][letter.isupper()]
    elif letter not in _NAMES:
        return None, False
    return letter, order not in _HERE and view.itemsize > 1


def name_of(view):
    """A type of elements as numpy calls it."""
    code, _ = element(view)
    return _NAMES.get(code) or "%sint%d" % ("" if code.islower() else "u", 8 * view.itemsize) if code else repr(view.format)


def _copied(values, view, what, direct):
    """In the order of the indices; what is not `direct` as uint32 where codes are asked, else float16 as float32 and
    integers as double."""
    (code, swapped), codes, numpy = element(view), "f" not in direct, numpy_module()
    if code is None or (codes and code in _NAMES and view.nbytes) or (code == "e" and numpy is None):
        raise TypeError("%s must be %s, got %s" % (what, "integers: window depths are for decode_window()" if codes
                                                   else "float16, float32, float64 or integers", name_of(view)))
    target = code if code in direct and code != "e" else "I" if codes else "f" if code == "e" else "d"
    if numpy is not None:
        found = values if isinstance(values, numpy.ndarray) else \
            numpy.frombuffer(view.tobytes(), ("<>"[(sys.byteorder == "little") == swapped]) + code).reshape(view.shape)
        if codes and found.size and code not in "BH":
            _refuse_codes(int(found.min()), int(found.max()))
        return memoryview(numpy.ascontiguousarray(found, target))
    flat = array.array(code, view.tobytes())
    if swapped:
        flat.byteswap()
    if codes and flat and code not in "BH":
        _refuse_codes(min(flat), max(flat))
    return _shaped(memoryview(flat if flat.typecode == target else array.array(target, flat)), view.shape)


def _refuse_codes(least, most):
    if least < 0 or most > 0xFFFFFFFF:
        raise ValueError("codes must be from 0 to 4294967295, got %d" % (least if least < 0 else most))


def _shaped(view, shape):
    return view.cast("B").cast(view.format, shape) if len(shape) > 1 and view.nbytes else view


def made(values, read, code):
    """New memory for as many elements as `read` has, of the kind of `values`."""
    numpy = None if isinstance(values, (array.array, memoryview)) else numpy_module()
    if numpy is not None:
        return numpy.empty(read.shape, code)
    flat = array.array(code, (0,)) * (read.nbytes // read.itemsize)
    if isinstance(values, memoryview) or (read.ndim > 1 and read.nbytes and not isinstance(values, array.array)):
        return _shaped(memoryview(flat), read.shape)
    return flat


def places(read, write, in_place):
    """Where the elements that are read lie, where those that are written go, and how many they are."""
    size, room, count = read.nbytes, write.nbytes, read.nbytes // read.itemsize
    if room != count * write.itemsize:
        raise ValueError("out must have as many elements as are read, %d, got %d" % (count, room // write.itemsize))
    start, to = address(read), ctypes.addressof(_lent(write))
    if -room < to - start < size and not (in_place and to == start and room <= size):
        raise ValueError("out must not overlap what is read%s" % (" unless both are one array" if in_place else ""))
    return start, to, count
