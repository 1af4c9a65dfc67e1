// SPDX-License-Identifier: GPL-3.0-or-later
// Asks engines for the planes of random cameras, a line each: a preset with its numbers, near and far. Lengths of maps are in
// metres, by the scale that the engine itself gives for the map's middle.
import { LngLat } from "./maplibre/geo/lng_lat.ts";
import { MercatorTransform } from "./maplibre/geo/projection/mercator_transform.ts";
import { VerticalPerspectiveTransform } from "./maplibre/geo/projection/vertical_perspective_transform.ts";
import { readFileSync } from "node:fs";
import { FreeCamera, MeshBuilder, NullEngine, Scene, Vector3 } from "@babylonjs/core";
import "@babylonjs/core/Helpers/sceneHelpers.js";
import vtkRenderer from "@kitware/vtk.js/Rendering/Core/Renderer.js";
import { PerspectiveCamera } from "three";
import { WebMercatorViewport, _GlobeViewport as GlobeViewport } from "@deck.gl/core";

const [, , seed, modules] = process.argv;
let state = Number(seed) >>> 0;
const random = () => { // of 32 bits
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state / 2 ** 32;
};
const between = (lo, hi, digits = 3) => Number((lo + (hi - lo) * random()).toFixed(digits));
const say = (name, numbers, near, far) =>
    console.log(`${name}:${Object.entries(numbers).map(([key, value]) => `${key}=${value}`).join(",")} ${near} ${far}`);
const source = (file) => readFileSync(`${modules}/${file}`, "utf8");
const view = () => ({
    zoom: between(0, 22), pitch: between(0, 85), latitude: between(-80, 80), height: 100 + Math.floor(2000 * random()),
});

for (let i = 0; i < 40; i++)
    for (const [name, Transform] of [["maplibre", MercatorTransform], ["maplibre-globe", VerticalPerspectiveTransform]]) {
        const seen = { ...view(), fov: between(10, 60) };
        const map = new Transform({ minZoom: -5, maxZoom: 26, minPitch: 0, maxPitch: 85, renderWorldCopies: true });
        map.setConstrainOverride?.((center, zoom) => ({ center, zoom }));
        map.resize(1280, seen.height);
        map.setFov(seen.fov);
        map.setZoom(seen.zoom);
        map.setPitch(seen.pitch);
        map.setCenter(new LngLat(10, seen.latitude));
        if (Math.abs(map.zoom - seen.zoom) > 1e-9 || Math.abs(map.center.lat - seen.latitude) > 1e-9)
            continue; // the map is held within the canvas
        say(name, seen, map.nearZ / map.pixelsPerMeter, map.farZ / map.pixelsPerMeter);
    }
for (let i = 0; i < 40; i++) {
    const flat = { ...view(), near: between(0.01, 1), far: between(1, 3) };
    const options = ({ near, far, ...more }) => ({ width: 1280, longitude: 10, nearZMultiplier: near, farZMultiplier: far, ...more });
    const planes = (viewport) => { // of its matrix, z' = A z + B
        const [a, b] = [viewport.projectionMatrix[10], viewport.projectionMatrix[14]];
        return [b / (a - 1), b / (a + 1)];
    };
    const map = new WebMercatorViewport(options(flat));
    const metre = map.distanceScales.unitsPerMeter[2] * map.scale / flat.height;
    say("deckgl", flat, ...planes(map).map((z) => z / metre));
    const round = { ...view(), near: between(0.01, 1), far: between(1, 3) };
    const globe = new GlobeViewport(options(round));
    const screen = globe.distanceScales.unitsPerMeter[2] * globe.scale / round.height;
    say("deckgl-globe", round, ...planes(globe).map((z) => z / screen));
}

// Those whose planes are the row's.
for (const [name, camera] of [["three", new PerspectiveCamera()]]) console.log(name, camera.near, camera.far);
const scene = new Scene(new NullEngine()), first = new FreeCamera("first", Vector3.Zero(), scene);
console.log("babylon", first.minZ, first.maxZ);

for (let i = 0; i < 10; i++) { // a box, by its diagonal
    const sides = [1, 2, 3].map(() => between(0.1, 50)), other = new Scene(new NullEngine());
    MeshBuilder.CreateBox("box", { width: sides[0], height: sides[1], depth: sides[2] }, other);
    other.createDefaultCamera(true);
    say("babylon-default", { diagonal: Math.hypot(...sides) }, other.activeCamera.minZ, other.activeCamera.maxZ);
}

