# SPDX-License-Identifier: MIT
"""Memory of any kind: buffers of numbers in, buffers of the same kind out. No element is touched here."""
import array
import ctypes
import importlib.util
import math
import numbers
import sys

# Types of elements, as the struct module and array.array call them.
REALS = {"f": 0, "d": 1}
SIGNED, UNSIGNED = "bhilqn", "BHILQN"


class _View(ctypes.Structure):
    """Py_buffer of CPython."""

    _fields_ = [("buf", ctypes.c_void_p), ("obj", ctypes.c_void_p), ("len", ctypes.c_ssize_t),
                ("itemsize", ctypes.c_ssize_t), ("readonly", ctypes.c_int), ("ndim", ctypes.c_int),
                ("format", ctypes.c_void_p), ("shape", ctypes.c_void_p), ("strides", ctypes.c_void_p),
                ("suboffsets", ctypes.c_void_p), ("internal", ctypes.c_void_p)]


class Pinned:
    """The address of contiguous memory, as long as this object lives."""

    def __init__(self, view):
        self.view, self.raw = view, None
        if view.nbytes == 0:
            self.address = None
        elif not view.readonly:
            self.raw = (ctypes.c_char * view.nbytes).from_buffer(view)
            self.address = ctypes.addressof(self.raw)
        elif sys.implementation.name == "cpython":
            raw = _View()
            ctypes.pythonapi.PyObject_GetBuffer(ctypes.py_object(view), ctypes.byref(raw), 0)
            self.address = raw.buf
            ctypes.pythonapi.PyBuffer_Release(ctypes.byref(raw))  # the view holds the memory itself
        else:
            self.raw = (ctypes.c_char * view.nbytes).from_buffer_copy(view)
            self.address = ctypes.addressof(self.raw)


def numpy_module():
    """numpy, or None where there is none."""
    if "numpy" not in sys.modules and importlib.util.find_spec("numpy") is None:
        return None
    import numpy

    return numpy


def is_scalar(value):
    if isinstance(value, numbers.Number):
        return True
    return type(value).__module__ == "numpy" and getattr(value, "shape", None) == () and hasattr(value, "item")


def real(value, what):
    """A number as a double; no complex numbers, no words."""
    if isinstance(value, (bool, str, bytes)) or not (isinstance(value, numbers.Real) or is_scalar(value)):
        raise TypeError("%s must be a number, got %s" % (what, type(value).__name__))
    try:
        return float(value)
    except OverflowError:
        return math.inf if value > 0 else -math.inf


def _from_list(values):
    numpy = numpy_module()
    if numpy is not None:
        found = numpy.asarray(values)
        return memoryview(found) if found.size or found.dtype.kind in "iuf" else memoryview(found.astype("d"))
    flat = list(values)
    for value in flat:
        real(value, "an element")
    if flat and all(isinstance(value, int) for value in flat):
        return memoryview(array.array("q", flat))
    return memoryview(array.array("d", flat))


class Input:
    """Numbers that are read: `code` is their type, `shape` their shape, `pinned` where they lie."""

    def __init__(self, values, what):
        self.values = values
        try:
            view = memoryview(values)
        except (TypeError, ValueError, BufferError):
            if isinstance(values, (str, dict, set)) or not hasattr(values, "__len__"):
                raise TypeError("%s must be a number or an array of numbers, got %s"
                                % (what, type(values).__name__)) from None
            view = _from_list(values)
        self.code = view.format.lstrip("@=<" if sys.byteorder == "little" else "@=>!")
        if self.code not in REALS and self.code not in tuple(SIGNED + UNSIGNED):
            raise TypeError("%s must be float32, float64 or integers in the order of this machine's bytes, got '%s'"
                            % (what, view.format))
        self.shape, self.itemsize = view.shape, view.itemsize
        self.count = 1
        for side in self.shape:
            self.count *= side
        if view.nbytes and not view.c_contiguous:
            view = memoryview(view.tobytes())  # in the order of the indices
        self.view = view
        self.pinned = Pinned(view)

    def convert(self, code):
        """The same as another type, in a copy."""
        numpy = numpy_module()
        raw = bytes(self.view.cast("B")) if self.view.nbytes else b""
        if numpy is not None:
            view = memoryview(numpy.frombuffer(raw, self.code).astype(code))
        else:
            source = memoryview(raw).cast(self.code) if raw else ()
            view = memoryview(array.array(code, source))
        self.code, self.itemsize, self.view, self.pinned = code, view.itemsize, view, Pinned(view)

    def reals(self, what):
        """Has the elements as float32 or float64."""
        if self.code not in REALS:
            self.convert("d")
        return REALS[self.code]

    def words(self, narrow):
        """Has the elements as uint32, or uint16 where `narrow`; none may be negative or above 2^32 - 1."""
        if self.code in SIGNED or self.itemsize > 4:
            numpy = numpy_module()
            raw = bytes(self.view.cast("B")) if self.view.nbytes else b""
            elements = numpy.frombuffer(raw, self.code) if numpy is not None else memoryview(raw or b"").cast(self.code)
            if raw:
                least, most = (elements.min(), elements.max()) if numpy is not None else (min(elements), max(elements))
                if least < 0 or most > 0xFFFFFFFF:
                    raise ValueError("codes must be from 0 to 4294967295, got %d" % (least if least < 0 else most))
        if self.code in SIGNED or self.itemsize not in (2, 4) or (self.itemsize == 2 and not narrow):
            self.convert("I")
        return 0 if self.itemsize == 2 else 1


def output(like, code, out=None):
    """Memory for `like.count` elements, of the kind of `like.values`: the object, and its view."""
    if out is not None:
        view = memoryview(out)
        if view.readonly or not view.c_contiguous:
            raise ValueError("out must be contiguous memory that can be written")
        if view.format.lstrip("@=<") not in (code if len(code) > 1 else (code,)):
            raise TypeError("out must have elements of type '%s', got '%s'" % (code, view.format))
        if view.nbytes != like.count * view.itemsize:
            raise ValueError("out must have as many elements as are read, %d, got %d"
                             % (like.count, view.nbytes // view.itemsize))
        return out, view
    code = code[0]
    kind = type(like.values).__module__
    numpy = None if isinstance(like.values, (array.array, memoryview)) else numpy_module()
    if numpy is not None or kind == "numpy":
        made = numpy.empty(like.shape, code)
        return made, memoryview(made)
    made = array.array(code, [0]) * like.count
    view = memoryview(made)
    if isinstance(like.values, array.array) or len(like.shape) <= 1:
        return (view if isinstance(like.values, memoryview) else made), view
    shaped = view.cast("B").cast(code, like.shape) if like.count else view
    return shaped, view
