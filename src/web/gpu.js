// SPDX-License-Identifier: GPL-3.0-or-later
// The browser's GPU: draws what gpu.c asks for and reads back what was stored. In a worker, so that a driver that takes
// long, or is lost, takes nothing of the page with it.
const SIZE = 256, CLEAR = 0.75, WIDTH = 1024, TEXT = 512;
const HEAD = "#version 300 es\nprecision highp float;precision highp int;";
const WHOLE = `${HEAD}void main(){gl_Position=vec4(ivec2(gl_VertexID&1,gl_VertexID>>1)*4-1,0,1);}`;

let gl = null, clip, judged;

const fail = (text) => {
    throw new Error(text);
};

function open() {
    if (gl === null || gl.isContextLost()) {
        gl = typeof OffscreenCanvas === "undefined" ? null : new OffscreenCanvas(1, 1).getContext("webgl2");
        if (gl === null) fail("this browser gives a worker no WebGL 2");
        clip = gl.getExtension("EXT_clip_control");
        gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
    }
}

function programOf(vertex, fragment) {
    const made = gl.createProgram();
    for (const [type, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
        const shader = gl.createShader(type);
        gl.shaderSource(shader, text);
        gl.compileShader(shader);
        if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) fail(gl.getShaderInfoLog(shader) ?? "");
        gl.attachShader(made, shader);
    }
    gl.linkProgram(made);
    if (!gl.getProgramParameter(made, gl.LINK_STATUS)) fail(gl.getProgramInfoLog(made) ?? "");
    gl.useProgram(made);
    return made;
}

function texture(format, width, height) {
    const made = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, made);
    gl.texStorage2D(gl.TEXTURE_2D, 1, format, width, height);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
    return made;
}

// A frame of whole numbers, and a depth buffer or none; both go when `draw` has drawn and its numbers are read.
function framed(width, height, depth, draw) {
    const frame = gl.createFramebuffer(), seen = texture(gl.R32UI, width, height), four = new Uint32Array(4 * width * height);
    gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, seen, 0);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.TEXTURE_2D, depth, 0);
    gl.viewport(0, 0, width, height);
    gl.clearBufferuiv(gl.COLOR, 0, four);
    draw();
    gl.readPixels(0, 0, width, height, gl.RGBA_INTEGER, gl.UNSIGNED_INT, four);
    gl.deleteFramebuffer(frame);
    gl.deleteTexture(seen);
    return four.filter((_, i) => i % 4 === 0);
}

// What a function makes of the numbers of a texture.
function values(program, from, width, height) {
    gl.disable(gl.DEPTH_TEST);
    gl.useProgram(program);
    gl.bindTexture(gl.TEXTURE_2D, null);
    return framed(width, height, null, () => {
        gl.bindTexture(gl.TEXTURE_2D, from);
        gl.drawArrays(gl.TRIANGLES, 0, 3);
    });
}

const function_ = (text, name) => programOf(WHOLE, `${HEAD}uniform highp sampler2D depths_;out highp uint value_;
${text}
#line 9999
void main(){value_=floatBitsToUint(${name}(texelFetch(depths_,ivec2(gl_FragCoord.xy),0).r));}`);

