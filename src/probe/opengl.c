/* SPDX-License-Identifier: GPL-3.0-or-later */
/* OpenGL without a window, by EGL; in a process that ends when it is done, as vulkan.c. */
#include "probe/shot.h"

#if __has_include(<EGL/eglext.h>) && __has_include(<GL/glcorearb.h>)

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/glcorearb.h>
#include <string.h>

#include "probe/spirv.h"
#include "system/dynload.h"

#define FUNCTIONS(X)                                                                                                   \
    X(eglGetPlatformDisplay)                                                                                           \
    X(eglInitialize)                                                                                                   \
    X(eglBindAPI)                                                                                                      \
    X(eglCreateContext)                                                                                                \
    X(eglMakeCurrent)                                                                                                  \
    X(eglGetProcAddress)
DYNLOAD_FUNCTIONS(FUNCTIONS)

#define CALLS(X)                                                                                                       \
    X(PFNGLGETSTRINGPROC, glGetString)                                                                                 \
    X(PFNGLGETINTEGERVPROC, glGetIntegerv)                                                                             \
    X(PFNGLGETERRORPROC, glGetError)                                                                                   \
    X(PFNGLCLIPCONTROLPROC, glClipControl)                                                                             \
    X(PFNGLVIEWPORTPROC, glViewport)                                                                                   \
    X(PFNGLENABLEPROC, glEnable)                                                                                       \
    X(PFNGLDISABLEPROC, glDisable)                                                                                     \
    X(PFNGLDEPTHFUNCPROC, glDepthFunc)                                                                                 \
    X(PFNGLDEPTHMASKPROC, glDepthMask)                                                                                 \
    X(PFNGLDEPTHRANGEPROC, glDepthRange)                                                                               \
    X(PFNGLCLEARDEPTHPROC, glClearDepth)                                                                               \
    X(PFNGLCLEARPROC, glClear)                                                                                         \
    X(PFNGLPOLYGONOFFSETPROC, glPolygonOffset)                                                                         \
    X(PFNGLDRAWARRAYSPROC, glDrawArrays)                                                                               \
    X(PFNGLDRAWBUFFERPROC, glDrawBuffer)                                                                               \
    X(PFNGLREADBUFFERPROC, glReadBuffer)                                                                               \
    X(PFNGLREADPIXELSPROC, glReadPixels)                                                                               \
    X(PFNGLGENRENDERBUFFERSPROC, glGenRenderbuffers)                                                                   \
    X(PFNGLBINDRENDERBUFFERPROC, glBindRenderbuffer)                                                                   \
    X(PFNGLRENDERBUFFERSTORAGEPROC, glRenderbufferStorage)                                                             \
    X(PFNGLGENFRAMEBUFFERSPROC, glGenFramebuffers)                                                                     \
    X(PFNGLBINDFRAMEBUFFERPROC, glBindFramebuffer)                                                                     \
    X(PFNGLFRAMEBUFFERRENDERBUFFERPROC, glFramebufferRenderbuffer)                                                     \
    X(PFNGLCHECKFRAMEBUFFERSTATUSPROC, glCheckFramebufferStatus)                                                       \
    X(PFNGLGENVERTEXARRAYSPROC, glGenVertexArrays)                                                                     \
    X(PFNGLBINDVERTEXARRAYPROC, glBindVertexArray)                                                                     \
    X(PFNGLGENBUFFERSPROC, glGenBuffers)                                                                               \
    X(PFNGLBINDBUFFERPROC, glBindBuffer)                                                                               \
    X(PFNGLBUFFERDATAPROC, glBufferData)                                                                               \
    X(PFNGLVERTEXATTRIBPOINTERPROC, glVertexAttribPointer)                                                             \
    X(PFNGLENABLEVERTEXATTRIBARRAYPROC, glEnableVertexAttribArray)                                                     \
    X(PFNGLCREATESHADERPROC, glCreateShader)                                                                           \
    X(PFNGLSHADERSOURCEPROC, glShaderSource)                                                                           \
    X(PFNGLCOMPILESHADERPROC, glCompileShader)                                                                         \
    X(PFNGLCREATEPROGRAMPROC, glCreateProgram)                                                                         \
    X(PFNGLATTACHSHADERPROC, glAttachShader)                                                                           \
    X(PFNGLBINDATTRIBLOCATIONPROC, glBindAttribLocation)                                                               \
    X(PFNGLLINKPROGRAMPROC, glLinkProgram)                                                                             \
    X(PFNGLGETPROGRAMIVPROC, glGetProgramiv)                                                                           \
    X(PFNGLUSEPROGRAMPROC, glUseProgram)                                                                               \
    X(PFNGLGETUNIFORMLOCATIONPROC, glGetUniformLocation)                                                               \
    X(PFNGLUNIFORM1FPROC, glUniform1f)                                                                                 \
    X(PFNGLGENQUERIESPROC, glGenQueries)                                                                               \
    X(PFNGLBEGINQUERYPROC, glBeginQuery)                                                                               \
    X(PFNGLENDQUERYPROC, glEndQuery)                                                                                   \
    X(PFNGLGETQUERYOBJECTUIVPROC, glGetQueryObjectuiv)

