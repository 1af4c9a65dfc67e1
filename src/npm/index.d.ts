// SPDX-License-Identifier: MIT
// Depths are eye depths along the view axis, in scene units; window depths are from 0 to 1; codes are what the buffer
// stores. Arrays are read where they lie, and results are typed arrays; a number in gives a number out; `out` takes the
// result into memory of the caller's. Errors are DepthprecError with the library's sentence, and TypeError for what is no
// number. Every formula and bound is derived in depthprec(7).

export type Reals = Float32Array | Float64Array;
export type Integers = Uint8Array | Uint8ClampedArray | Int8Array | Uint16Array | Int16Array | Uint32Array | Int32Array;
export type Codes = Uint16Array | Uint32Array;
/** Float16Array, where there is one, is taken, too, as Float32Array. */
export type Numbers = Reals | Integers | readonly number[];

export class DepthprecError extends Error {
    /** The library's status, or the command's exit status. */
    readonly status: number;
}

export interface CameraOptions {
    /** In [1e-12, 1e12]; orthographic: either sign, or 0. Default 0.1. */
    near?: number;
    /** At most 1e18, or 1e28 with near and C times it at most 1e30, or Infinity. Default 1000. */
    far?: number;
    /** "unorm24", "d24", "fp32", "unorm16", ...: names as APIs write them, unormN, floatE.M[bB]. Default "fp32". */
    format?: string;
    /** "d3d", "gl", "reversed", "gl-reversed", "linear", "log", "three-webgl", "three-webgpu", "cesium", "osgearth". Default "d3d". */
    mapping?: string;
    ortho?: boolean;
    rounding?: "nearest" | "even" | "zero";
    /** The model of codes and intervals: "exact" is the lattice of real arithmetic. */
    model?: "exact" | "staged" | "float";
    /** The binary32 arithmetic that separation() counts: "ieee", "fused", ... (depthprec list arithmetics). */
    arith?: string;
    /** The constant C of logarithmic mappings. */
    logC?: number;
    /** The window depths where NDC depth begins and ends, as glDepthRange or a viewport sets them: from 0 to 1, at least 1e-6 apart, in
     *  either order; of perspective mappings alone. Default [0, 1]. */
    depthRange?: readonly [number, number];
    /** Width and height in pixels: separation() then holds for slanted triangles, of these: */
    viewport?: readonly [number, number];
    /** Vertical, degrees. Default 60. */
    fov?: number;
    /** Any rasterizer that does what an API asks for; default a plane anchored at a vertex, of 8 bits. */
    raster?: "spec-d3d" | "spec-vulkan" | "spec-gl";
    /** Bits of the grid of vertices. Default 8, with a raster what it has at least. */
    subpixel?: number;
    /** Degrees. Default [0, 90]. */
    slant?: readonly [number, number];
    /** depth, pixels, slim. Default [2, 512, 16]. */
    triangleClass?: readonly [number, number, number];
}

/** Eye depths, and the ends of the cells around them: what else the surface may be at. */
export interface Decoded<T> {
    z: T;
    lo: T;
    hi: T;
}

/** Proven bounds over every depth of a range; see Camera.worst(). */
export interface Worst {
    lo: number;
    hi: number;
    /** The largest error of a stored depth, where, and in which code. */
    error: number;
    errorZ: number;
    errorCode: number;
    /** The widest cell, its ends and its code. */
    interval: number;
    intervalLo: number;
    intervalHi: number;
    intervalCode: number;
    /** Where an unbounded cell begins, else NaN. */
    blindFrom: number;
    /** The largest guaranteed separation, at most 2^-10 above the truth, and where one nearly as large was found. */
    separation: number;
    separationZ: number;
}

/** A camera's planes and how its depth is stored, checked once; it does not change, and nothing has to be freed. */
export class Camera implements Readonly<Required<Omit<CameraOptions, "viewport" | "raster" | "subpixel">>> {
    readonly near: number;
    readonly far: number;
    readonly format: string;
    readonly mapping: string;
    readonly ortho: boolean;
    readonly rounding: "nearest" | "even" | "zero";
    readonly model: "exact" | "staged" | "float";
    readonly arith: string;
    readonly logC: number;
    readonly depthRange: readonly [number, number];
    readonly viewport: readonly [number, number] | undefined;
    readonly fov: number;
    readonly raster: "spec-d3d" | "spec-vulkan" | "spec-gl" | undefined;
    readonly subpixel: number | undefined;
    readonly slant: readonly [number, number];
    readonly triangleClass: readonly [number, number, number];
    /** The code of window depth 1. */
    readonly codeMax: number;
    /** Planes of a matrix: the ends between which each lies, by how its entries were rounded, and the fewest digits of `near` and
     *  `far` that lie there. Of other cameras the planes themselves, and 17. */
    readonly nearLeast: number;
    readonly nearMost: number;
    readonly farLeast: number;
    readonly farMost: number;
    readonly nearDigits: number;
    readonly farDigits: number;

    constructor(options?: CameraOptions);

