# SPDX-License-Identifier: MIT
"""The command depthprec, a program of its own beside this file: GPL-3.0-or-later, as the library is not."""
import ast
import json
import keyword
import math
import os
import re
import shlex
import struct
import subprocess
import sys
import tempfile
import warnings

from . import _arrays
from ._core import OLD, Error

PATH = os.path.join(os.path.dirname(os.path.abspath(__file__)), "bin", "depthprec")
FAILED, REFUSED = 1, 2  # exit statuses: a check failed, which is an answer; what was asked cannot be


def run(args, *, input=None, text=False):
    """Runs a command and gives its answer.

    args    words, as a list or as a line of a shell: ``run("table -n 0.1 -F d24 --json")``
    input   bytes or text that the command reads as the file ``-``
    text    gives the text also where it is JSON

    Returns what JSON says as objects where ``--json`` (or ``--report json``) is among the words: a dict whose unbounded
    numbers are None, as depthprec(5) has them. Else text, or bytes where it is none, as of a figure in binary form.
    A check that fails is an answer. What the command says beside its answer is a UserWarning.
    Raises Error, with the command's own sentence, where it refuses or cannot read or write.
    """
    words = shlex.split(args) if isinstance(args, str) else list(args)
    for word in words:
        if not isinstance(word, (str, os.PathLike)):
            raise TypeError("words must be text, got %s" % type(word).__name__)
        if "\0" in os.fspath(word):
            raise Error("a word must not contain a zero byte")
    if isinstance(input, str):
        input = input.encode()
    try:
        done = subprocess.run([PATH, *map(os.fspath, words)], input=b"" if input is None else input,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False)
    except OSError as error:
        raise Error("the program '%s' cannot be run: %s" % (PATH, error.strerror)) from error
    said = done.stderr.decode("utf-8", "replace").strip()
    if done.returncode == FAILED and "GLIBC_" in said:  # the loader's own status
        raise Error("the program cannot be run: %s%s" % (said.splitlines()[-1], OLD), REFUSED)
    if done.returncode not in (0, FAILED):
        raise Error(said.replace("depthprec: ", "", 1) or "the program ended by signal %d" % -done.returncode,
                    done.returncode)
    if said:
        warnings.warn(said, stacklevel=2)
    asked = "--json" in words or any(a == "--report" and b == "json" for a, b in zip(words, words[1:]))
    if asked and not text and done.stdout:
        return json.loads(done.stdout)
    try:
        return done.stdout.decode()
    except UnicodeDecodeError:
        return done.stdout


def words_of(options):
    """Options as words: ``far="10km"``, ``at=[1, 2]``, ``for_="near"``, ``full=True``; None is not there."""
    words = []
    for name, value in options.items():
        if value is None or value is False:
            continue
        words.append("--" + name.strip("_").replace("_", "-"))
        if value is not True:
            words[-1] += "=" + _argument(value)
    return words


def _argument(value):
    if isinstance(value, (list, tuple)):
        return ",".join(map(_argument, value))
    return repr(float(value)) if isinstance(value, float) else str(value)


def answer(words, options, form=("--json",), **more):
    """What a command answers; what it says of options names them as they are called here, without hyphens."""
    try:
        return run([*words, *form, *words_of(options)], **more)
    except Error as error:
        raise Error(_plain(str(error)), error.status) from None


def _plain(said):
    def name(found):
        bare = found.group(1).replace("-", "_")
        return bare + "_" if keyword.iskeyword(bare) else bare

    return re.sub(r"(?<![\w-])--([a-z][a-z0-9-]*)", name, re.sub(r"^-:\d+: ", "", said))


def solve(camera=None, **options):
    """The near or far plane, format, mapping or distance that a separation asks for.

    camera   a Camera, whose near, far, format and mapping are then given; those named in `options` replace them, and
             None leaves one open: ``solve(camera, near=None, separation=0.01, at=5000)``
    options  those of ``depthprec solve``, with _ for -: ``far="10km", format="d24", separation="1cm", at="5km"``

    Returns the JSON of depthprec-solve(1): ``["answer"]["near"]``, ``["possible"]``, ... Raises Error.
    """
    return answer(["solve", "--quiet"], _asked(camera, "solve", options))


