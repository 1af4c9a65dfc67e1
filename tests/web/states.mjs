// SPDX-License-Identifier: GPL-3.0-or-later
// Random states of the page: command lines of the commands that it has, most of them good, some refused.
import { execFileSync } from "node:child_process";

// Whole numbers below 2^32, always the same for a seed (splitmix32).
export function random(seed) {
    let state = seed >>> 0;
    const next = () => {
        state = (state + 0x9e3779b9) >>> 0;
        let x = state;
        x = Math.imul(x ^ (x >>> 16), 0x21f0aaad);
        x = Math.imul(x ^ (x >>> 15), 0x735a2d97);
        return (x ^ (x >>> 15)) >>> 0;
    };
    const unit = () => next() / 0x100000000;
    return {
        below: (n) => Math.floor(unit() * n),
        chance: (p) => unit() < p,
        of: (list) => list[Math.floor(unit() * list.length)],
        between: (lo, hi) => lo + (hi - lo) * unit(),
        spread: (lo, hi) => lo * (hi / lo) ** unit(),
    };
}

// As tests/support.h has it: a fixed one, DEPTHPREC_SEED, or "time".
export function seed() {
    const { DEPTHPREC_SEED: given } = process.env;
    return given === "time" ? Date.now() % 1000000 : Number(given || 20150707);
}

// A number as people write it: few digits, many, with an exponent, with a unit.
function written(r, x, unit) {
    const text = r.of([() => x.toPrecision(1 + r.below(4)), () => String(x), () => x.toExponential(2)])();
    return text + (unit && r.chance(0.15) ? r.of(["m", "cm", "mm", "km", "ft"]) : "");
}

const FORMATS = ["fp16", "fp32", "unorm16", "unorm24", "d24", "d16", "d32f", "depth24plus", "unorm8", "unorm31",
    "float5.10", "float6.9b40", "all", "unorm24,fp32"];
const MAPPINGS = ["d3d", "reversed", "gl", "linear", "log", "gl,linear", "d3d,reversed", "gl-reversed"];
const QUICK = ["distribution", "share", "error", "interval", "budget"], FIGURES = [...QUICK, ...QUICK, ...QUICK, "map"]; // which takes long
const APIS = ["gl", "vulkan", "d3d11", "d3d12", "webgpu", "metal", "all"];
const RASTERS = ["llvmpipe", "swiftshader", "warp", "spec-d3d", "spec-vulkan"];

// What the program's lists say now is better than what is written here; see named().
export const names = { formats: FORMATS, mappings: MAPPINGS, apis: APIS, rasters: RASTERS, presets: [], ariths: [],
    models: ["exact", "float", "staged"], roundings: [], compositions: [], platforms: [], languages: ["glsl", "c"] };

// Takes the names that the program's `list TOPIC --json` prints.
export function named() {
    // Of presets those that need no number.
    const run = (words) => execFileSync(process.env.DEPTHPREC ?? "build/depthprec", words, { encoding: "utf8" });
    const list = (topic) => JSON.parse(run(["list", topic, "--json"])).items.filter((item) => !/, needed/.test(item.camera ?? ""))
        .map((item) => item.name);
    names.presets = list("presets");
    names.ariths = list("arithmetic");
    names.apis = [...list("apis"), "all"];
    names.rasters = list("rasterizers");
    names.platforms = list("platforms");
    names.languages = list("languages");
}

function camera(r) {
    const near = r.spread(1e-3, 10), far = near * r.spread(2, 1e6), words = [];
    if (r.chance(0.9)) words.push("-n", written(r, near));
    if (r.chance(0.9)) words.push("-f", r.chance(0.1) ? "inf" : written(r, far));
    if (r.chance(0.9)) words.push("-F", r.of(names.formats));
    if (r.chance(0.9)) words.push("-m", r.of(names.mappings));
    return { near, far, words };
}

const depth = (r, c) => r.spread(c.near, c.far);
function depths(r, c) {
    const one = () => written(r, depth(r, c), true), lo = r.spread(c.near, Math.sqrt(c.near * c.far));
    return r.of([one, () => [one(), one(), one()].join(","),
        () => `${lo}:${r.spread(lo, c.far)}:${r.of(["log", "lin"])}:${2 + r.below(20)}`])();
}
const range = (r, c) => {
    const a = depth(r, c), b = depth(r, c);
    return `${written(r, Math.min(a, b))}:${written(r, Math.max(a, b))}`;
};
const view = (r) => [["--viewport", r.of(["1920x1080", "640x360", "7x5"])],
    ...(r.chance(0.3) ? [["--fov", written(r, r.between(10, 120))]] : []),
    ...(r.chance(0.3) ? [["--raster", r.of(names.rasters)]] : []),
    ...(r.chance(0.3) ? [["--subpixel", String(1 + r.below(8))]] : []),
    ...(r.chance(0.3) ? [["--slant", `${r.below(40)}:${40 + r.below(50)}`]] : [])].flat();
const model = (r) => ["--model", r.of(["exact", "float", "staged", "auto"]),
    ...(r.chance(0.4) ? ["--arith", r.of(names.ariths)] : [])];
const some = (r, share, words) => (r.chance(share) ? words() : []);
const terms = (r) => [some(r, 0.3, () => ["--from-origin", written(r, r.spread(1, 1e5))]),
    some(r, 0.3, () => ["--interpolation", written(r, r.spread(0.1, 10))]), some(r, 0.2, () => ["--linearize"])].flat();
const form = (r) => r.of([[], ["--json"], ["--json"], ["--csv"], ["--csv"], ["--full"]]);
const planned = (r) => [some(r, 0.05, () => ["--ortho"]), some(r, 0.08, () => ["--preset", r.of(names.presets)]),
    some(r, 0.05, () => ["--unit", r.of(["m", "cm", "ft"])])].flat();