    /**
     * The camera of a 4x4 projection matrix, clip = M (x, y, z, 1): 16 numbers, 4 rows of 4, or three.js's Matrix4. A perspective tells whether
     * it is reversed; whether NDC depth begins at 0 or at -1 only a reversed one with far >= 2 near tells, so `mapping` has
     * to be said else: "d3d" or "reversed" (0 to 1), "gl" or "gl-reversed" (-1 to 1). `layout`: "rows", "columns", else as
     * the fourth row tells. `near` and `far` are those of the entries as they are: numbers of 32 bits, if all are, else of 64
     * leave them between nearLeast and nearMost, farLeast and farMost. Throws where it is no projection, where its planes differ from pixel to pixel, and where more
     * than one convention fits, naming what each would be.
     */
    static fromMatrix(matrix: Numbers | readonly Numbers[] | { readonly elements: ArrayLike<number> }, options?: Omit<CameraOptions, "near" | "far" | "ortho"> & { layout?: "rows" | "columns" }): Camera;

    /** This camera but for what is named: a camera does not change. */
    replace(changes: CameraOptions): Camera;

    /**
     * The camera that an engine starts with: "unity", "unreal", "godot-forward", "three", ... (depthprec list presets), its
     * lengths in `unit`, "m", "cm", ..., else the engine's own. With a viewport its field of view and grid hold, too.
     */
    static preset(name: string, options?: CameraOptions & { unit?: string }): Promise<Camera>;

    /** The codes that are stored for eye depths, correctly rounded; outside [near, far] clamped, NaN in an array as near.
     *  Uint16Array for formats of at most 16 bits. */
    encode(z: number): number;
    encode<T extends Codes = Codes>(z: Numbers, options?: { out?: T }): T;

    /**
     * The eye depths that codes, or window depths, give back, with `bounds` also the ends of their cells. Float32Array and
     * Float64Array are window depths, other arrays and numbers are codes unless `window` says else. Codes above codeMax count
     * as codeMax, window depths as the nearest code. Codes into a Float32Array as `out` are the fastest, within 1.85e-7.
     */
    decode(value: number, options?: { bounds?: false; window?: boolean }): number;
    decode(value: number, options: { bounds: true; window?: boolean }): Decoded<number>;
    decode<T extends Reals = Reals>(values: Numbers, options?: { bounds?: false; window?: boolean; out?: T }): T;
    decode<T extends Reals = Reals>(values: Numbers, options: { bounds: true; window?: boolean; out?: Decoded<T> }): Decoded<T>;

    /** The window depth of eye depths, before the buffer rounds it. */
    windowDepth(z: number): number;
    windowDepth<T extends Reals = Reals>(z: Numbers, options?: { out?: T }): T;

    /** How far behind z a surface must lie to be resolved: guaranteed, despite the rounding of shader, viewport and buffer.
     * Where z + separation(z) > far nothing behind z is certain: far ends no separation. */
    separation(z: number): number;
    separation<T extends Reals = Reals>(z: Numbers, options?: { out?: T }): T;

    /** The same in exact arithmetic: one step of the format. */
    lattice(z: number): number;
    lattice<T extends Reals = Reals>(z: Numbers, options?: { out?: T }): T;

    /** The z-fighting interval: the width of the cell around z, whose depths all get the same code. */
    interval(z: number): number;
    interval<T extends Reals = Reals>(z: Numbers, options?: { out?: T }): T;

    /** The worst over [lo, hi], by default [near, far]: proven bounds over every depth, no samples. */
    worst(lo?: number, hi?: number): Worst;
}

/** Options of a command as its manual page has them, in camel case: { for: "near", separation: "1cm", at: [1, 2] }; what is
 *  undefined, null or false is left out. Those of a `camera` come first, and others replace them. */
export type CommandOptions = { camera?: Camera } & { [option: string]: unknown };

/** The near or far plane, format, mapping or distance that a separation asks for: the JSON of depthprec-solve(1). */
export function solve(options: CommandOptions): Promise<any>;

/** The effect of a depth bias, in the units of an API: the JSON of depthprec-bias(1). */
export function bias(options: CommandOptions): Promise<any>;

/** Whether cameras meet their requirements, as depthprec(5) has them, a camera being a Camera or an object: the JSON of
 *  depthprec-check(1), also where one is missed. */
export function check(requirements: { [key: string]: unknown }): Promise<any>;

/** Recognises a depth image, rows of samples from the top: its format, whether that is certain, whether depth is reversed,
 *  and why; with { metric } its unit and lattice, and these null. Throws where it is no depth image, with what it looks like,
 *  and TypeError where the image has any other key: options come behind it. */
export function recognise(
    image: { data: ArrayBufferView; width: number; height: number; channels?: number },
    options?: CommandOptions,
): Promise<{ format: string | null; certain: boolean | null; reversed: boolean | null; why: string | null; [key: string]: any }>;

/**
 * Runs a command and gives its answer: objects where --json is among the words, else text, or bytes where it is none.
 * `input` is read as the file "-"; other files need `fs`, that of node. A check that fails is an answer. What the command
 * says beside its answer is a warning of the console.
 */
export function run(args: string | readonly string[], options?: { input?: string | Uint8Array; text?: boolean; fs?: object }): Promise<any>;

export const version: string;
