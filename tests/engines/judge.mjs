// SPDX-License-Identifier: GPL-3.0-or-later
// Depth functions of engines, as npm ships them, beside the projection matrices that those engines make themselves.
//
//     node judge.mjs CASES OUT
//
// It lies beside node_modules. Of each row of CASES (its columns are explained there) the truth is computed here, in doubles: the
// text of the function, translated word for word, or an expression of CASES, at depths that the engine's own matrix gives. A row
// that says another thing ends this. OUT gets a shader file for each row: the text that the package ships, the engine's own
// #define lines and includes in front; no body is changed. OUT/list has a line for each row: what judge should say: verdict, computes, from; what
// is true; the row's name; the arguments of `depthprec judge`.
import { execFileSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { NullEngine } from "@babylonjs/core/Engines/nullEngine.js";
import { Scene } from "@babylonjs/core/scene.js";
import { FreeCamera } from "@babylonjs/core/Cameras/freeCamera.js";
import { Vector3 } from "@babylonjs/core/Maths/math.vector.js";
import * as Cesium from "@cesium/engine";
import * as playcanvas from "playcanvas";
import * as THREE from "three";

const [cases, out] = process.argv.slice(2), near = 0.25, far = 200;

// ---- Cameras, by each engine's own code: projection matrix by columns, its NDC depths from lo to 1, toward: view z of eye depth 1 --------

function ofThree({ ortho, reversed, webgpu, log }) {
    const camera = ortho ? new THREE.OrthographicCamera(-1, 1, 1, -1, near, far) : new THREE.PerspectiveCamera(50, 1, near, far);
    camera._reversedDepth = reversed;
    camera.coordinateSystem = webgpu ? THREE.WebGPUCoordinateSystem : THREE.WebGLCoordinateSystem;
    camera.updateProjectionMatrix();
    const names = { near: camera.near, far: camera.far, logDepthBufFC: 2 / (Math.log(camera.far + 1) / Math.LN2) }; // as WebGLRenderer.js has it
    for (const name of ["camera", "virtualCamera", ""]) Object.assign(names, { [`${name}Near`]: near, [`${name}Far`]: far });
    Object.assign(names, { nearClip: near, farClip: far, znear: near, zfar: far });
    const logarithm = (z) => webgpu ? Math.log2(z / near) / Math.log2(far / near) : Math.log2(1 + z) * names.logDepthBufFC * 0.5;
    return { matrix: camera.projectionMatrix.elements, inverse: camera.projectionMatrixInverse.elements, lo: webgpu || reversed ? 0 : -1, toward: -1, names, logarithm: log && logarithm,
        mapping: log ? webgpu ? "three-webgpu" : "three-webgl" : reversed ? "reversed" : webgpu ? "d3d" : "gl" };
}

function ofCesium({ ortho, log }) {
    const frustum = ortho ? new Cesium.OrthographicFrustum({ width: 2, aspectRatio: 1, near, far }) : new Cesium.PerspectiveFrustum({ fov: 1, aspectRatio: 1, near, far });
    const state = new Cesium.UniformState(), matrix = Cesium.Matrix4.toArray(frustum.projectionMatrix);
    state.updateFrustum(frustum);
    const names = { czm_currentFrustum: state.currentFrustum, czm_log2FarDepthFromNearPlusOne: state.log2FarDepthFromNearPlusOne };
    const logarithm = (z) => Math.log2(1 + z - near) * state.oneOverLog2FarDepthFromNearPlusOne; // czm_vertexLogDepth, czm_writeLogDepth
    return { matrix, inverse: Cesium.Matrix4.toArray(state.inverseProjection), lo: -1, toward: -1, names, logarithm: log && logarithm, mapping: log ? "cesium" : "gl" };
}

function ofBabylon({ ortho, reversed, webgpu, rightHanded }) {
    const engine = new NullEngine(), scene = new Scene(engine), camera = new FreeCamera("camera", Vector3.Zero(), scene);
    engine.isNDCHalfZRange = Boolean(webgpu);
    engine.useReverseDepthBuffer = Boolean(reversed);
    scene.useRightHandedSystem = Boolean(rightHanded);
    Object.assign(camera, { minZ: near, maxZ: far, mode: ortho ? FreeCamera.ORTHOGRAPHIC_CAMERA : FreeCamera.PERSPECTIVE_CAMERA, orthoLeft: -1, orthoRight: 1, orthoTop: 1, orthoBottom: -1 });
    const matrix = camera.getProjectionMatrix(true), mapping = webgpu ? reversed ? "reversed" : "d3d" : reversed ? "gl-reversed" : "gl";
    return { matrix: matrix.m, inverse: matrix.clone().invert().m, lo: webgpu ? 0 : -1, toward: rightHanded ? -1 : 1, names: { near: camera.minZ, far: camera.maxZ }, mapping };
}

function ofPlaycanvas({ ortho }) {
    const camera = new playcanvas.Camera();
    Object.assign(camera, { nearClip: near, farClip: far, aspectRatioMode: playcanvas.ASPECT_MANUAL, projection: ortho ? playcanvas.PROJECTION_ORTHOGRAPHIC : playcanvas.PROJECTION_PERSPECTIVE });
    const matrix = camera.projectionMatrix, [x, y, z, w] = camera.fillShaderParams([]), params = { x, y, z, w };
    return { matrix: matrix.data, inverse: matrix.clone().invert().data, lo: -1, toward: -1, names: { camera_params: params, cameraParams: params }, mapping: "gl" };
}

const makers = { three: ofThree, "@cesium/engine": ofCesium, "@babylonjs/core": ofBabylon, playcanvas: ofPlaycanvas };

function cameraOf(engine, words) {
    const kind = Object.fromEntries(words.split(" ").map((word) => [word, true])), c = makers[engine](kind);
    const of = (m, v) => [0, 1, 2, 3].map((row) => v.reduce((sum, x, column) => sum + m[4 * column + row] * x, 0));
    const ndc = (z) => { const clip = of(c.matrix, [0, 0, c.toward * z, 1]); return clip[2] / clip[3]; };
    const drawn = (z) => (ndc(z) - c.lo) / (1 - c.lo), window = c.logarithm || drawn;
    const unproject = (d) => of(c.inverse, [0, 0, d, 1]);
    return { ...c, ortho: kind.ortho, quantity: {
        "eye depth": (z) => z, "minus eye depth": (z) => -z, "window depth": window, "NDC depth": (z) => c.lo < 0 ? 2 * window(z) - 1 : NaN,
        "the way from near to far": (z) => (z - near) / (far - near), "1 minus window depth": (z) => 1 - window(z), "window depth without the logarithm": drawn,
    }, names: { ...c.names, ndc, lo: c.lo, unproject, near, far } };
}

// ---- The text that a package ships ---------------------------------------------------------------------------------------

const strings = (value) => typeof value === "string" ? [value] : value && typeof value === "object" ? Object.values(value).flatMap(strings) : [];

async function textOf(engine, file, name) {
    const path = new URL(`node_modules/${engine}/${file}`, import.meta.url);
    if (file.endsWith(".glsl")) return readFileSync(path, "utf8");
    const all = Object.values(await import(path)).flatMap((value) => strings(typeof value === "function" ? value.ReflectorShader ?? {} : value));
    const text = all.find((text) => new RegExp(`\\b\\w+ ${name}\\s*\\(`).test(text));
    if (text === undefined) throw new Error(`${file} has no ${name}`);
    return text.replace(/^[ \t]*#include <(\w+)>/gm, (line, chunk) => THREE.ShaderChunk[chunk] ?? line);
}

// Cesium puts what it defines, its own functions and uniforms in front.
const combined = (text, defines) => new Cesium.ShaderSource({ defines: defines.map((word) => word.replace("=", " ")), sources: [text] }).createCombinedFragmentShader({ webgl2: true });

// ---- What it computes, in doubles ------------------------------------------------------------------------------------------

const library = { ...Object.fromEntries(["abs", "min", "max", "log2", "log", "exp", "pow", "floor"].map((name) => [name, Math[name]])), exp2: (x) => 2 ** x, clamp: (x, lo, hi) => Math.min(Math.max(x, lo), hi) };

// A function of GLSL over numbers alone is one of JavaScript, once the types are gone.
function translated(text, name) {
    const head = new RegExp(`\\bfloat ${name}\\s*\\(([^()]*)\\)\\s*\\{`).exec(text);
    if (head === null) throw new Error(`no function of numbers: ${name}`);
    let end = head.index + head[0].length;
    for (let open = 1; open > 0; end++) open += (text[end] === "{") - (text[end] === "}");
    const body = text.slice(head.index + head[0].length, end - 1).replace(/\bfloat (?=\w+\s*=)/g, "let ").replace(/(\d)f\b/g, "$1");
    const parameters = head[1].split(",").map((parameter) => parameter.trim().split(" ").at(-1));
    const needs = [...new Set(body.match(/\b[A-Za-z_]\w*(?=\s*\()/g))].filter((word) => word !== name && new RegExp(`\\bfloat ${word}\\s*\\(`).test(text));
    return { parameters, source: `${needs.map((word) => translated(text, word).source).join("\n")}\nfunction ${name}(${parameters}) {${body}}` };
}

function evaluated(text, name, by, names) {
    const scope = { ...library, ...names };
    if (by !== "text") return new Function(...Object.keys(scope), `return (d) => ${by};`)(...Object.values(scope));
    const plain = execFileSync("cc", ["-E", "-P", "-undef", "-x", "c", "-"], { stdio: ["pipe", "pipe", "ignore"], input: text.replace(/^[ \t]*#[ \t]*(include|version|extension|pragma|line).*$/gm, "") }).toString();
    const { parameters, source } = translated(plain, name), free = Object.keys(scope).filter((word) => !parameters.includes(word));
    const f = new Function(...free, `${source}\nreturn ${name};`)(...free.map((word) => scope[word]));
    return (d) => f(...parameters.map((word, k) => k === 0 ? d : names[word]));
}

// A function of three's node language, which makes shaders: its operations are done here, in binary32 for pairs, else in doubles.
async function ofNodes(engine, file, name, path, camera, from) {
    const functions = await import(new URL(`node_modules/${engine}/${file}`, import.meta.url));
    const by = (round) => {
        const node = (v) => ({ v, add: (o) => node(round(v + o.v)), sub: (o) => node(round(v - o.v)), mul: (o) => node(round(v * o.v)), div: (o) => node(round(v / o.v)) });
        return (d) => functions[name](node(d), node(near), node(far)).v;
    };
    const pairs = Array.from({ length: 64 }, (_, k) => Math.fround(camera.quantity[from](near * (far / near) ** (k / 63))));
    writeFileSync(path, pairs.map((d) => `${d},${by(Math.fround)(d)}\n`).join(""));
    return by((x) => x);
}

function distance(f, camera, from, computes) {
    let worst = 0;
    for (let k = 0; k <= 200; k++) {
        const z = camera.ortho ? near + (far - near) * k / 200 : near * (far / near) ** (k / 200), want = camera.quantity[computes](z);
        worst = Math.max(worst, Math.abs(f(camera.quantity[from](z)) - want) / (/window|NDC|way|matrix/.test(computes) ? 1 : Math.abs(want)) || 0);
    }
    return worst;
}

// ---- Rows --------------------------------------------------------------------------------------------------------------------

const said = [];
let row = 0, engine;
for (const line of readFileSync(cases, "utf8").split("\n")) {
    if (line.trim() === "" || line.startsWith("#")) continue;
    const [file, call, words, defined, verdict, computes, from, by, judged] = line.split("|").map((word) => word.trim());
    if (call === undefined) { engine = file.replace(/@[^@]*$/, ""); continue; } // "three@0.187.0"
    const name = call.split(" ")[0], caller = call.slice(name.length).trim(), what = `${engine} ${file} ${call} ${words}`;
    const camera = cameraOf(engine, words), defines = defined.split(" ").filter((word) => word !== "" && !word.startsWith("-"));
    let text = by === "nodes" ? "" : await textOf(engine, file, name);
    if (engine === "@cesium/engine") text = combined(file.includes("Builtin") ? `void main() { ${name}; ${caller}; czm_${file.match(/\w+(?=\.)/)[0]}; }` : text, defines);
    else text = `${defines.map((word) => `#define ${word.replace("=", " ")}\n`).join("")}${text}`;
    const asked = caller === "" ? name : "asked", path = `${out}/${row++}.${by === "nodes" ? "csv" : "glsl"}`;
    const samplers = defined.includes("(depth_read)") ? text.match(/\bsampler2D \w+(?=[;,)])/g) ?? [] : []; // are read by macros
    const prelude = `${samplers.length > 0 ? "#define sampler2D int\n" : ""}${[...new Set(samplers)].map((sampler) => `int ${sampler.slice(10)};\n`).join("")}`;
    if (by !== "nodes") writeFileSync(path, caller === "" ? text : `float depth_read;\n${prelude}${text}\nfloat asked(float d) { depth_read = d; return ${caller}; }\n`);
    const f = by === "nodes" ? await ofNodes(engine, file, name, path, camera, from) : evaluated(text, name, by, camera.names), off = distance(f, camera, from, computes);
    if (verdict === "right" ? !(off < 2e-3) : verdict !== "unknown" && !(off > 2e-2)) throw new Error(`${what}: off by ${off}, which is not ${verdict}`);
    said.push([judged || verdict, computes, from, verdict, what, `${by === "nodes" ? `--pairs ${path}` : `${path}:${asked}`} -n ${near} -f ${far} -F d16 -m ${camera.mapping}${camera.ortho ? " --ortho" : ""} ${defined.split(" ").filter((word) => word.startsWith("-")).join(" ")}`].join("\t"));
}
writeFileSync(`${out}/list`, `${said.join("\n")}\n`);
process.exit(0);
