/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shaders of others, run on a device and timed. */
#include "probe/vulkan.h"

#ifdef PROBE_VULKAN

#include <string.h>
#include <time.h>

enum { BINDINGS = 3, GROUPS_MOST = 32768 };

/* Buffers at bindings 0 to 2, and a pipeline over them. */
static bool make_compute(gpu *g, const compute_run *run, void *at[BINDINGS], VkPipeline *pipeline) {
    VkDescriptorSetLayoutBinding binding[BINDINGS];
    VkDescriptorBufferInfo buffer[BINDINGS];
    VkWriteDescriptorSet write[BINDINGS];
    VkDescriptorSetLayout layout;
    VkDescriptorPool pool;
    VkDescriptorSet set;
    for (uint32_t i = 0; i < BINDINGS; i++)
        binding[i] =
            (VkDescriptorSetLayoutBinding){i, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, VK_SHADER_STAGE_COMPUTE_BIT, NULL};
    const VkDescriptorPoolSize size = {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, BINDINGS};
    const VkDescriptorSetLayoutCreateInfo bindings = {
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO, .bindingCount = BINDINGS, .pBindings = binding};
    const VkDescriptorPoolCreateInfo sets = {
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO, .maxSets = 1, .poolSizeCount = 1, .pPoolSizes = &size};
    const VkPipelineLayoutCreateInfo whole = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO, .setLayoutCount = 1, .pSetLayouts = &layout};
    if (!vulkan_good(g, g->call.vkCreateDescriptorSetLayout(g->device, &bindings, NULL, &layout), "bindings") ||
        !vulkan_good(g, g->call.vkCreateDescriptorPool(g->device, &sets, NULL, &pool), "a pool of bindings") ||
        !vulkan_good(g, g->call.vkCreatePipelineLayout(g->device, &whole, NULL, &g->layout), "the layout"))
        return false;
    const VkDescriptorSetAllocateInfo one = {.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
                                             .descriptorPool = pool,
                                             .descriptorSetCount = 1,
                                             .pSetLayouts = &layout};
    if (!vulkan_good(g, g->call.vkAllocateDescriptorSets(g->device, &one, &set), "bindings"))
        return false;
    for (uint32_t i = 0; i < BINDINGS; i++) {
        buffer[i] = (VkDescriptorBufferInfo){VK_NULL_HANDLE, 0, VK_WHOLE_SIZE};
        if (!vulkan_make_buffer(g, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, &buffer[i].buffer, &at[i]))
            return false;
        write[i] = (VkWriteDescriptorSet){.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                                          .dstSet = set,
                                          .dstBinding = i,
                                          .descriptorCount = 1,
                                          .descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                                          .pBufferInfo = &buffer[i]};
    }
    memcpy(at[2], run->constants, sizeof run->constants);
    g->call.vkUpdateDescriptorSets(g->device, BINDINGS, write, 0, NULL);
    const VkComputePipelineCreateInfo wish = {.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO,
                                              .stage = {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                                                        .stage = VK_SHADER_STAGE_COMPUTE_BIT,
                                                        .module = g->shader,
                                                        .pName = run->entry},
                                              .layout = g->layout};
    g->set = set;
    return vulkan_good(g, g->call.vkCreateComputePipelines(g->device, VK_NULL_HANDLE, 1, &wish, NULL, pipeline),
                       "a pipeline");
}