// vtk.js, and with another tolerance VTK: a cube that is seen along its diagonal, so that two corners lie on the sphere.
for (let i = 0; i < 20; i++) {
    const half = between(0.1, 50), radius = half * Math.sqrt(3), seen = { radius, distance: between(0.1, 6), fov: between(10, 60) };
    const more = { tolerance: i % 2 === 0 ? 0.01 : 0.001, expansion: between(0, 0.9) };
    const renderer = vtkRenderer.newInstance({ nearClippingPlaneTolerance: more.tolerance, clippingRangeExpansion: more.expansion });
    const camera = renderer.getActiveCamera(), along = seen.distance * half;
    camera.setViewAngle(seen.fov);
    camera.setPosition(along, along, along);
    camera.setFocalPoint(0, 0, 0);
    renderer.resetCameraClippingRange([-1, 1, -1, 1, -1, 1].map((x) => x * half));
    const { expansion, tolerance } = more;
    say(i % 2 === 0 ? "vtkjs" : "vtk", { ...seen, expansion, ...(i % 4 < 2 ? {} : { tolerance }) }, ...camera.getClippingRange());
}

// CesiumJS: its function, out of the text of its module.
const [frusta] = /function updateFrustums[^]*?\n}\n/.exec(source("@cesium/engine/Source/Scene/View.js"));
const update = new Function("SceneMode", "CesiumMath", "FrustumCommands", "defined", `return ${frusta}`)({ SCENE2D: 2, SCENE3D: 3 },
    { EPSILON2: 0.01 }, function (near, far) { Object.assign(this, { near, far }); }, (value) => value !== undefined);
for (let i = 0; i < 10; i++) {
    const numbers = { near: between(0.1, 10), far: between(1e4, 1e7, 0), ratio: between(100, 2000, 0) }, view = { frustumCommandsList: [] };
    const camera = { frustum: { near: 0.01, far: 1e10 } }, options = { farToNearRatio: numbers.ratio, mode: 3 };
    update(view, { frameState: { camera, useLogDepth: false }, ...options }, numbers.near, numbers.far);
    view.frustumCommandsList.forEach(({ near, far }, frustum) => say("cesium-frusta", { ...numbers, frustum }, near, far));
}

// x3dom: its method, out of the text of its bundle, for a scene about the origin.
const x3dom = source("x3dom/x3dom.js"), from = x3dom.indexOf("getProjectionMatrix:function(e){var t=this._vf.fieldOfView,i=this._vf.zFar");
const to = x3dom.indexOf("if(null==this._projMatrix)", from), body = `${x3dom.slice(from + "getProjectionMatrix:".length, to)} return [o, i]; }`;
class Place extends Array {
    subtract(b) { return new Place(...this.map((x, i) => x - b[i])); }
    add(b) { return new Place(...this.map((x, i) => x + b[i])); }
    multiply(b) { return new Place(...this.map((x) => x * b)); }
    length3() { return Math.hypot(...this); }
}
const point = (place) => ({
    subtract: (b) => point(place.subtract(b.place)), add: (b) => point(place.add(b.place)), multiply: (b) => point(place.multiply(b)),
    length: () => place.length3(), place, x: 1, y: 1, z: 1,
});
const vector = function () { return point(new Place(1, 1, 1)); };
vector.copy = (a) => a;
const quaternion = function () {};
const planes = new Function("x3dom", `return ${body}`)({ fields: { SFVec3f: vector, Quaternion: quaternion, Eps: 1e-6 } });
for (let i = 0; i < 10; i++) {
    const half = between(0.1, 50), numbers = { radius: half * Math.sqrt(3), distance: between(0, 6) };
    const inverse = { e3: () => point(new Place(numbers.radius * numbers.distance, 0, 0)), getTransform() {} };
    const area = { _scene: { _lastMin: point(new Place(-half, -half, -half)), _lastMax: point(new Place(half, half, half)) },
        getViewMatrix: () => ({ inverse: () => inverse }) };
    const self = { _vf: { fieldOfView: 0.785398, zFar: -1, zNear: -1 }, _zRatio: 1e4, _nameSpace: { doc: { _viewarea: area } } };
    say("x3dom", numbers, ...planes.call(self, 1));
}
