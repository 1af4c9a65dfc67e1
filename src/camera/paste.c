/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "camera/paste.h"

#include <stdio.h>
#include <string.h>

typedef struct row {
    const char *presets;         /* parted by spaces */
    const char *before, *behind; /* the near plane */
    const char *reversed;
} row;

static const row rows[] = {
    {"three three-webgpu r3f aframe", "camera.near = ", "; camera.updateProjectionMatrix();",
     "new THREE.WebGLRenderer({ reversedDepthBuffer: true })"},
    {"babylon", "camera.minZ = ", ";", "engine.useReverseDepthBuffer = true;"},
    {"playcanvas", "entity.camera.nearClip = ", ";", NULL},
    {"unity unity-gl", "camera.nearClipPlane = ", "f;", NULL},
    {"unreal", "NearClipPlane=", " in [/Script/Engine.Engine] of DefaultEngine.ini", NULL},
    {"godot-forward godot-mobile godot-compatibility", "camera.near = ", "", NULL},
    {"bevy", "PerspectiveProjection { near: ", ", ..default() }", NULL},
    {"cesium", "viewer.camera.frustum.near = ", ";", NULL},
    {"mujoco mujoco-2", "model.vis.map.znear = ", " / model.stat.extent", NULL},
};

const char *paste_presets(size_t i) {
    return i < sizeof rows / sizeof rows[0] ? rows[i].presets : NULL;
}

/* The row that has the engine's name as a whole word. */
static const row *find(const paste *p) {
    const char *name = p->engine != NULL ? p->engine->name : "";
    const size_t length = strlen(name);
    for (size_t i = 0; length > 0 && i < sizeof rows / sizeof rows[0]; i++)
        for (const char *at = rows[i].presets; (at = strstr(at, name)) != NULL; at += length)
            if ((at == rows[i].presets || at[-1] == ' ') && (at[length] == ' ' || at[length] == '\0'))
                return &rows[i];
    return NULL;
}

const char *paste_near(const paste *p, const char *value, char *out, size_t size) {
    const row *r = find(p);
    const unit_row *own = r != NULL ? unit_find(p->engine->unit) : NULL;
    if (r == NULL || (own != NULL && p->unit != NULL && own != p->unit))
        return NULL;
    snprintf(out, size, "%s%s%s", r->before, value, r->behind);
    return out;
}

const char *paste_reversed(const paste *p) {
    const row *r = find(p);
    return r != NULL ? r->reversed : NULL;
}
