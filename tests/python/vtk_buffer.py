# SPDX-License-Identifier: GPL-3.0-or-later
"""Planes of random slants and cameras, drawn by VTK into its own z-buffer, which the package reads through VTK's matrix.

Where a plane lies in a pixel's centre is worked out here. Every depth that is read must lie within separation() of it,
along the normal; some must be off by a tenth of that, and a reading in the wrong convention by more than it.
"""
import array
import math
import os
import random
import sys

import vtkmodules.vtkRenderingOpenGL2  # noqa: F401, it draws
from vtkmodules.vtkCommonCore import vtkFloatArray
from vtkmodules.vtkFiltersSources import vtkPlaneSource
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow

from depthprec import Camera, Error

WIDTH, HEIGHT, FOV, PLANES = 96, 64, 50.0, 200


class Scene:
    """One quadrilateral before a camera at the origin that looks along -z."""

    def __init__(self):
        self.window, self.renderer, self.plane = vtkRenderWindow(), vtkRenderer(), vtkPlaneSource()
        self.window.SetOffScreenRendering(1)
        self.window.SetMultiSamples(0)
        self.window.SetSize(WIDTH, HEIGHT)
        self.window.AddRenderer(self.renderer)
        mapper, actor = vtkPolyDataMapper(), vtkActor()
        mapper.SetInputConnection(self.plane.GetOutputPort())
        actor.SetMapper(mapper)
        self.renderer.AddActor(actor)
        self.camera = self.renderer.GetActiveCamera()
        self.camera.SetPosition(0, 0, 0)
        self.camera.SetFocalPoint(0, 0, -1)
        self.camera.SetViewUp(0, 1, 0)
        self.camera.SetViewAngle(FOV)

    def draw(self, near, far, corners):
        """The matrix, row by row, and the depths of the buffer, from the lower left corner."""
        self.camera.SetClippingRange(near, far)
        for place, corner in zip((self.plane.SetOrigin, self.plane.SetPoint1, self.plane.SetPoint2), corners):
            place(*corner)
        self.window.Render()
        found, matrix = vtkFloatArray(), self.camera.GetProjectionTransformMatrix(WIDTH / HEIGHT, -1, 1)
        self.window.GetZbufferData(0, 0, WIDTH - 1, HEIGHT - 1, found)
        depths = array.array("f", (found.GetValue(i) for i in range(WIDTH * HEIGHT)))
        return [matrix.GetElement(i, j) for i in range(4) for j in range(4)], depths


def rays():
    """Where each pixel's centre looks: x and y at depth 1."""
    up = math.tan(math.radians(FOV / 2))
    for row in range(HEIGHT):
        for column in range(WIDTH):
            yield ((2 * column + 1) / WIDTH - 1) * up * WIDTH / HEIGHT, ((2 * row + 1) / HEIGHT - 1) * up


def random_plane(r):
    """A camera, the plane z = base + x across + y along of depths before it, and three corners of it, as float32."""
    near = 10 ** r.uniform(-2, 0)
    far = near * 10 ** r.uniform(2, 5)
    base = near * (far / near) ** r.uniform(0.2, 0.8)
    slopes = (0.0, 0.0) if r.random() < 0.2 else (r.uniform(-0.7, 0.7), r.uniform(-0.7, 0.7))
    across, along = (array.array("f", [x])[0] for x in slopes)
    half = 2.0 ** math.ceil(math.log2(base * 2))  # so that the sums below are few bits apart
    corners = [(x, y, -(base + x * across + y * along)) for x, y in ((-half, -half), (half, -half), (-half, half))]
    return near, far, (base, across, along), corners


def main():
    seed = int(os.environ.get("DEPTHPREC_SEED", "20150707"))
    r, scene, fractions, wrong, judged = random.Random(seed), Scene(), [], 0, 0
    print("seed", seed)
    for _ in range(PLANES):
        near, far, (base, across, along), corners = random_plane(r)
        matrix, depths = scene.draw(near, far, corners)
        camera = Camera.from_matrix(matrix, "gl", format="fp32", viewport=(WIDTH, HEIGHT), fov=FOV,
                                    triangle_class=(8.0, 1024.0, 64.0))
        if not (math.isclose(camera.near, near, rel_tol=1e-9) and math.isclose(camera.far, far, rel_tol=1e-6)):
            sys.exit("near %r and far %r were set, %r are found" % (near, far, camera))
        read = camera.decode_window(depths)
        other = Camera(camera.near, camera.far, "fp32", "reversed").decode_window(depths)
        for (x, y), depth, z, mistaken in zip(rays(), depths, read, other):
            steep = 1 - x * across - y * along
            if depth == 1 or steep <= 0.2:
                continue
            truth = base / steep
            if not 1.01 * near < truth < 0.99 * far:
                continue
            away = steep / math.sqrt(1 + across * across + along * along)  # how far along the normal a step of z leads
            allowed = camera.separation(truth)
            judged += 1
            fractions.append(abs(z - truth) * away / allowed)
            wrong += abs(mistaken - truth) * away > allowed
            if fractions[-1] > 1:
                sys.exit("near %r far %r plane %r: %r is read at %r, %r are allowed"
                         % (near, far, (base, across, along), z, truth, allowed))
    print("planes %d, pixels %d, worst %.3f of the separation" % (PLANES, judged, max(fractions)))
    if judged < 100000 or max(fractions) < 0.1 or wrong < 0.99 * judged:
        sys.exit("too few pixels, or too slack: %d of them are noticed where they are read wrongly" % wrong)
    try:
        Camera.from_matrix([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 1, 1]])
    except Error:
        return
    sys.exit("a matrix that is no projection was taken")


main()