#define CALL_MEMBER(type, name) type name;
typedef struct context {
    CALLS(CALL_MEMBER)
    functions egl;
    shot_machine *machine;
    GLuint query;
} context;

static bool fail(context *g, const char *what) {
    snprintf(g->machine->error, sizeof g->machine->error, "%s", what);
    return false;
}

/* ---- The context ------------------------------------------------------------------------------------------------- */

static bool find_calls(context *g) {
    bool all = true;
#define CALL_FIND(type, name) all = (g->name = (type)(void (*)(void))g->egl.eglGetProcAddress(#name)) != NULL && all;
    CALLS(CALL_FIND)
    return all || fail(g, "OpenGL lacks functions of 3.3 or glClipControl()");
}

static bool open_context(context *g) {
    static const EGLint wish[] = {
        EGL_CONTEXT_MAJOR_VERSION,           3,       EGL_CONTEXT_MINOR_VERSION, 3, EGL_CONTEXT_OPENGL_PROFILE_MASK,
        EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
    const EGLDisplay display = g->egl.eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL);
    if (display == EGL_NO_DISPLAY || !g->egl.eglInitialize(display, NULL, NULL))
        return fail(g, "EGL finds no device without a window");
    if (!g->egl.eglBindAPI(EGL_OPENGL_API))
        return fail(g, "EGL has no OpenGL");
    const EGLContext made = g->egl.eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, wish);
    if (made == EGL_NO_CONTEXT || !g->egl.eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, made))
        return fail(g, "the driver has no context of OpenGL 3.3");
    return find_calls(g);
}

static void describe(context *g) {
    static const char *const formats[SHOT_FORMATS] = {"DEPTH_COMPONENT16", "DEPTH24_STENCIL8", "DEPTH_COMPONENT32F"};
    shot_device *d = &g->machine->device[0];
    GLint bits = 0;
    g->glGetIntegerv(GL_SUBPIXEL_BITS, &bits);
    *d = (shot_device){.subpixel_bits = bits};
    snprintf(d->name, sizeof d->name, "%s", (const char *)g->glGetString(GL_RENDERER));
    snprintf(d->driver, sizeof d->driver, "%s, %s", (const char *)g->glGetString(GL_VENDOR),
             (const char *)g->glGetString(GL_VERSION));
    snprintf(d->api, sizeof d->api, "OpenGL");
    for (int i = 0; i < SHOT_FORMATS; i++) {
        d->has[i] = true;
        snprintf(d->format[i], sizeof d->format[i], "%s", formats[i]);
    }
    g->machine->count = 1;
    g->machine->counts = true;
}

/* ---- Drawing ----------------------------------------------------------------------------------------------------- */

static bool use_program(context *g, const shot *s, shot_program which) {
    char head[128];
    snprintf(head, sizeof head,
             "#version 330\n#define program %d\n"
             "in vec4 given;\n"
             "uniform float a, b;\n",
             (int)which);
    const char *const text[2] = {head, probe_glsl};
    const GLuint shader = g->glCreateShader(GL_VERTEX_SHADER), made = g->glCreateProgram();
    GLint linked = 0;
    g->glShaderSource(shader, 2, text, NULL);
    g->glCompileShader(shader);
    g->glAttachShader(made, shader);
    g->glBindAttribLocation(made, 0, "given");
    g->glLinkProgram(made);
    g->glGetProgramiv(made, GL_LINK_STATUS, &linked);
    if (!linked)
        return fail(g, "the driver refuses the shader");
    g->glUseProgram(made);
    g->glUniform1f(g->glGetUniformLocation(made, "a"), s->a);
    g->glUniform1f(g->glGetUniformLocation(made, "b"), s->b);
    return true;
}

static bool draw(context *g, const shot *s, bool second) {
    if (!use_program(g, s, second ? s->other : s->program))
        return false;
    g->glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)(s->count * sizeof *s->vertex), second ? s->second : s->vertex,
                    GL_STREAM_DRAW);
    g->glDepthFunc(second ? GL_EQUAL : GL_ALWAYS);
    g->glDepthMask(!second);
    g->glDrawArrays(s->triangles ? GL_TRIANGLES : GL_POINTS, 0, (GLsizei)s->count);
    return true;
}

