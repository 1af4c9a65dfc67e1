# SPDX-License-Identifier: MIT
"""Memory of any kind: buffers of numbers in, buffers of the same kind out. No element is touched here."""
import array
import ctypes
import importlib.util
import math
import numbers
import sys

# Types of elements, as the struct module and array.array call them; those of this machine's order of bytes.
REALS = {"f": 0, "d": 1}
CODES = "bBhHiIlLqQnN"
_HERE = ("", "@", "=", "<" if sys.byteorder == "little" else ">")
KINDS = {order + code: code for order in _HERE for code in "fd" + CODES}


class _View(ctypes.Structure):
    """Py_buffer of CPython."""

    _fields_ = [("buf", ctypes.c_void_p), ("obj", ctypes.c_void_p), ("len", ctypes.c_ssize_t),
                ("itemsize", ctypes.c_ssize_t), ("readonly", ctypes.c_int), ("ndim", ctypes.c_int),
                ("format", ctypes.c_void_p), ("shape", ctypes.c_void_p), ("strides", ctypes.c_void_p),
                ("suboffsets", ctypes.c_void_p), ("internal", ctypes.c_void_p)]


def pin(view):
    """The address of contiguous memory, and what keeps it there."""
    if not view.nbytes:
        return None, None
    if not view.readonly:
        held = ctypes.c_char.from_buffer(view)
        return ctypes.addressof(held), held
    if sys.implementation.name != "cpython":
        held = (ctypes.c_char * view.nbytes).from_buffer_copy(view)
        return ctypes.addressof(held), held
    raw = _View()
    ctypes.pythonapi.PyObject_GetBuffer(ctypes.py_object(view), ctypes.byref(raw), 0)
    ctypes.pythonapi.PyBuffer_Release(ctypes.byref(raw))  # the view itself holds the memory
    return raw.buf, view


def numpy_module():
    """numpy, or None where there is none."""
    if "numpy" not in sys.modules and importlib.util.find_spec("numpy") is None:
        return None
    import numpy

    return numpy


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


def given(values, what):
    """Numbers as an Input; None where it is a single one."""
    if type(values) is float or type(values) is int:
        return None
    try:
        view = memoryview(values)
    except (TypeError, ValueError, BufferError):
        if is_scalar(values):
            return None
        if isinstance(values, (str, dict, set)) or not hasattr(values, "__len__"):
            raise TypeError("%s must be a number or an array of numbers, got %s"
                            % (what, type(values).__name__)) from None
        view = _from_list(values)
    return Input(values, view, what) if view.ndim > 0 else None


class Input:
    """Numbers that are read: `code` is their type, `shape` their shape, `address` where they lie."""

    __slots__ = ("values", "code", "shape", "count", "view", "address", "held")

    def __init__(self, values, view, what):
        self.values = values
        code = KINDS.get(view.format)
        if code is None:
            raise TypeError("%s must be float32, float64 or integers in the order of this machine's bytes, got '%s'"
                            % (what, view.format))
        self.code, self.shape, self.count = code, view.shape, view.nbytes // view.itemsize
        if not view.c_contiguous and self.count:
            view = memoryview(view.tobytes()).cast(code)  # in the order of the indices
        self.view = view
        self.address, self.held = pin(view)

    def convert(self, code):
        """The same as another type, in a copy."""
        elements = self._elements()
        numpy = numpy_module()
        self.view = memoryview(array.array(code, elements) if numpy is None else elements.astype(code))
        self.code = code
        self.address, self.held = pin(self.view)

    def _elements(self):
        """One after the other; of numpy where it is there."""
        raw, numpy = self.view.tobytes(), numpy_module()
        return memoryview(raw).cast(self.code) if numpy is None else numpy.frombuffer(raw, self.code)

    def real(self):
        """Has the elements as float32 or float64, and says which."""
        if self.code not in REALS:
            self.convert("d")
        return REALS[self.code]

    def word(self, narrow):
        """Has the elements as uint32, or uint16 where `narrow`, and says which; none is negative or above 2^32 - 1."""
        if self.code == "I" or (self.code == "H" and narrow):
            return int(self.code == "I")
        if self.count and self.code not in "BH":
            elements = self._elements()
            least, most = min(elements.tolist()), max(elements.tolist())
            if least < 0 or most > 0xFFFFFFFF:
                raise ValueError("codes must be from 0 to 4294967295, got %d" % (least if least < 0 else most))
        self.convert("I")
        return 1


def output(like, codes, out=None, in_place=True):
    """Memory for as many elements as `like` has, and of the kind of `like.values`: the object, its address, what keeps
    it there and the size of an element. Its type is the first of `codes`, that of `out` any of them."""
    if out is not None:
        view = memoryview(out)
        if view.readonly or not view.c_contiguous:
            raise ValueError("out must be contiguous memory that can be written")
        if KINDS.get(view.format, "?") not in codes:
            raise TypeError("out must have elements of type '%s', got '%s'" % ("' or '".join(codes), view.format))
        if view.nbytes != like.count * view.itemsize:
            raise ValueError("out must have as many elements as are read, %d, got %d"
                             % (like.count, view.nbytes // view.itemsize))
        address, held = pin(view)
        same = in_place and address == like.address and view.nbytes <= like.view.nbytes
        if address and not same and -view.nbytes < address - like.address < like.view.nbytes:
            raise ValueError("out must not overlap what is read%s" % (" unless both are one array" if in_place else ""))
        return out, address, held, view.itemsize
    code, values = codes[0], like.values
    numpy = None if isinstance(values, (array.array, memoryview)) else numpy_module()
    if numpy is not None:
        made = numpy.empty(like.shape, code)
    else:
        made = array.array(code, (0,)) * like.count
    view = memoryview(made)
    address, held = pin(view)
    if numpy is None and len(like.shape) > 1 and like.count and not isinstance(values, array.array):
        made = view.cast("B").cast(code, like.shape)
    elif isinstance(values, memoryview):
        made = view
    return made, address, held, view.itemsize
