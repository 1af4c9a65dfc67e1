#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# A real program's buffer and matrix: VTK draws planes, and its z-buffer is read through its own projection matrix. Of
# `make check-full`, where VTK for Python and a display, or xvfb-run, are here (Debian: python3-vtk9, xvfb).
. tests/tap.sh

what="planes that VTK drew are where its z-buffer and matrix say"
python() { for python in python3 /usr/bin/python3; do $python -c 'import vtkmodules' 2>"$scratch/log" && return; done; }
screen() { if command -v xvfb-run >"$scratch/log"; then xvfb-run -a "$@"; else [ -n "${DISPLAY-}" ] && "$@"; fi; }
wheel() {
    (unset MAKEFLAGS MFLAGS MAKELEVEL && make --no-print-directory B="$B" CC="$CC" wheel-parts) >"$scratch/log" 2>&1 &&
        B=$B $python src/python/package.py "$scratch" >"$scratch/log" &&
        $python -m zipfile -e "$scratch"/depthprec-*.whl "$scratch/site"
}
drawn() {
    wheel && PYTHONPATH=$scratch/site screen $python tests/python/vtk_buffer.py >"$scratch/out" 2>&1
    status=$?
    cat "$scratch/out"
    [ $status -eq 0 ] && grep -q '^planes' "$scratch/out"
}

if [ -z "${DEPTHPREC_FULL-}" ]; then
    skip "$what" "make check-full draws them"
elif ! python || ! screen true; then
    skip "$what" "there is no VTK for Python, or no display"
else
    check "$what" drawn
fi
finish