def bias(camera=None, **options):
    """What a depth bias does, in the units of an API: ``bias(camera, api="vulkan", separation=0.02, at=300)``.

    Options and JSON are those of ``depthprec bias``; else as solve().
    """
    return answer(["bias", "--quiet"], _asked(camera, "bias", options))


def check(requirements):
    """Whether cameras meet their requirements.

    requirements  the path of a requirement file, or the same as a dict:
                  ``{"cameras": {"world": camera}, "requirements": {"decals": {"camera": "world", "range": [0.5, 50],
                  "separation": "0.1 mm"}}}``, where a camera is a Camera or a dict as depthprec(5) has it

    Returns the JSON of depthprec-check(1), also where one is missed. Raises Error.
    """
    if isinstance(requirements, dict):
        return answer(["check", "-"], {}, input=_group(requirements, "\n"))
    return run(["check", "--json", "--", os.fspath(requirements)])


def recognise(image, camera=None, **options):
    """What a depth image holds: its format, whether it is certain, whether depth is reversed, and why.

    image    rows of samples, (height, width) or (height, width, channels): float16, float32, float64, uint8, uint16 or
             uint32, any buffer; or the path of a file that ``depthprec texture`` reads
    camera, options  as solve(), those of ``depthprec texture``

    Returns a dict: ``format``, ``certain``, ``reversed`` (None: cannot tell), ``why``, and ``samples``, ``packing``,
    ``metric``, ``stereo``, ``lattice``, ``lossy``, ``type``, ``width``, ``height``, ``channels`` as depthprec(5) has
    them. Of metric depth and disparity, ``recognise(image, metric="mm")``, the first four are None, of others ``stereo``
    and ``lattice``.
    Raises Error where it is no depth image, with what it looks like.
    """
    asked = _asked(camera, "texture", options)
    path, input = _source(image)
    found = answer(["texture", path, "--quiet"], asked, input=input)
    kept = ("samples", "packing", "metric", "stereo", "lattice", "lossy", "type", "width", "height", "channels")
    own = found.get("recognised") or dict.fromkeys(("format", "certain", "reversed", "why"))
    return {**own, **{name: found.get(name) for name in kept}}


class Figure(str):
    """The text of an SVG file, which a notebook shows."""

    def _repr_svg_(self):
        return str(self)

    def save(self, path):
        """Writes it to a file."""
        with open(path, "w", encoding="utf-8") as file:
            file.write(self)


def plot(figure, camera=None, *, file=None, **options):
    """A figure of ``depthprec list figures``, as SVG: ``plot("error", camera)``, ``plot("needs", file="game.need")``.

    camera, options  as solve(), those of ``depthprec plot``; file is its FILE

    Returns Figure, a str that a notebook shows and that has save(path). Raises Error.
    """
    words = ["plot", figure, *([] if file is None else [_path(file)]), "--type=svg", "--output=-", "--quiet"]
    return Figure(answer(words, _asked(camera, "plot", options), (), text=True))


def read(image, camera=None, product="eye", **options):
    """The pixels of a depth image as an array: eye depths, or another of ``depthprec list products``.

    image            a path, .png, .exr, .tif, .npy, ..., or an array, as recognise() takes them
    camera, options  as solve(), those of ``depthprec texture``: ``read("0001.png", metric="mm")``

    Returns numpy's array where numpy is there, else a memoryview, of float32 or float64, (height, width) or (height,
    width, channels). Raises Error.
    """
    path, input = _source(image)
    with tempfile.TemporaryDirectory() as folder:
        made = os.path.join(folder, "made.npy")
        asked = {"product": product, **_asked(camera, "texture", options), "output": made}
        answer(["texture", path, "--quiet"], asked, input=input)
        with open(made, "rb") as file:
            data = file.read()
    size = struct.unpack_from("<H", data, 8)[0]
    head, numpy = ast.literal_eval(data[10:10 + size].decode()), _arrays.numpy_module()
    flat = bytearray(data[10 + size:])
    if numpy is not None:
        return numpy.frombuffer(flat, head["descr"]).reshape(head["shape"])
    return memoryview(flat).cast({"f4": "f", "f8": "d", "u1": "B"}[head["descr"][1:]], head["shape"])


