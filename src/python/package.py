# SPDX-License-Identifier: MIT
"""Writes the wheel and the sdist, and builds the sdist for pip (PEP 517): python3 and its standard library alone.

    B=build python3 src/python/package.py build/dist    a wheel of what make has built in $B, and the sdist

Both are the same bytes whenever and wherever they are written: names sorted, times fixed.
"""
import base64
import gzip
import hashlib
import io
import os
import re
import stat
import subprocess
import sys
import sysconfig
import tarfile
import zipfile

HERE = os.path.dirname(os.path.abspath(__file__))
TOP = os.path.dirname(os.path.dirname(HERE)) if os.path.basename(HERE) == "python" else HERE
EPOCH = (1980, 1, 1, 0, 0, 0)  # the first day of a zip
NEEDED = re.compile(r"(libc|libm|libdl|libpthread|librt|ld-linux.*)\.so\.\d+$")
SOURCES = ("include", "src", "Makefile", "README.md", "LICENSE", "LICENSE.MIT", "LICENSE.GPL-3.0")


def _read(*path):
    with open(os.path.join(TOP, *path), "rb") as file:
        return file.read()


def _version():
    return re.search(rb'#define DP_VERSION +"(.*)"', _read("include", "depthprec", "depthprec.h")).group(1).decode()


def _build():
    return os.path.join(TOP, os.environ.get("B", "build"))


def _platform(binaries):
    """The platform of the wheel: manylinux as new as the newest symbol of the C library that it needs."""
    machine = sysconfig.get_platform().replace("-", "_").replace(".", "_")
    versions = [tuple(map(int, v)) for data in binaries for v in re.findall(rb"GLIBC_(\d+)\.(\d+)\0", data)]
    if not machine.startswith("linux") or not versions:
        return machine
    return machine.replace("linux", "manylinux_%d_%d" % max(versions), 1)


def _check_needs(path):
    """What the program needs but the C library is not on every machine."""
    said = subprocess.run(["readelf", "-d", path], stdout=subprocess.PIPE, check=True).stdout.decode()
    more = [name for name in re.findall(r"NEEDED.*\[(.*)\]", said) if not NEEDED.match(name)]
    if more:
        sys.exit("package.py: %s needs %s: build it with their static libraries" % (path, ", ".join(more)))


def _metadata():
    text = _read("src", "python", "README.md").decode()
    return ("Metadata-Version: 2.1\nName: depthprec\nVersion: %s\n"
            "Summary: What a depth buffer resolves: exact, proven, fast\n"
            "Author: The depthprec authors\nAuthor-email: The depthprec authors <depthprec@packages.debian.org>\n"
            "License: MIT AND GPL-3.0-or-later\nRequires-Python: >=3.8\n"
            "Keywords: depth buffer,z-fighting,precision,graphics\n"
            "Description-Content-Type: text/markdown\n\n%s" % (_version(), text)).encode()


def _stub(text):
    """The stub, with the keys of Camera.__init__ also where others take them: each in their place, without its default."""
    keys = re.findall(rb"^        (\w+)(: .* = )", text.split(b"def __init__(")[1].split(b") -> None")[0], re.M)

    def spelt(asked):
        left_out = asked.group(1).split(b", ") if asked.group(1) else ()
        return b"".join(b"        %s%s...,\n" % key for key in keys if key[0] not in left_out)

    return re.sub(rb"^        # keys of __init__(?: but (.*))?, by package.py\n", spelt, text, flags=re.M)


def _wheel_files():
    build, files = _build(), {}
    for name in sorted(os.listdir(os.path.join(HERE, "depthprec"))):
        if name.endswith((".py", ".pyi", ".typed")):
            data = _read("src", "python", "depthprec", name)
            files["depthprec/" + name] = _stub(data) if name.endswith(".pyi") else data
    for name, path in (("libdepthprec.so.0", "libdepthprec.so.0"), ("bin/depthprec", "plain/depthprec")):
        _check_needs(os.path.join(build, path))
        with open(os.path.join(build, path), "rb") as file:
            files["depthprec/" + name] = file.read()
    return files


def write_wheel(folder):
    """@return the file's name"""
    files = _wheel_files()
    tag = "py3-none-" + _platform([files["depthprec/libdepthprec.so.0"], files["depthprec/bin/depthprec"]])
    info = "depthprec-%s.dist-info/" % _version()
    files[info + "METADATA"] = _metadata()
    files[info + "WHEEL"] = ("Wheel-Version: 1.0\nGenerator: depthprec %s\nRoot-Is-Purelib: false\nTag: %s\n"
                             % (_version(), tag)).encode()
    files[info + "entry_points.txt"] = b"[console_scripts]\ndepthprec = depthprec.__main__:main\n"
    for name in ("LICENSE", "LICENSE.MIT", "LICENSE.GPL-3.0"):
        files[info + "licenses/" + name] = _read(name)
    rows = ["%s,sha256=%s,%d\n" % (name, base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode(),
                                   len(data)) for name, data in sorted(files.items())]
    files[info + "RECORD"] = "".join([*rows, info + "RECORD,,\n"]).encode()
    name = "depthprec-%s-%s.whl" % (_version(), tag)
    with zipfile.ZipFile(os.path.join(folder, name), "w") as wheel:
        for path, data in sorted(files.items(), key=lambda item: (info in item[0], item)):  # its own description last
            entry = zipfile.ZipInfo(path, EPOCH)
            runs = path == "depthprec/bin/depthprec"
            entry.external_attr = (stat.S_IFREG | (0o755 if runs else 0o644)) << 16
            entry.compress_type, entry.create_system = zipfile.ZIP_DEFLATED, 3
            wheel.writestr(entry, data, compresslevel=9)
    return name


def _source_files():
    files = {}
    for source in SOURCES:
        if os.path.isfile(os.path.join(TOP, source)):
            files[source] = _read(source)
        for folder, folders, names in os.walk(os.path.join(TOP, source)):
            folders[:] = [name for name in folders if name != "__pycache__"]
            for name in names:
                path = os.path.relpath(os.path.join(folder, name), TOP)
                files[path.replace(os.sep, "/")] = _read(path)
    files["pyproject.toml"] = _read("src", "python", "pyproject.toml")
    files["PKG-INFO"] = _metadata()
    return files


def write_sdist(folder):
    """@return the file's name"""
    base, packed = "depthprec-" + _version(), io.BytesIO()
    with tarfile.open(fileobj=packed, mode="w", format=tarfile.PAX_FORMAT) as tar:
        for path, data in sorted(_source_files().items()):
            entry = tarfile.TarInfo(base + "/" + path)
            entry.size, entry.mode, entry.mtime = len(data), 0o644, 315532800
            tar.addfile(entry, io.BytesIO(data))
    with open(os.path.join(folder, base + ".tar.gz"), "wb") as file:
        file.write(gzip.compress(packed.getvalue(), 9, mtime=0))
    return base + ".tar.gz"


# ---- What pip calls in an unpacked sdist, where a compiler and the libraries of packages.sh are ----------------------


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    subprocess.run(["make", "-C", TOP, "-j%d" % (os.cpu_count() or 1), "wheel-parts"], check=True, stdout=sys.stderr)
    return write_wheel(wheel_directory)


def build_sdist(sdist_directory, config_settings=None):
    return write_sdist(sdist_directory)


if __name__ == "__main__":
    os.makedirs(sys.argv[1], exist_ok=True)
    for written in (write_wheel(sys.argv[1]), write_sdist(sys.argv[1])):
        print(os.path.join(sys.argv[1], written))
