// SPDX-License-Identifier: GPL-3.0-or-later
// The browser's GPU: draws what gpu.c asks for and reads back what was stored. It works in the page's worker, so that a
// driver that takes long, or is lost, takes nothing of the page with it.
const SQUARE = [256, 256], STREET = [640, 360], CLEAR = 0.75, WIDTH = 1024, TEXT = 512, BEHIND = 9999;
const HEAD = "#version 300 es\nprecision highp float;precision highp int;";
const WHOLE = `${HEAD}void main(){gl_Position=vec4(ivec2(gl_VertexID&1,gl_VertexID>>1)*4-1,0,1);}`;
const WHO = `${HEAD}uniform uint who;out highp uint value_;void main(){value_=who;}`;
const LOST = "the browser took the GPU away (its context is lost): the next try asks for it again";

let gl = null, clip, judged;

/** @type {(text: string) => any} */
const giveUp = (text) => {
    throw new Error(text);
};

function openContext() {
    if (gl !== null && !gl.isContextLost()) return;
    gl = typeof OffscreenCanvas === "undefined" ? null : new OffscreenCanvas(1, 1).getContext("webgl2");
    if (gl === null) giveUp("this browser has no WebGL 2 for a worker");
    clip = gl.getExtension("EXT_clip_control");
    gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
    gl.vertexAttribPointer(0, 4, gl.FLOAT, false, 0, 0);
    gl.enable(gl.POLYGON_OFFSET_FILL);
}

function programOf(vertex, fragment) {
    const made = gl.createProgram();
    for (const [type, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
        const shader = gl.createShader(type);
        gl.shaderSource(shader, text);
        gl.compileShader(shader);
        if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) giveUp(gl.getShaderInfoLog(shader) ?? LOST);
        gl.attachShader(made, shader);
        gl.deleteShader(shader);
    }
    gl.bindAttribLocation(made, 0, "given");
    gl.linkProgram(made);
    if (!gl.getProgramParameter(made, gl.LINK_STATUS)) giveUp(gl.getProgramInfoLog(made) ?? LOST);
    gl.useProgram(made);
    return made;
}

// The value of a float function named so at each number of a texture.
const functionOf = (text, name) => programOf(WHOLE, `${HEAD}uniform highp sampler2D depths_;out highp uint value_;
${text}
#line ${BEHIND}
void main(){value_=floatBitsToUint(${name}(texelFetch(depths_,ivec2(gl_FragCoord.xy),0).r));}`);

function texture(format, size) {
    const [width, height] = size;
    const made = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, made);
    gl.texStorage2D(gl.TEXTURE_2D, 1, format, width, height);
    for (const which of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, which, gl.NEAREST);
    return made;
}

// The whole numbers that are drawn, where nothing is 0.
function drawn(size, depth, draw, part = size) {
    const frame = gl.createFramebuffer(), seen = texture(gl.R32UI, size), four = new Uint32Array(4 * part[0] * part[1]);
    gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, seen, 0);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.TEXTURE_2D, depth, 0);
    gl.viewport(0, 0, ...size);
    gl.clearBufferuiv(gl.COLOR, 0, four.subarray(0, 4));
    draw();
    gl.readPixels(...size.map((all, i) => (all - part[i]) >> 1), ...part, gl.RGBA_INTEGER, gl.UNSIGNED_INT, four);
    gl.deleteFramebuffer(frame);
    gl.deleteTexture(seen);
    return four.filter((_, i) => i % 4 === 0);
}

function valuesOf(program, from, size) {
    gl.disable(gl.DEPTH_TEST);
    gl.useProgram(program);
    return drawn(size, null, () => {
        gl.bindTexture(gl.TEXTURE_2D, from);
        gl.drawArrays(gl.TRIANGLES, 0, 3);
    });
}

// Draws by `draw` into a depth buffer, and calls `then` with it. Clip z is from 0 to w, else as C is told.
function withDepth(format, size, clear, draw, then, part = size) {
    clip?.clipControlEXT(clip.LOWER_LEFT_EXT, clip.ZERO_TO_ONE_EXT);
    const depth = texture([gl.DEPTH_COMPONENT16, gl.DEPTH_COMPONENT24, gl.DEPTH_COMPONENT32F][format], size);
    const seen = drawn(size, depth, () => {
        gl.enable(gl.DEPTH_TEST);
        gl.depthMask(true);
        gl.clearBufferfv(gl.DEPTH, 0, [clear]);
        gl.enableVertexAttribArray(0);
        draw();
        gl.disableVertexAttribArray(0);
    }, part);
    then(seen, depth);
    gl.deleteTexture(depth);
}

const uniform = (program, name, as, value) => gl[`uniform1${as}`](gl.getUniformLocation(program, name), value);