/* `times` dispatches of as many workgroups. */
static bool dispatch(gpu *g, VkPipeline pipeline, uint32_t groups, uint32_t times) {
    const VkMemoryBarrier read = {.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER,
                                  .srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT,
                                  .dstAccessMask = VK_ACCESS_HOST_READ_BIT};
    if (!vulkan_begin_commands(g))
        return false;
    g->call.vkCmdBindPipeline(g->commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
    g->call.vkCmdBindDescriptorSets(g->commands, VK_PIPELINE_BIND_POINT_COMPUTE, g->layout, 0, 1, &g->set, 0, NULL);
    for (uint32_t i = 0; i < times; i++)
        g->call.vkCmdDispatch(g->commands, groups, 1, 1);
    g->call.vkCmdPipelineBarrier(g->commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1,
                                 &read, 0, NULL, 0, NULL);
    return vulkan_do_commands(g, COMPUTE_WAIT_SECONDS);
}

/* In portions that a buffer holds. A value that the shader does not write is NaN. */
static bool compute(gpu *g, const compute_run *run, void *const at[BINDINGS], VkPipeline pipeline, FILE *out) {
    const uint64_t room = (uint64_t)GROUPS_MOST * run->group < FLOATS ? (uint64_t)GROUPS_MOST * run->group : FLOATS;
    const uint64_t most = run->each > 0 && run->each < room ? run->each : room;
    float *in = at[0];
    memset(at[1], 0xFF, BUFFER_BYTES);
    for (uint64_t from = 0; from < run->count; from += most) {
        const uint64_t count = run->count - from < most ? run->count - from : most;
        for (uint64_t i = 0; i < count; i++)
            in[i] = run->depth(run->of, from + i);
        if (run->each > 0)
            memcpy(at[2], run->cameras[from / run->each], sizeof *run->cameras);
        if (!dispatch(g, pipeline, (uint32_t)((count + run->group - 1) / run->group), 1))
            return false;
        fwrite(at[1], sizeof(float), count, out);
    }
    return true;
}

/* A run that is timed: the depths in a buffer, again and again. */
typedef struct timed {
    gpu g;
    VkPipeline pipeline;
    float *turns;
    uint32_t groups, most, times; /* workgroups of a dispatch, of all depths; dispatches */
    double calls;                 /* of all of them */
} timed;

/* Nanoseconds of a call. */
static bool time_once(timed *t, double *ns) {
    struct timespec from, to;
    clock_gettime(CLOCK_MONOTONIC, &from);
    if (!dispatch(&t->g, t->pipeline, t->groups, t->times))
        return false;
    clock_gettime(CLOCK_MONOTONIC, &to);
    *ns = (1e9 * (double)(to.tv_sec - from.tv_sec) + (double)(to.tv_nsec - from.tv_nsec)) / t->calls;
    return true;
}

/* Twice as many calls: of more depths; then of more turns, beside which reading depths is nothing; then again. */
static void make_longer(timed *t) {
    enum { TURNS_MOST = 2048 };
    if (2 * t->groups <= t->most)
        t->groups *= 2;
    else if (2 * *t->turns <= TURNS_MOST)
        *t->turns *= 2;
    else
        t->times *= 2;
    t->calls *= 2;
}

static bool make_timed(const gpu *g, const compute_run *run, timed *t) {
    enum { GROUPS_LEAST = 64 };
    void *at[BINDINGS];
    t->g = *g;
    if (!vulkan_make_shader(&t->g, run->code, run->size) || !make_compute(&t->g, run, at, &t->pipeline))
        return false;
    for (size_t k = 0; k < FLOATS; k++)
        ((float *)at[0])[k] = ((float)k + 0.5F) / FLOATS;
    t->turns = (float *)at[2] + COMPUTE_CONSTANTS - 1;
    t->most = FLOATS / run->group;
    t->groups = GROUPS_LEAST;
    t->times = 1;
    t->calls = (double)GROUPS_LEAST * run->group * run->turns;
    return true;
}

/* Each as long as starting it is nothing beside; then in turns, so that what disturbs the machine disturbs all alike.
 */
static bool time_all(const gpu *g, const compute_run *run, size_t runs, FILE *out) {
    static const double least_ns = 2e6, calls_most = 0x1p44;
    timed each[COMPUTE_TIMED_MOST];
    double ns;
    for (size_t i = 0; i < runs; i++) {
        if (!make_timed(g, &run[i], &each[i]))
            return false;
        for (int good = -1; good < 2 && each[i].calls < calls_most;) { /* twice: no chance */
            if (!time_once(&each[i], &ns))
                return false;
            if (good < 0 || ns * each[i].calls >= least_ns) /* the first time it is made ready */
                good++;
            else
                make_longer(&each[i]);
        }
    }
    for (size_t k = 0; k < COMPUTE_TIMES * runs; k++) {
        if (!time_once(&each[k % runs], &ns))
            return false;
        fwrite(&ns, sizeof ns, 1, out);
    }
    return true;
}

bool shot_compute(const char *wanted, const compute_run *run, size_t runs, shot_machine *machine, FILE *out) {
    gpu g = {.machine = machine};
    VkPipeline pipeline;
    void *at[BINDINGS];
    if (!vulkan_open(&g, wanted) || !vulkan_make_commands(&g))
        return false;
    return runs > 0 ? time_all(&g, run, runs, out)
                    : vulkan_make_shader(&g, run->code, run->size) && make_compute(&g, run, at, &pipeline) &&
                          compute(&g, run, at, pipeline, out);
}

#else

bool shot_compute(const char *wanted, const compute_run *run, size_t runs, shot_machine *machine, FILE *out) {
    (void)wanted;
    (void)run;
    (void)runs;
    (void)out;
    snprintf(machine->error, sizeof machine->error, PROBE_ABSENT);
    return false;
}

#endif