const commands = {
    table: (r, c) => [...c.words, ...planned(r), ...some(r, 0.5, () => model(r)), ...some(r, 0.6, () => ["--at", depths(r, c)]),
        ...some(r, 0.3, () => ["--range", range(r, c)]), ...some(r, 0.3, () => view(r)),
        ...some(r, 0.1, () => ["--depth", String(r.between(0, 1))]), ...some(r, 0.05, () => ["--code", String(r.below(65536))]),
        ...some(r, 0.05, () => ["--platform", r.of(names.platforms)]),
        ...some(r, 0.05, () => ["--tolerance", written(r, r.spread(1e-9, 0.1))]),
        ...some(r, 0.05, () => ["--log-c", written(r, r.spread(0.01, 100))])],
    zfight: (r, c) => {
        const from = depth(r, c);
        return [...c.words, "--range", `${from}:${from * (1 + r.spread(1e-6, 1e-4))}`,
            ...some(r, 0.3, () => ["--arith", r.of(names.ariths)]), ...some(r, 0.5, () => ["--separation", written(r, r.spread(1e-6, 0.1), true)]),
            ...some(r, 0.3, () => ["--sample", String(1 + r.below(300)), "--seed", String(r.below(1000))]), ...some(r, 0.2, () => view(r))];
    },
    prepass: (r, c) => [...c.words, "--against", r.of(["fma", "separate,right", "all"]), ...some(r, 0.3, () => ["--program", r.of(["fma", "pairs"])]),
        "--sample", String(1 + r.below(2000)), ...some(r, 0.3, () => ["--vertices", "box", "--from-origin", written(r, r.spread(1, 1e4))]),
        ...some(r, 0.3, () => ["--range", range(r, c)]), ...some(r, 0.3, () => ["--seed", String(r.below(1000))])],
    budget: (r, c) => [...c.words, ...planned(r), ...some(r, 0.3, () => ["--arith", r.of(names.ariths)]),
        ...some(r, 0.6, () => ["--at", depths(r, c)]), ...terms(r), ...some(r, 0.4, () => view(r))],
    solve: (r, c) => {
        const words = [...c.words, ...some(r, 0.9, () => ["--separation", written(r, r.spread(1e-6, 1), true)]),
            ...(r.chance(0.6) ? ["--at", written(r, depth(r, c))] : some(r, 0.7, () => ["--range", range(r, c)])),
            ...some(r, 0.5, () => model(r)), ...some(r, 0.2, () => view(r))];
        return [...words, ...some(r, 0.7, () => ["--for", r.of(["near", "far", "format", "mapping", "separation", "distance"])]),
            ...some(r, 0.1, () => ["--error", written(r, r.spread(1e-6, 1))])];
    },
    bias: (r, c) => [...c.words, ...planned(r), "--api", r.of(names.apis), ...some(r, 0.6, () => ["--at", depths(r, c)]),
        ...(r.chance(0.4) ? ["--units", written(r, r.between(-20, 20)), ...some(r, 0.3, () => ["--clamp", written(r, r.between(-0.1, 0.1))])]
            : [...some(r, 0.5, () => ["--separation", written(r, r.spread(1e-5, 1), true)]), ...some(r, 0.2, () => view(r))]),
        ...some(r, 0.3, () => ["--factor", written(r, r.between(-4, 4))]),
        ...some(r, 0.3, () => ["--slope", written(r, r.spread(1e-4, 1))])],
    code: (r, c) => {
        const what = r.of(["linearize", "linearize", "linearize", "position", "projection", "encode", "pack", "normal"]), of = r.chance(0.1) ? "" : what;
        const words = c.words.flatMap((word, i) => (i % 2 === 0 && (of === "" || !(of === "encode" ? ["-n", "-f"] : ["-F"]).includes(word)) ? [word, c.words[i + 1]] : []));
        return [...some(r, 0.1, () => [r.of(["complement", "textbook", "unity", "double", "rgba"])]), ...(of === "pack" || of === "normal" ? [] : words.filter((word) => !word.includes(","))),
            "--what", what, ...some(r, 0.8, () => ["--language", r.of(names.languages)]), ...some(r, 0.2, () => ["--uniforms"]), ...planned(r)];
    },
    plot: (r, c) => {
        const figure = r.of(FIGURES);
        return [figure, ...c.words, ...some(r, 0.4, () => model(r)), ...some(r, 0.2, () => ["--at", depths(r, c)]),
            ...some(r, 0.2, () => ["--range", range(r, c)]), ...(figure === "budget" ? terms(r) : []),
            ...some(r, 0.2, () => view(r)), r.of(["--csv", "--csv", "--json"])];
    },
};

// Now and then a word too much, one that is none, or one that is spoilt.
function spoil(r, words) {
    const at = 1 + r.below(words.length);
    const bad = r.of(["--nera", "-x", "nan", "1e999", "-F", "--at", "0x1p3", "--ortho=1", "d25", "", "ä", "-5", "--", "1cm"]);
    return r.chance(0.5) ? [...words.slice(0, at), bad, ...words.slice(at)] : [...words.slice(0, at), bad, ...words.slice(at + 1)];
}

// A random command line, as words.
export function state(r) {
    const verb = r.chance(0.03) ? "zfight" // which takes seconds
        : r.of(["table", "table", "table", "budget", "budget", "solve", "solve", "bias", "bias", "plot", "prepass", "code"]);
    const words = [verb, ...commands[verb](r, camera(r)), ...(verb === "plot" ? [] : form(r))];
    return r.chance(0.06) ? spoil(r, words) : words;
}
