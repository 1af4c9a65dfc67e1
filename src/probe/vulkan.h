/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file vulkan.h  For this room alone: a device that vulkan.c opens, on which vulkan_draw.c draws and vulkan_compute.c
 * computes. */
#ifndef PROBE_VULKAN_H
#define PROBE_VULKAN_H

#include "probe/compute.h"

#if __has_include(<vulkan/vulkan_core.h>)
#define PROBE_VULKAN

#include <vulkan/vulkan_core.h>

#include "system/dynload.h"

#define FUNCTIONS(X)                                                                                                   \
    X(vkCreateInstance)                                                                                                \
    X(vkEnumeratePhysicalDevices)                                                                                      \
    X(vkGetPhysicalDeviceProperties)                                                                                   \
    X(vkGetPhysicalDeviceProperties2)                                                                                  \
    X(vkGetPhysicalDeviceFeatures)                                                                                     \
    X(vkGetPhysicalDeviceFormatProperties)                                                                             \
    X(vkGetPhysicalDeviceMemoryProperties)                                                                             \
    X(vkGetPhysicalDeviceQueueFamilyProperties)                                                                        \
    X(vkCreateDevice)                                                                                                  \
    X(vkGetDeviceQueue)                                                                                                \
    X(vkCreateShaderModule)                                                                                            \
    X(vkCreatePipelineLayout)                                                                                          \
    X(vkCreateGraphicsPipelines)                                                                                       \
    X(vkCreateRenderPass)                                                                                              \
    X(vkCreateFramebuffer)                                                                                             \
    X(vkCreateImage)                                                                                                   \
    X(vkCreateImageView)                                                                                               \
    X(vkGetImageMemoryRequirements)                                                                                    \
    X(vkBindImageMemory)                                                                                               \
    X(vkCreateBuffer)                                                                                                  \
    X(vkGetBufferMemoryRequirements)                                                                                   \
    X(vkBindBufferMemory)                                                                                              \
    X(vkAllocateMemory)                                                                                                \
    X(vkMapMemory)                                                                                                     \
    X(vkCreateCommandPool)                                                                                             \
    X(vkAllocateCommandBuffers)                                                                                        \
    X(vkBeginCommandBuffer)                                                                                            \
    X(vkEndCommandBuffer)                                                                                              \
    X(vkCreateDescriptorSetLayout)                                                                                     \
    X(vkCreateDescriptorPool)                                                                                          \
    X(vkAllocateDescriptorSets)                                                                                        \
    X(vkUpdateDescriptorSets)                                                                                          \
    X(vkCreateComputePipelines)                                                                                        \
    X(vkCreateQueryPool)                                                                                               \
    X(vkGetQueryPoolResults)                                                                                           \
    X(vkCreateFence)                                                                                                   \
    X(vkResetFences)                                                                                                   \
    X(vkWaitForFences)                                                                                                 \
    X(vkQueueSubmit)                                                                                                   \
    X(vkCmdResetQueryPool)                                                                                             \
    X(vkCmdBeginQuery)                                                                                                 \
    X(vkCmdEndQuery)                                                                                                   \
    X(vkCmdBeginRenderPass)                                                                                            \
    X(vkCmdEndRenderPass)                                                                                              \
    X(vkCmdBindPipeline)                                                                                               \
    X(vkCmdBindVertexBuffers)                                                                                          \
    X(vkCmdPushConstants)                                                                                              \
    X(vkCmdDraw)                                                                                                       \
    X(vkCmdBindDescriptorSets)                                                                                         \
    X(vkCmdDispatch)                                                                                                   \
    X(vkCmdCopyImageToBuffer)                                                                                          \
    X(vkCmdPipelineBarrier)
DYNLOAD_CALLS(FUNCTIONS)

enum {
    VERTICES_MAX = SHOT_PIXELS,
    BUFFER_BYTES = VERTICES_MAX * 4 * sizeof(float),
    FLOATS = BUFFER_BYTES / sizeof(float),
    NUMBERS_SIZE = 40
};

/* A depth buffer of a format. */
typedef struct buffer_of {
    VkFormat format;
    VkImage image;
    VkRenderPass pass;
    VkFramebuffer frame;
} buffer_of;

typedef struct gpu {
    functions call;
    shot_machine *machine;
    VkInstance instance;
    VkPhysicalDevice physical;
    VkPhysicalDeviceMemoryProperties memory;
    uint32_t family;
    VkDevice device;
    VkQueue queue;
    VkShaderModule shader;
    VkPipelineLayout layout;
    VkDescriptorSet set;
    VkCommandBuffer commands;
    VkFence fence;
    VkQueryPool query;
    VkBuffer vertices, seconds, codes;
    void *at_vertices, *at_seconds, *at_codes;
    buffer_of depth[SHOT_FORMATS];
} gpu;

/** Each says why it failed in machine->error; of a result other than success what it means, in a sentence.
 *  @return whether it went well */
bool vulkan_fail(gpu *g, const char *what);
bool vulkan_good(gpu *g, VkResult result, const char *what);

/** Finds the device that is wanted and opens it. */
bool vulkan_open(gpu *g, const char *wanted);

/** The first depth format of those for `asked` that the device has and that a draw can be copied from, and its name;
 * VK_FORMAT_UNDEFINED where it has none. */
VkFormat vulkan_format(const gpu *g, VkPhysicalDevice physical, shot_format asked, char name[SHOT_NAME_SIZE]);

/** Memory with these flags. */
bool vulkan_allocate(gpu *g, const VkMemoryRequirements *need, VkMemoryPropertyFlags flags, VkDeviceMemory *out);

/** A buffer of BUFFER_BYTES that this process sees, too. */
bool vulkan_make_buffer(gpu *g, VkBufferUsageFlags usage, VkBuffer *out, void **at);
bool vulkan_make_shader(gpu *g, const uint32_t *code, size_t size);
bool vulkan_make_commands(gpu *g);

/** Begins what is recorded next; ends it, and waits until the device has done it. */
bool vulkan_begin_commands(gpu *g);
bool vulkan_do_commands(gpu *g, uint64_t seconds);

#elif defined(_WIN32)
#define PROBE_ABSENT "the program for Windows has no probe yet: the page says what a browser shows of this GPU"
#else
#define PROBE_ABSENT "this build has no Vulkan: build it where Debian's package libvulkan-dev is installed"
#endif
#endif