static bool make_depth(context *g, shot_format format) {
    static const GLenum stored[SHOT_FORMATS] = {GL_DEPTH_COMPONENT16, GL_DEPTH24_STENCIL8, GL_DEPTH_COMPONENT32F};
    const bool stencil = format == SHOT_D24;
    GLuint frame, depth;
    g->glGenFramebuffers(1, &frame);
    g->glBindFramebuffer(GL_FRAMEBUFFER, frame);
    g->glGenRenderbuffers(1, &depth);
    g->glBindRenderbuffer(GL_RENDERBUFFER, depth);
    g->glRenderbufferStorage(GL_RENDERBUFFER, stored[format], SHOT_SIZE, SHOT_SIZE);
    g->glFramebufferRenderbuffer(GL_FRAMEBUFFER, stencil ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT,
                                 GL_RENDERBUFFER, depth);
    g->glDrawBuffer(GL_NONE);
    g->glReadBuffer(GL_NONE);
    return g->glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE ||
           fail(g, "the driver refuses a frame of depth alone");
}

/* Reads the codes as they lie in memory: no conversion on the way. */
static void take_codes(context *g, shot *s) {
    static uint16_t narrow[SHOT_PIXELS];
    const GLenum what = s->format == SHOT_D24 ? GL_DEPTH_STENCIL : GL_DEPTH_COMPONENT;
    const GLenum type = s->format == SHOT_D16   ? GL_UNSIGNED_SHORT
                        : s->format == SHOT_D24 ? GL_UNSIGNED_INT_24_8
                                                : GL_FLOAT;
    g->glReadPixels(0, 0, SHOT_SIZE, SHOT_SIZE, what, type, s->format == SHOT_D16 ? (void *)narrow : s->code);
    for (int i = 0; i < SHOT_PIXELS; i++)
        s->code[i] = s->format == SHOT_D16 ? narrow[i] : s->format == SHOT_D24 ? s->code[i] >> 8 : s->code[i];
}

static bool take_shot(context *g, shot *s) {
    GLuint passed = 0;
    if (!make_depth(g, s->format))
        return false;
    g->glClear(GL_DEPTH_BUFFER_BIT);
    (s->constant != 0.0F || s->slope != 0.0F ? g->glEnable : g->glDisable)(GL_POLYGON_OFFSET_FILL);
    g->glPolygonOffset(s->slope, s->constant);
    g->glDepthRange((double)s->range[0], (double)shot_range_end(s));
    if (!draw(g, s, false))
        return false;
    if (s->again) {
        g->glBeginQuery(GL_SAMPLES_PASSED, g->query);
        if (!draw(g, s, true))
            return false;
        g->glEndQuery(GL_SAMPLES_PASSED);
        g->glGetQueryObjectuiv(g->query, GL_QUERY_RESULT, &passed);
        g->glDepthMask(GL_TRUE);
    }
    take_codes(g, s);
    s->passed = passed;
    s->drawn = g->glGetError() == GL_NO_ERROR;
    return s->drawn || fail(g, "the driver refuses a draw");
}

bool shot_opengl(shot_plan *plan, shot_machine *machine) {
    static const library loader = {"a GPU", {"libEGL.so.1", NULL}, "libegl1", symbols};
    char unused[DYNLOAD_ERROR_SIZE];
    context g = {.machine = machine};
    GLuint array, buffer;
    if (!dynload_open(&loader, g.egl.all, unused))
        return fail(&g, "EGL, libEGL.so.1, is not there: Debian's package libegl1 has it");
    if (!open_context(&g))
        return false;
    describe(&g);
    g.glGenVertexArrays(1, &array);
    g.glBindVertexArray(array);
    g.glGenBuffers(1, &buffer);
    g.glBindBuffer(GL_ARRAY_BUFFER, buffer);
    g.glVertexAttribPointer(0, 4, GL_FLOAT, GL_FALSE, 0, NULL);
    g.glEnableVertexAttribArray(0);
    g.glGenQueries(1, &g.query);
    g.glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    g.glViewport(0, 0, SHOT_SIZE, SHOT_SIZE);
    g.glEnable(GL_DEPTH_TEST);
    g.glClearDepth((double)SHOT_CLEAR);
    for (size_t i = 0; i < plan->count; i++)
        if (!take_shot(&g, &plan->shot[i]))
            return false;
    return true;
}

#else

bool shot_opengl(shot_plan *plan, shot_machine *machine) {
    (void)plan;
    snprintf(machine->error, sizeof machine->error,
             "this build has no OpenGL: build it where Debian's packages libegl-dev and libgl-dev are installed");
    return false;
}

#endif
