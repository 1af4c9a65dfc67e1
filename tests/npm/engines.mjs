// SPDX-License-Identifier: GPL-3.0-or-later
// Matrices that three.js and Cesium make: near and far come back as they went in, and what is no projection is refused.
import assert from "node:assert/strict";
import test from "node:test";
import * as Cesium from "@cesium/engine";
import * as THREE from "three";
import { Camera, DepthprecError } from "depthprec";

let state = 20150707;
const unit = () => (state = (Math.imul(state, 1664525) + 1013904223) >>> 0) / 2 ** 32;
const spread = (lo, hi) => lo * (hi / lo) ** unit();
const close = (got, want, bound, what) => assert.ok(got === want || Math.abs(got / want - 1) <= bound, `${what}: ${got} is not ${want}`);
const refuses = (matrix, options, said) => assert.throws(() => Camera.fromMatrix(matrix, options), (error) => error instanceof DepthprecError && (said.test(error.message) || assert.fail(error.message)));
const other = { d3d: "reversed", reversed: "d3d", gl: "gl-reversed", "gl-reversed": "gl" };

// As doubles and as the floats that are uploaded, with each its own bound: 1 - near/far is what their rounding divides.
function judge(elements, mapping, near, far, ortho, what) {
    const lost = far === Infinity ? 1 : ortho ? (far + near) / Math.min(near, far - near) : far / near;
    for (const [given, ulp] of [[Array.from(elements), 2 ** -50], [Float32Array.from(elements), 2 ** -21]]) {
        if (lost * ulp > 0.01) continue; // such floats no longer say where far is
        const c = Camera.fromMatrix(given, { mapping });
        close(c.near, near, ulp * (ortho ? lost : 1), `${what}, near`);
        close(c.far, far, ulp * lost, `${what}, far`);
        assert.deepEqual([c.mapping, c.ortho], [mapping, ortho], what);
        if (mapping === "reversed" && !ortho && far >= 2 * near) assert.deepEqual({ ...Camera.fromMatrix(given) }, { ...c }, what);
        else refuses(given, {}, /more than one convention/);
        if (!ortho) refuses(given, { mapping: other[mapping] }, /with distance: the mapping must be/);
    }
}

// In three reversed depth is that of NDC from 0 to 1, whatever the API.
const systems = [[THREE.WebGLCoordinateSystem, false, "gl"], [THREE.WebGPUCoordinateSystem, false, "d3d"], [THREE.WebGLCoordinateSystem, true, "reversed"],
    [THREE.WebGPUCoordinateSystem, true, "reversed"]];

test("three.js: standard and reversed, perspective and orthographic", () => {
    for (let i = 0; i < 200; i++) {
        const near = spread(1e-3, 10), far = near * spread(3, 1e6), side = near * spread(0.1, 3);
        for (const [system, reversed, mapping] of systems) {
            const m = new THREE.Matrix4().makePerspective(-side, side * (1 + unit()), side, -side, near, far, system, reversed);
            judge(m.elements, mapping, near, far, false, `perspective ${mapping} ${near} ${far}`);
            const flat = new THREE.Matrix4().makeOrthographic(-side, side, side, -side, near, far, system, reversed);
            judge(flat.elements, mapping, near, far, true, `orthographic ${mapping} ${near} ${far}`);
        }
    }
});

test("three.js: a logarithmic buffer has the standard matrix, which cannot tell it", () => {
    const { elements } = new THREE.PerspectiveCamera(50, 1.5, 0.1, 2000).projectionMatrix, { near, far } = Camera.fromMatrix(elements, { mapping: "gl" });
    close(new Camera({ near, far, mapping: "three-webgl" }).near, 0.1, 1e-14, "near");
    refuses(elements, { mapping: "three-webgl" }, /mapping must be one of/);
});

test("Cesium: standard, infinite, off-centre, orthographic; it looks along -z with NDC from -1 to 1", () => {
    const { Matrix4 } = Cesium, of = (m) => Matrix4.toArray(m);
    for (let i = 0; i < 200; i++) {
        const near = spread(1e-3, 10), far = near * spread(3, 1e6), what = `${near} ${far}`;
        const frustum = new Cesium.PerspectiveFrustum({ fov: 0.1 + 2 * unit(), aspectRatio: spread(0.5, 2), near, far });
        judge(of(frustum.projectionMatrix), "gl", near, far, false, what);
        judge(of(frustum.infiniteProjectionMatrix), "gl", near, Infinity, false, what);
        const aside = new Cesium.PerspectiveOffCenterFrustum({ left: -near, right: 2 * near, bottom: -near, top: near, near, far });
        judge(of(aside.projectionMatrix), "gl", near, far, false, what);
        judge(of(new Cesium.OrthographicFrustum({ width: 10, aspectRatio: 2, near, far }).projectionMatrix), "gl", near, far, true, what);
    }
});

test("what is no projection", () => {
    const camera = new THREE.PerspectiveCamera(60, 2, 0.1, 1000), view = new THREE.Matrix4().makeRotationX(1).setPosition(1, 2, 3);
    refuses(view.elements, {}, /./);
    refuses(new THREE.Matrix4().makeRotationY(0.3).elements, { mapping: "gl" }, /first row must be/);
    refuses(camera.projectionMatrix.clone().multiply(view).elements, { mapping: "gl" }, /fourth row/);
    refuses(camera.projectionMatrixInverse.elements, { mapping: "gl" }, /./);
    refuses(new THREE.Matrix4().makePerspective(-1, 1, 1, -1, 0.1, Infinity).elements, { mapping: "gl" }, /finite/); // of three itself: NaN
    const tilted = camera.projectionMatrix.clone(); // as its Reflector cuts at the mirror
    tilted.elements[2] = 0.1;
    refuses(tilted.elements, { mapping: "gl" }, /the same for every pixel/);
});