const ASKS = [
    function describe() {
        const named = gl.getExtension("WEBGL_debug_renderer_info");
        return `${gl.getParameter(named?.UNMASKED_RENDERER_WEBGL ?? gl.RENDERER)}\n${gl.getParameter(gl.VERSION)}`;
    },

    function draw({ source, a, b, format, program, other, triangles, constant, slope, count, vertices, second, codes, answer }) {
        if (clip === null) fail("the browser has no EXT_clip_control, without which clip z from 0 to w is not what is drawn");
        clip.clipControlEXT(clip.LOWER_LEFT_EXT, clip.ZERO_TO_ONE_EXT);
        const depth = texture([gl.DEPTH_COMPONENT16, gl.DEPTH_COMPONENT24, gl.DEPTH_COMPONENT32F][format], SIZE, SIZE);
        const drawn = (which, data) => {
            const made = programOf(`#version 300 es\n#define program ${which}\nin vec4 given;uniform float a,b;${source}`,
                `${HEAD}out highp uint value_;void main(){value_=1u;}`);
            gl.uniform1f(gl.getUniformLocation(made, "a"), a);
            gl.uniform1f(gl.getUniformLocation(made, "b"), b);
            gl.bufferData(gl.ARRAY_BUFFER, data, gl.STREAM_DRAW);
            gl.vertexAttribPointer(0, 4, gl.FLOAT, false, 0, 0);
            gl.enableVertexAttribArray(0);
            gl.drawArrays(triangles ? gl.TRIANGLES : gl.POINTS, 0, count);
            gl.disableVertexAttribArray(0);
            gl.deleteProgram(made);
        };
        const passed = framed(SIZE, SIZE, depth, () => {
            gl.depthMask(true);
            gl.clearBufferfv(gl.DEPTH, 0, [CLEAR]);
            gl.enable(gl.DEPTH_TEST);
            gl.depthFunc(gl.ALWAYS);
            gl.colorMask(false, false, false, false);
            gl.enable(gl.POLYGON_OFFSET_FILL);
            gl.polygonOffset(slope, constant);
            drawn(program, vertices);
            gl.colorMask(true, true, true, true);
            gl.depthMask(false);
            gl.depthFunc(gl.EQUAL);
            if (second !== null) drawn(other, second);
        });
        codes.set(values(function_("float same(float d){return d;}", "same"), depth, SIZE, SIZE));
        gl.deleteTexture(depth);
        answer(passed.reduce((sum, one) => sum + one));
        return "";
    },

    // What is given of the camera, where its uniforms ask for it.
    function compile({ source, a: near, b: far }) {
        const name = [...source.matchAll(/float\s+(\w+)\s*\(\s*(in\s+)?((high|medium|low)p\s+)?float\b/g)].at(-1)?.[1];
        if (name === undefined) fail("it needs a function of a depth: float f(float depth) { ... }");
        const own = /\buniform\b/.test(source) ? "" : "uniform float near,far;";
        try {
            judged = function_(`${own}\n#line 1\n${source}`, name);
        } catch (error) {
            if (gl.isContextLost()) throw error;
            const [, line, text] = /ERROR: \d+:(\d+): ([^\n\0]*)/.exec(error.message) ?? [null, 0, error.message];
            fail(line < 9999 && line > 0 ? `line ${line}: ${text}` : text);
        }
        const given = [];
        for (let i = 0; i < gl.getProgramParameter(judged, gl.ACTIVE_UNIFORMS); i++) {
            const { name: called, type } = gl.getActiveUniform(judged, i), what = /near|far/i.exec(called)?.[0].toLowerCase();
            if (called === "depths_") continue;
            if (type !== gl.FLOAT || what === undefined) fail(`uniform ${called}: near and far alone are given, as float`);
            gl.uniform1f(gl.getUniformLocation(judged, called), what === "near" ? near : far);
            given.push(`${called} = ${what}`);
        }
        return given.join(", ");
    },

    function values_({ count, vertices, codes }) {
        const height = Math.ceil(count / WIDTH), all = new Float32Array(WIDTH * height), from = texture(gl.R32F, WIDTH, height);
        all.set(vertices.subarray(0, count));
        gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, WIDTH, height, gl.RED, gl.FLOAT, all);
        codes.set(values(judged, from, WIDTH, height).subarray(0, count));
        gl.deleteTexture(from);
        return "";
    },
];

// A request of gpu.c, in its order, at `at` of the module's memory.
export function gpu(buffer, at) {
    const words = new Uint32Array(buffer, at, 17), reals = new Float32Array(buffer, at, 17), bytes = new Uint8Array(buffer);
    const [what, text, source, , , format, program, other, triangles, , , count, vertices, second, codes] = words;
    const told = (from) => new TextDecoder().decode(bytes.subarray(from, bytes.indexOf(0, from)));
    const floats = (from, size) => (from === 0 ? null : new Float32Array(buffer, from, size));
    const say = (said) => {
        const { written } = new TextEncoder().encodeInto(said, bytes.subarray(text, text + TEXT - 1));
        bytes[text + written] = 0;
    };
    try {
        open();
        const said = ASKS[what]({
            source: told(source), a: reals[3], b: reals[4], format, program, other, triangles, constant: reals[9],
            slope: reals[10], count, vertices: floats(vertices, what === 1 ? 4 * count : count), second: floats(second, 4 * count),
            codes: new Uint32Array(buffer, codes, what === 1 ? SIZE * SIZE : count), answer: (passed) => (words[15] = passed),
        });
        if (what === 0) words[11] = gl.getParameter(gl.SUBPIXEL_BITS);
        if (gl.isContextLost()) fail("the browser took the GPU away; another try gets it back");
        const wrong = gl.getError();
        if (wrong !== gl.NO_ERROR) fail(`the GPU refuses a draw, error ${wrong}`);
        say(said);
        return 0;
    } catch (error) {
        say(gl?.isContextLost() ? "the browser took the GPU away (context lost): another try gets it back" : error.message);
        return 1;
    }
}
