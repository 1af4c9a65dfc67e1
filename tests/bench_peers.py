# SPDX-License-Identifier: GPL-3.0-or-later
"""The array kernels beside numpy and numba, in one process, on the same arrays, in turns.

usage: python3 tests/bench_peers.py LIBRARY

numpy and numba write what one would write first; numba compiles with fastmath, for this processor. The codes that a
peer gets wrong are counted, because a fast wrong answer is no peer.
"""
import ctypes
import sys
import time

try:
    import numpy as np
except ImportError:
    print("peers: numpy is not installed, and so not measured")
    sys.exit(0)
try:
    import numba
except ImportError:
    numba = None

COUNT = 131072
RUNS = 41
REPEAT = 4
NEAR, FAR, TOP = 0.1, 1000.0, 16777215.0


class Format(ctypes.Structure):
    _fields_ = [("name", ctypes.c_char * 16), ("kind", ctypes.c_int), ("bits", ctypes.c_int),
                ("exponent_bits", ctypes.c_int), ("mantissa_bits", ctypes.c_int), ("bias", ctypes.c_int),
                ("code_max", ctypes.c_uint32)]


class Spec(ctypes.Structure):
    """The beginning of dp_spec; what follows the format keeps the values of dp_spec_default()."""
    _fields_ = [("znear", ctypes.c_double), ("zfar", ctypes.c_double), ("ortho", ctypes.c_int),
                ("mapping", ctypes.c_int), ("format", Format), ("rest", ctypes.c_char * 512)]


TASK = {"code": 0, "eye": 1, "width": 2, "encode": 3, "decode": 4}
ROOM = 16384  # bytes, more than a set-up or a batch has


class Batch:
    """One of the library's array tasks on float depths and codes of 2 or 4 bytes."""

    def __init__(self, library, name, task, word):
        formats = (Format * 2)()
        self.library = library
        self.setup = ctypes.create_string_buffer(ROOM)
        self.batch = ctypes.create_string_buffer(ROOM)
        default = library.dp_spec_default
        default.restype = Spec
        spec = default()
        if library.dp_format_parse(name.encode(), formats) == 0:
            sys.exit("bench_peers.py: no format " + name)
        spec.format = formats[0]
        spec.znear, spec.zfar = NEAR, FAR
        mapping = ctypes.c_int()
        if library.dp_mapping_parse(b"d3d", ctypes.byref(mapping)) != 0:
            sys.exit("bench_peers.py: no mapping d3d")
        spec.mapping = mapping.value
        if library.dp_setup_init(self.setup, ctypes.byref(spec)) != 0:
            sys.exit("bench_peers.py: the set-up was refused")
        path = library.dp_path_best()
        if library.dp_batch_init(self.batch, self.setup, TASK[task], 0, 0 if word == 2 else 1, path) != 0:
            sys.exit("bench_peers.py: the task was refused")

    def call(self, source, target):
        """A call with its arguments converted: that alone takes microseconds."""
        run = self.library.dp_batch_run
        into, out = (a.ctypes.data_as(ctypes.c_void_p) for a in (source, target))
        size = ctypes.c_size_t(source.size)
        return lambda: run(self.batch, into, out, size)


def eye_depths(count):
    return (NEAR * (FAR / NEAR) ** np.random.default_rng(1).random(count)).astype(np.float32)


def windows(count):
    return np.random.default_rng(2).random(count).astype(np.float32)


def codes(count):
    return np.random.default_rng(3).integers(0, int(TOP), count, dtype=np.uint32)


def halves(count):
    return windows(count).astype(np.float16).view(np.uint16)


def numpy_half(d):
    return d.astype(np.float16).view(np.uint16)


def numpy_of_half(c):
    return c.view(np.float16).astype(np.float32)


def numpy_encode(d):
    return np.rint(d.astype(np.float64) * TOP).astype(np.uint32)


def numpy_decode(c):
    return (c / TOP).astype(np.float32)