/** @type {((asked: any) => any)[]} */
const GPU_ASKS = [
    () => {
        const named = gl.getExtension("WEBGL_debug_renderer_info");
        return `${gl.getParameter(named?.UNMASKED_RENDERER_WEBGL ?? gl.RENDERER)}\n${gl.getParameter(gl.VERSION)}`;
    },

    // A shot of the probe: what is stored, and how many pixels of `second` are equal to it.
    ({ source, a, b, format, program, other, triangles, constant, slope, count, vertices, second, out, pass }) => {
        const put = (which, at) => {
            const made = programOf(`#version 300 es\n#define program ${which}\n in vec4 given;uniform float a,b;${source}`, WHO);
            uniform(made, "a", "f", a);
            uniform(made, "b", "f", b);
            uniform(made, "who", "ui", 1);
            gl.bufferData(gl.ARRAY_BUFFER, at(4 * count), gl.STREAM_DRAW);
            gl.drawArrays(triangles ? gl.TRIANGLES : gl.POINTS, 0, count);
            gl.deleteProgram(made);
        };
        withDepth(format, SQUARE, CLEAR, () => {
            gl.depthFunc(gl.ALWAYS);
            gl.polygonOffset(slope, constant);
            gl.colorMask(false, false, false, false);
            put(program, vertices);
            gl.colorMask(true, true, true, true);
            gl.depthMask(false);
            gl.depthFunc(gl.EQUAL);
            if (second !== null) put(other, second);
        }, (passed, depth) => {
            pass(passed.reduce((sum, one) => sum + one));
            const same = functionOf("float same(float d){return d;}", "same");
            out(SQUARE[0] * SQUARE[1]).set(valuesOf(same, depth, SQUARE));
            gl.deleteProgram(same);
        });
    },

    // A function of somebody's, and what it is given of the camera.
    ({ source, a: near, b: far }) => {
        const name = [...source.matchAll(/float\s+(\w+)\s*\(\s*(in\s+)?((high|medium|low)p\s+)?float\b/g)].at(-1)?.[1];
        if (name === undefined) giveUp("it has no function of a depth: float f(float depth) { ... }");
        try {
            judged = functionOf(`${/\buniform\b/.test(source) ? "" : "uniform float near,far;"}\n#line 1\n${source}`, name);
        } catch (error) {
            const [, line, text] = /ERROR: \d+:(\d+): ([^\n\0]*)/.exec(error.message) ?? [null, BEHIND, error.message];
            giveUp(Number(line) < BEHIND ? `line ${line}: ${text}` : text);
        }
        const given = [];
        for (let i = gl.getProgramParameter(judged, gl.ACTIVE_UNIFORMS); i-- > 0;) {
            const { name: called, type } = gl.getActiveUniform(judged, i), plane = /near|far/i.exec(called)?.[0].toLowerCase();
            if (called === "depths_") continue;
            if (type !== gl.FLOAT || plane === undefined) giveUp(`uniform ${called}: only near and far are given, as float`);
            uniform(judged, called, "f", plane === "near" ? near : far);
            given.unshift(`${called} = ${plane}`);
        }
        return given.join(", ");
    },

    ({ count, reals, out }) => {
        const size = [WIDTH, Math.ceil(count / WIDTH)], all = new Float32Array(WIDTH * size[1]), from = texture(gl.R32F, size);
        all.set(reals(count));
        gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, ...size, gl.RED, gl.FLOAT, all);
        out(count).set(valuesOf(judged, from, size).subarray(0, count));
        gl.deleteTexture(from);
    },

    // Who is seen of triangles that are somebody's each, in the middle of a view: the nearest, of equal depths the first.
    ({ a: width, b: height, format, other: reversed, count, vertices, second, out }) =>
        withDepth(format, [width, height], reversed ? 0 : 1, () => {
            const made = programOf(`${HEAD}in vec4 given;void main(){gl_Position=given;}`, WHO);
            gl.depthFunc(reversed ? gl.GREATER : gl.LESS);
            gl.polygonOffset(0, 0);
            gl.bufferData(gl.ARRAY_BUFFER, vertices(12 * count), gl.STREAM_DRAW);
            second(count).forEach((who, i) => {
                uniform(made, "who", "ui", who);
                gl.drawArrays(gl.TRIANGLES, 3 * i, 3);
            });
            gl.deleteProgram(made);
        }, (seen) => out(STREET[0] * STREET[1]).set(seen), STREET),
];

// Does a request of gpu.h that stands at `at` in the module's memory: 0 where it is done, else its text says why not.
export function gpu(buffer, at) {
    const words = new Uint32Array(buffer, at, 16), [, , , a, b] = new Float32Array(buffer, at, 16), bytes = new Uint8Array(buffer);
    const [what, text, source, , , format, program, other, triangles, , , count, vertices, second, out] = words;
    const [constant, slope] = new Float32Array(buffer, at + 36, 2);
    const numbers = (from) => (from === 0 ? null : (size) => new Uint32Array(buffer, from, size));
    const say = (said) => {
        const { written } = new TextEncoder().encodeInto(said, bytes.subarray(text, text + TEXT - 1));
        bytes[text + written] = 0;
    };
    try {
        openContext();
        const said = GPU_ASKS[what]({
            source: new TextDecoder().decode(bytes.subarray(source, bytes.indexOf(0, source))), a, b, format, program, other,
            triangles, constant, slope, count, vertices: numbers(vertices), second: numbers(second), out: numbers(out),
            reals: (size) => new Float32Array(buffer, vertices, size), pass: (passed) => (words[15] = passed),
        });
        const wrong = gl.getError();
        if (wrong !== gl.NO_ERROR) giveUp(`the GPU refuses it, error ${wrong}`);
        if (what === 0) [words[11], words[15]] = [gl.getParameter(gl.SUBPIXEL_BITS), Number(clip === null)];
        say(said ?? "");
        return 0;
    } catch (error) {
        say(gl?.isContextLost() ? LOST : error.message);
        return 1;
    }
}