def write(path, image, camera=None, product="eye", **options):
    """Writes the pixels of a depth image as read() gives them to a file: PNG of 16 bits, PFM or NPY by its ending.

    ``write("depth.png", z, metric=1, as_="even:0.001")`` writes metres as millimetres; a PNG without ``as_`` is in 65535ths
    of its farthest depth. ``product="pack:rgb24"`` writes packed channels. read() of the file needs no option, because
    a PNG says in itself what it holds. An old file stays until the new one is whole.

    Returns the meaning of the samples, as depthprec(5) has it: offset + scale x sample, ``["scale"]``; of packed channels
    nothing. Raises Error.
    """
    to = os.fspath(path)
    if not isinstance(to, str) or not to.lower().endswith((".png", ".pfm", ".npy")):
        raise Error("a path must end in .png, .pfm or .npy, got %r" % (to,))
    source, input = _source(image)
    asked = {"product": product, **_asked(camera, "texture", options), "output": to}
    form = () if product.startswith("pack") else ("--json",)  # a packing says itself what it means
    return answer(["texture", source, "--quiet"], asked, form, input=input) or {}


def presets():
    """The engines that Camera.preset() knows, dicts of name, aliases, note, camera (in words) and source."""
    return answer(["list", "presets"], {})["items"]


def formats():
    """The depth formats with names of their own, dicts of name, aliases, note, bound and source."""
    return answer(["list", "formats"], {})["items"]


def _asked(camera, command, options):
    given = {} if camera is None else camera._options(command)
    return {**given, **options}


def _source(image):
    """The FILE of an image, and what that reads where it is "-"."""
    return (_path(image), None) if isinstance(image, (str, os.PathLike)) else ("-", _npy(image))


def _path(path):
    """A path that no command takes for an option."""
    path = os.fspath(path)
    return os.path.join(".", path) if path.startswith("-") else path


def _group(group, end=" "):
    """A dict in the grammar of requirement files."""
    return "".join("%s = %s;%s" % (_name(key), _setting(value), end) for key, value in group.items())


def _name(key):
    if not (isinstance(key, str) and key.replace("-", "a").replace("_", "a").replace("*", "a").isalnum()
            and key.isascii() and key[0].isalpha() or key[:1] == "*"):
        raise Error("a name must be letters, digits, - and _, and begin with a letter, got %r" % (key,))
    return key


def _setting(value):
    if hasattr(value, "_options"):
        value = value._options("check")
    if isinstance(value, dict):
        return "{ %s}" % _group(value)
    if isinstance(value, (list, tuple)):
        floats = any(isinstance(item, float) for item in value)
        return "[%s]" % ", ".join(_setting(float(item) if floats and isinstance(item, int) else item) for item in value)
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return '"%s"' % "".join(chr(b) if 0x20 <= b < 0x7F and b not in b'"\\' else "\\x%02x" % b for b in value.encode())
    if isinstance(value, int):
        return "%d" % value
    if isinstance(value, float):
        return repr(value) if math.isfinite(value) else '"%r"' % value
    raise TypeError("a requirement must hold words, numbers, lists and dicts, got %s" % type(value).__name__)


def _npy(image):
    """The bytes of an .npy file."""
    _arrays.refuse_mask(image)
    try:
        view = memoryview(image)
    except TypeError:
        raise TypeError("an image must be an array of numbers or a path, got %s" % type(image).__name__) from None
    kinds = {"e": "f2", "f": "f4", "d": "f8", "B": "u1", "H": "u2", "I": "u4"}
    code, swapped = _arrays.element(view)
    if code not in kinds:
        raise TypeError("an image must be of float16, float32, float64, uint8, uint16 or uint32, got %s"
                        % _arrays.name_of(view))
    order = "<>"[(sys.byteorder == "little") == swapped]
    head = "{'descr': '%s%s', 'fortran_order': False, 'shape': %r, }" % (order, kinds[code], tuple(view.shape))
    head += " " * (-(len(head) + 11) % 64) + "\n"
    return b"\x93NUMPY\x01\x00" + struct.pack("<H", len(head)) + head.encode() + view.tobytes()
