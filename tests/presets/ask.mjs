// SPDX-License-Identifier: GPL-3.0-or-later
// Asks engines for the planes of random cameras, a line each: a preset with its numbers, near and far. Lengths of maps are in
// metres, by the scale that the engine itself gives for the map's middle.
import { LngLat } from "./maplibre/geo/lng_lat.ts";
import { MercatorTransform } from "./maplibre/geo/projection/mercator_transform.ts";
import { VerticalPerspectiveTransform } from "./maplibre/geo/projection/vertical_perspective_transform.ts";
import { WebMercatorViewport, _GlobeViewport as GlobeViewport } from "@deck.gl/core";

let state = Number(process.argv[2]) >>> 0;
const random = () => { // of 32 bits
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state / 2 ** 32;
};
const between = (lo, hi, digits = 3) => Number((lo + (hi - lo) * random()).toFixed(digits));
const say = (name, numbers, near, far) =>
    console.log(`${name}:${Object.entries(numbers).map(([key, value]) => `${key}=${value}`).join(",")} ${near} ${far}`);
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
