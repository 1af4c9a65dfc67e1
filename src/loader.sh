#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# After an installation: tells the dynamic loader of the library, or says how programs will find it:  loader.sh LIBDIR
# The program needs neither; it has the library in itself.
libdir=$1
PATH=$PATH:/usr/sbin:/sbin

if ! ldconfig -N -X -v 2>/dev/null | grep -q "^$libdir: "; then
    echo "depthprec: the dynamic loader does not search $libdir. To use the library from there:" \
        "PKG_CONFIG_PATH=$libdir/pkgconfig when compiling, LD_LIBRARY_PATH=$libdir when running" >&2
elif ! ldconfig 2>/dev/null; then
    echo "depthprec: for the dynamic loader to know the library, run as root: ldconfig" >&2
fi