def numpy_code(z):
    z = z.astype(np.float64)
    return np.rint((z - NEAR) / z * (FAR / (FAR - NEAR)) * TOP).astype(np.uint32)


def numpy_eye(c):
    d = c / TOP
    return (NEAR * FAR / (NEAR * d + FAR * (1.0 - d))).astype(np.float32)


def compiled():
    """The same, element by element."""
    jit = numba.njit(fastmath=True)

    @jit
    def encode(d, out):
        for i in range(d.size):
            out[i] = np.uint32(np.float64(d[i]) * TOP + 0.5)

    @jit
    def decode(c, out):
        for i in range(c.size):
            out[i] = np.float32(np.float64(c[i]) * (1.0 / TOP))

    @jit
    def code(z, out):
        scale = FAR / (FAR - NEAR) * TOP
        for i in range(z.size):
            out[i] = np.uint32((np.float64(z[i]) - NEAR) / np.float64(z[i]) * scale + 0.5)

    @jit
    def eye(c, out):
        for i in range(c.size):
            out[i] = np.float32(NEAR * FAR * TOP / (FAR * TOP - (FAR - NEAR) * np.float64(c[i])))

    return {"d -> unorm24": encode, "unorm24 -> d": decode, "eye depth -> unorm24": code,
            "unorm24 -> eye depth": eye}


ROWS = [
    ("f32 -> fp16", "fp16", "encode", windows, np.uint16, numpy_half),
    ("fp16 -> f32", "fp16", "decode", halves, np.float32, numpy_of_half),
    ("d -> unorm24", "unorm24", "encode", windows, np.uint32, numpy_encode),
    ("unorm24 -> d", "unorm24", "decode", codes, np.float32, numpy_decode),
    ("eye depth -> unorm24", "unorm24", "code", eye_depths, np.uint32, numpy_code),
    ("unorm24 -> eye depth", "unorm24", "eye", codes, np.float32, numpy_eye),
]


def timed(call):
    call()  # another has had the cache
    start = time.perf_counter()
    for _ in range(REPEAT):
        call()
    return (time.perf_counter() - start) * 1e9 / REPEAT / COUNT


def wrong(ours, theirs):
    """How many answers differ: codes at all, depths by more than 4 steps of binary32."""
    if ours.dtype == np.float32:
        return int(np.count_nonzero(np.abs(ours - theirs) > np.abs(ours) * 2.0 ** -22))
    return int(np.count_nonzero(ours != theirs))


def cells(ns, ours, missed):
    return f"{ns:9.3f} {ns / ours:7.1f} {100.0 * missed / COUNT:7.3f}%" if ns is not None else f"{'-':>9} {'-':>7} {'-':>8}"


def main():
    library = ctypes.CDLL(sys.argv[1])
    loops = compiled() if numba is not None else {}
    print(f"\n{COUNT} elements, ns per element; numpy {np.__version__}, "
          f"numba {numba.__version__ if numba is not None else 'not installed'}")
    print(f"{'':31} {'ours':>8} {'numpy':>9} {'x ours':>7} {'differs':>8} {'numba':>9} {'x ours':>7} {'differs':>8}")
    for name, form, task, make, kind, plain in ROWS:
        source = make(COUNT)
        ours, peer = np.empty(COUNT, kind), np.empty(COUNT, kind)
        batch = Batch(library, form, task, 2 if form == "fp16" else 4)
        calls = [batch.call(source, ours), lambda: plain(source)]
        if name in loops:
            calls.append(lambda: loops[name](source, peer))
        for call in calls:
            call()
        rounds = [[timed(call) for call in calls] for _ in range(RUNS)]
        ns = [float(np.median([r[k] for r in rounds])) for k in range(len(calls))]
        third = (ns[2], ns[0], wrong(ours, peer)) if len(ns) > 2 else (None, 0, 0)
        print(f"{name:31} {ns[0]:8.3f} {cells(ns[1], ns[0], wrong(ours, plain(source)))} {cells(*third)}")


main()
