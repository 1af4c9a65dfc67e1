// SPDX-License-Identifier: GPL-3.0-or-later
// The vertex shader of the probe: one source, a program by its constant. spirv.sh makes spirv.h of it.
#version 450
layout(constant_id = 0) const int program = 0;
layout(location = 0) in vec4 given;
layout(push_constant) uniform numbers {
    float a, b;
};

void main() {
    vec4 at = given;
    if (program == 1)
        at.z = a * given.z + b;
    if (program == 2) {
        // As 1 for what is drawn; the rest is there to be compiled with it.
        float length = sqrt(dot(given, given));
        at.z = a * given.z + b;
        at.x = length < 0.0 ? at.z * length : at.x;
    }
    if (program == 3) {
        at.z = log2(given.z) * a;
        at.w = 1.0;
    }
    if (program == 4) {
        at.z = given.z / given.w;
        at.w = 1.0;
    }
    gl_Position = at;
    gl_PointSize = 1.0;
}
