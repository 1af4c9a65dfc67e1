/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Vulkan without a window. All of it runs in a process that ends when it is done, so nothing is given back, and a
 * driver that breaks down or hangs takes nobody with it.
 */
#define _GNU_SOURCE /* strcasestr() */
#include "probe/compute.h"

#if __has_include(<vulkan/vulkan_core.h>)

#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <time.h>
#include <vulkan/vulkan_core.h>

#include "probe/spirv.h"
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
DYNLOAD_FUNCTIONS(FUNCTIONS)

enum {
    VERTICES_MAX = SHOT_PIXELS,
    BUFFER_BYTES = VERTICES_MAX * 4 * sizeof(float),
    FLOATS = BUFFER_BYTES / sizeof(float),
    WAIT_SECONDS = 20,
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

static bool fail(gpu *g, const char *what) {
    snprintf(g->machine->error, sizeof g->machine->error, "%s", what);
    return false;
}

/* What a result other than success means, in a sentence. */
static bool good(gpu *g, VkResult result, const char *what) {
    static const struct {
        VkResult result;
        const char *text;
    } known[] = {{VK_ERROR_OUT_OF_HOST_MEMORY, "there is no memory for it"},
                 {VK_ERROR_OUT_OF_DEVICE_MEMORY, "the device has no memory for it"},
                 {VK_ERROR_DEVICE_LOST, "the device was lost"},
                 {VK_ERROR_INCOMPATIBLE_DRIVER, "no driver was found: Debian's package mesa-vulkan-drivers has some"},
                 {VK_TIMEOUT, "the device does not come to an end"}};
    if (result == VK_SUCCESS)
        return true;
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++)
        if (known[i].result == result)
            return fail(g, known[i].text);
    snprintf(g->machine->error, sizeof g->machine->error, "the driver refuses %s, VkResult %d", what, (int)result);
    return false;
}

/* ---- Devices ----------------------------------------------------------------------------------------------------- */

/* Depth formats that a draw can be copied from, the first that the device has. */
static VkFormat format_of(const gpu *g, VkPhysicalDevice physical, shot_format asked, char name[SHOT_NAME_SIZE]) {
    static const struct {
        shot_format asked;
        VkFormat format;
        const char *name;
    } known[] = {{SHOT_D16, VK_FORMAT_D16_UNORM, "D16_UNORM"},
                 {SHOT_D24, VK_FORMAT_X8_D24_UNORM_PACK32, "X8_D24_UNORM_PACK32"},
                 {SHOT_D24, VK_FORMAT_D24_UNORM_S8_UINT, "D24_UNORM_S8_UINT"},
                 {SHOT_D32F, VK_FORMAT_D32_SFLOAT, "D32_SFLOAT"},
                 {SHOT_D32F, VK_FORMAT_D32_SFLOAT_S8_UINT, "D32_SFLOAT_S8_UINT"}};
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        VkFormatProperties has;
        if (known[i].asked != asked)
            continue;
        g->call.vkGetPhysicalDeviceFormatProperties(physical, known[i].format, &has);
        if ((has.optimalTilingFeatures & VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT) == 0)
            continue;
        snprintf(name, SHOT_NAME_SIZE, "%s", known[i].name);
        return known[i].format;
    }
    return VK_FORMAT_UNDEFINED;
}

static void describe(const gpu *g, VkPhysicalDevice physical, shot_device *out) {
    VkPhysicalDeviceProperties p;
    g->call.vkGetPhysicalDeviceProperties(physical, &p);
    *out = (shot_device){.software = p.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU,
                         .subpixel_bits = (int)p.limits.subPixelPrecisionBits};
    snprintf(out->name, sizeof out->name, "%s", p.deviceName);
    snprintf(out->api, sizeof out->api, "Vulkan %u.%u.%u", VK_API_VERSION_MAJOR(p.apiVersion),
             VK_API_VERSION_MINOR(p.apiVersion), VK_API_VERSION_PATCH(p.apiVersion));
    snprintf(out->driver, NUMBERS_SIZE, "%u.%u.%u", VK_API_VERSION_MAJOR(p.driverVersion),
             VK_API_VERSION_MINOR(p.driverVersion), VK_API_VERSION_PATCH(p.driverVersion));
    if (p.apiVersion >= VK_API_VERSION_1_2) {
        VkPhysicalDeviceDriverProperties driver = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES};
        VkPhysicalDeviceProperties2 more = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, .pNext = &driver};
        g->call.vkGetPhysicalDeviceProperties2(physical, &more);
        char version[NUMBERS_SIZE];
        memcpy(version, out->driver, sizeof version);
        snprintf(out->driver, sizeof out->driver, "%s, %s", driver.driverName,
                 driver.driverInfo[0] != '\0' ? driver.driverInfo : version);
    }
    for (int i = 0; i < SHOT_FORMATS; i++)
        out->has[i] = format_of(g, physical, (shot_format)i, out->format[i]) != VK_FORMAT_UNDEFINED;
}

static bool names(const char *wanted, size_t index, const char *name) {
    char number[24];
    snprintf(number, sizeof number, "%zu", index);
    return strcmp(wanted, number) == 0 || strcasestr(name, wanted) != NULL;
}

static bool choose(gpu *g, const char *wanted, const VkPhysicalDevice physical[SHOT_DEVICES_MAX]) {
    shot_machine *m = g->machine;
    for (size_t i = m->count; i-- > 0;)
        if (wanted != NULL && names(wanted, i, m->device[i].name))
            m->chosen = i;
    for (size_t i = 0; wanted == NULL && i < m->count && m->chosen == m->count; i++)
        if (!m->device[i].software)
            m->chosen = i;
    if (wanted == NULL && m->chosen == m->count)
        m->chosen = 0;
    if (m->chosen == m->count)
        return fail(g, "no device has that name or number");
    g->physical = physical[m->chosen];
    return true;
}

static bool list(gpu *g, const char *wanted) {
    const VkApplicationInfo about = {
        .sType = VK_STRUCTURE_TYPE_APPLICATION_INFO, .pApplicationName = "depthprec", .apiVersion = VK_API_VERSION_1_2};
    const VkInstanceCreateInfo wish = {.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO, .pApplicationInfo = &about};
    VkPhysicalDevice physical[SHOT_DEVICES_MAX];
    uint32_t count = SHOT_DEVICES_MAX;
    if (!good(g, g->call.vkCreateInstance(&wish, NULL, &g->instance), "an instance"))
        return false;
    const VkResult result = g->call.vkEnumeratePhysicalDevices(g->instance, &count, physical);
    if (!good(g, result == VK_INCOMPLETE ? VK_SUCCESS : result, "its devices"))
        return false;
    if (count == 0)
        return good(g, VK_ERROR_INCOMPATIBLE_DRIVER, "");
    g->machine->count = g->machine->chosen = count;
    for (uint32_t i = 0; i < count; i++)
        describe(g, physical[i], &g->machine->device[i]);
    return choose(g, wanted, physical);
}

/* ---- The device -------------------------------------------------------------------------------------------------- */

static bool find_family(gpu *g) {
    VkQueueFamilyProperties family[16];
    uint32_t count = 16;
    g->call.vkGetPhysicalDeviceQueueFamilyProperties(g->physical, &count, family);
    for (g->family = 0; g->family < count; g->family++)
        if ((family[g->family].queueFlags & VK_QUEUE_GRAPHICS_BIT) != 0)
            return true;
    return fail(g, "the device draws nothing");
}

static bool open_device(gpu *g) {
    static const float first = 1.0F;
    VkPhysicalDeviceFeatures has, use = {0};
    if (!find_family(g))
        return false;
    g->call.vkGetPhysicalDeviceFeatures(g->physical, &has);
    g->call.vkGetPhysicalDeviceMemoryProperties(g->physical, &g->memory);
    g->machine->counts = has.occlusionQueryPrecise != VK_FALSE;
    use.occlusionQueryPrecise = has.occlusionQueryPrecise;
    use.robustBufferAccess = has.robustBufferAccess; /* shaders of others */
    const VkDeviceQueueCreateInfo queue = {.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                           .queueFamilyIndex = g->family,
                                           .queueCount = 1,
                                           .pQueuePriorities = &first};
    const VkDeviceCreateInfo wish = {.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                     .queueCreateInfoCount = 1,
                                     .pQueueCreateInfos = &queue,
                                     .pEnabledFeatures = &use};
    if (!good(g, g->call.vkCreateDevice(g->physical, &wish, NULL, &g->device), "the device"))
        return false;
    g->call.vkGetDeviceQueue(g->device, g->family, 0, &g->queue);
    return true;
}

static bool allocate(gpu *g, const VkMemoryRequirements *need, VkMemoryPropertyFlags flags, VkDeviceMemory *out) {
    for (uint32_t i = 0; i < g->memory.memoryTypeCount; i++) {
        const VkMemoryAllocateInfo wish = {
            .sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, .allocationSize = need->size, .memoryTypeIndex = i};
        if ((need->memoryTypeBits >> i & 1U) != 0 && (g->memory.memoryTypes[i].propertyFlags & flags) == flags)
            return good(g, g->call.vkAllocateMemory(g->device, &wish, NULL, out), "memory");
    }
    return good(g, VK_ERROR_OUT_OF_DEVICE_MEMORY, "");
}

static bool make_buffer(gpu *g, VkBufferUsageFlags usage, VkBuffer *out, void **at) {
    const VkBufferCreateInfo wish = {
        .sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO, .size = BUFFER_BYTES, .usage = usage};
    VkMemoryRequirements need;
    VkDeviceMemory memory;
    if (!good(g, g->call.vkCreateBuffer(g->device, &wish, NULL, out), "a buffer"))
        return false;
    g->call.vkGetBufferMemoryRequirements(g->device, *out, &need);
    return allocate(g, &need, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT, &memory) &&
           good(g, g->call.vkBindBufferMemory(g->device, *out, memory, 0), "memory of a buffer") &&
           good(g, g->call.vkMapMemory(g->device, memory, 0, VK_WHOLE_SIZE, 0, at), "mapped memory");
}

static bool make_shader(gpu *g, const uint32_t *code, size_t size) {
    const VkShaderModuleCreateInfo shader = {
        .sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO, .codeSize = size, .pCode = code};
    return good(g, g->call.vkCreateShaderModule(g->device, &shader, NULL, &g->shader), "the shader");
}

static bool make_commands(gpu *g) {
    const VkCommandPoolCreateInfo commands = {.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                              .flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT,
                                              .queueFamilyIndex = g->family};
    const VkFenceCreateInfo fence = {.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
    VkCommandPool pool = VK_NULL_HANDLE;
    if (!good(g, g->call.vkCreateCommandPool(g->device, &commands, NULL, &pool), "a pool of commands"))
        return false;
    const VkCommandBufferAllocateInfo one = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                             .commandPool = pool,
                                             .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                                             .commandBufferCount = 1};
    return good(g, g->call.vkAllocateCommandBuffers(g->device, &one, &g->commands), "a buffer of commands") &&
           good(g, g->call.vkCreateFence(g->device, &fence, NULL, &g->fence), "a fence");
}

static bool make_tools(gpu *g) {
    const VkPushConstantRange range = {VK_SHADER_STAGE_VERTEX_BIT, 0, 2 * sizeof(float)};
    const VkPipelineLayoutCreateInfo layout = {.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                               .pushConstantRangeCount = 1,
                                               .pPushConstantRanges = &range};
    const VkQueryPoolCreateInfo query = {
        .sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO, .queryType = VK_QUERY_TYPE_OCCLUSION, .queryCount = 1};
    return make_commands(g) && make_shader(g, probe_spirv, sizeof probe_spirv) &&
           good(g, g->call.vkCreatePipelineLayout(g->device, &layout, NULL, &g->layout), "the layout") &&
           good(g, g->call.vkCreateQueryPool(g->device, &query, NULL, &g->query), "a query") &&
           make_buffer(g, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, &g->vertices, &g->at_vertices) &&
           make_buffer(g, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, &g->seconds, &g->at_seconds) &&
           make_buffer(g, VK_BUFFER_USAGE_TRANSFER_DST_BIT, &g->codes, &g->at_codes);
}

/* ---- Depth buffers ----------------------------------------------------------------------------------------------- */

static bool make_image(gpu *g, buffer_of *d, VkImageView *view) {
    const VkImageCreateInfo wish = {.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
                                    .imageType = VK_IMAGE_TYPE_2D,
                                    .format = d->format,
                                    .extent = {SHOT_SIZE, SHOT_SIZE, 1},
                                    .mipLevels = 1,
                                    .arrayLayers = 1,
                                    .samples = VK_SAMPLE_COUNT_1_BIT,
                                    .tiling = VK_IMAGE_TILING_OPTIMAL,
                                    .usage =
                                        VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT};
    VkMemoryRequirements need;
    VkDeviceMemory memory;
    if (!good(g, g->call.vkCreateImage(g->device, &wish, NULL, &d->image), "a depth buffer"))
        return false;
    g->call.vkGetImageMemoryRequirements(g->device, d->image, &need);
    if (!allocate(g, &need, 0, &memory) ||
        !good(g, g->call.vkBindImageMemory(g->device, d->image, memory, 0), "memory of a depth buffer"))
        return false;
    const VkImageViewCreateInfo seen = {.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
                                        .image = d->image,
                                        .viewType = VK_IMAGE_VIEW_TYPE_2D,
                                        .format = d->format,
                                        .subresourceRange = {VK_IMAGE_ASPECT_DEPTH_BIT, 0, 1, 0, 1}};
    return good(g, g->call.vkCreateImageView(g->device, &seen, NULL, view), "a view of a depth buffer");
}

static bool make_depth(gpu *g, buffer_of *d) {
    const VkAttachmentDescription attachment = {.format = d->format,
                                                .samples = VK_SAMPLE_COUNT_1_BIT,
                                                .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
                                                .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
                                                .stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE,
                                                .stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE,
                                                .finalLayout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL};
    const VkAttachmentReference depth = {0, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
    const VkSubpassDescription subpass = {.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS,
                                          .pDepthStencilAttachment = &depth};
    const VkSubpassDependency copied = {.dstSubpass = VK_SUBPASS_EXTERNAL,
                                        .srcStageMask = VK_PIPELINE_STAGE_LATE_FRAGMENT_TESTS_BIT,
                                        .dstStageMask = VK_PIPELINE_STAGE_TRANSFER_BIT,
                                        .srcAccessMask = VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT,
                                        .dstAccessMask = VK_ACCESS_TRANSFER_READ_BIT};
    const VkRenderPassCreateInfo pass = {.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO,
                                         .attachmentCount = 1,
                                         .pAttachments = &attachment,
                                         .subpassCount = 1,
                                         .pSubpasses = &subpass,
                                         .dependencyCount = 1,
                                         .pDependencies = &copied};
    VkImageView view;
    if (!make_image(g, d, &view) || !good(g, g->call.vkCreateRenderPass(g->device, &pass, NULL, &d->pass), "a pass"))
        return false;
    const VkFramebufferCreateInfo frame = {.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO,
                                           .renderPass = d->pass,
                                           .attachmentCount = 1,
                                           .pAttachments = &view,
                                           .width = SHOT_SIZE,
                                           .height = SHOT_SIZE,
                                           .layers = 1};
    return good(g, g->call.vkCreateFramebuffer(g->device, &frame, NULL, &d->frame), "a frame");
}

/* ---- Drawing ----------------------------------------------------------------------------------------------------- */

static bool make_pipeline(gpu *g, const shot *s, bool second, VkPipeline *out) {
    const int32_t program = second ? (int32_t)s->other : (int32_t)s->program;
    const VkSpecializationMapEntry entry = {0, 0, sizeof program};
    const VkSpecializationInfo special = {1, &entry, sizeof program, &program};
    const VkPipelineShaderStageCreateInfo stage = {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                                                   .stage = VK_SHADER_STAGE_VERTEX_BIT,
                                                   .module = g->shader,
                                                   .pName = "main",
                                                   .pSpecializationInfo = &special};
    const VkVertexInputBindingDescription binding = {0, 4 * sizeof(float), VK_VERTEX_INPUT_RATE_VERTEX};
    const VkVertexInputAttributeDescription attribute = {0, 0, VK_FORMAT_R32G32B32A32_SFLOAT, 0};
    const VkPipelineVertexInputStateCreateInfo input = {.sType =
                                                            VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO,
                                                        .vertexBindingDescriptionCount = 1,
                                                        .pVertexBindingDescriptions = &binding,
                                                        .vertexAttributeDescriptionCount = 1,
                                                        .pVertexAttributeDescriptions = &attribute};
    const VkPipelineInputAssemblyStateCreateInfo assembly = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO,
        .topology = s->triangles ? VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST : VK_PRIMITIVE_TOPOLOGY_POINT_LIST};
    const VkViewport view = {0.0F, 0.0F, SHOT_SIZE, SHOT_SIZE, 0.0F, 1.0F};
    const VkRect2D all = {{0, 0}, {SHOT_SIZE, SHOT_SIZE}};
    const VkPipelineViewportStateCreateInfo viewport = {.sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO,
                                                        .viewportCount = 1,
                                                        .pViewports = &view,
                                                        .scissorCount = 1,
                                                        .pScissors = &all};
    const VkPipelineRasterizationStateCreateInfo raster = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO,
        .depthBiasEnable = s->constant != 0.0F || s->slope != 0.0F,
        .depthBiasConstantFactor = s->constant,
        .depthBiasSlopeFactor = s->slope,
        .lineWidth = 1.0F};
    const VkPipelineMultisampleStateCreateInfo samples = {.sType =
                                                              VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO,
                                                          .rasterizationSamples = VK_SAMPLE_COUNT_1_BIT};
    const VkPipelineDepthStencilStateCreateInfo depth = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO,
        .depthTestEnable = VK_TRUE,
        .depthWriteEnable = !second,
        .depthCompareOp = second ? VK_COMPARE_OP_EQUAL : VK_COMPARE_OP_ALWAYS};
    const VkGraphicsPipelineCreateInfo wish = {.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO,
                                               .stageCount = 1,
                                               .pStages = &stage,
                                               .pVertexInputState = &input,
                                               .pInputAssemblyState = &assembly,
                                               .pViewportState = &viewport,
                                               .pRasterizationState = &raster,
                                               .pMultisampleState = &samples,
                                               .pDepthStencilState = &depth,
                                               .layout = g->layout,
                                               .renderPass = g->depth[s->format].pass};
    return good(g, g->call.vkCreateGraphicsPipelines(g->device, VK_NULL_HANDLE, 1, &wish, NULL, out), "a pipeline");
}

static void draw(gpu *g, const shot *s, VkPipeline pipeline, VkBuffer vertices) {
    const float numbers[2] = {s->a, s->b};
    const VkDeviceSize start = 0;
    g->call.vkCmdBindPipeline(g->commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
    g->call.vkCmdPushConstants(g->commands, g->layout, VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof numbers, numbers);
    g->call.vkCmdBindVertexBuffers(g->commands, 0, 1, &vertices, &start);
    g->call.vkCmdDraw(g->commands, s->count, 1, 0, 0);
}

static void draw_pass(gpu *g, const shot *s, const VkPipeline pipeline[2]) {
    const buffer_of *d = &g->depth[s->format];
    const VkClearValue clear = {.depthStencil = {SHOT_CLEAR, 0}};
    const VkRenderPassBeginInfo begin = {.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO,
                                         .renderPass = d->pass,
                                         .framebuffer = d->frame,
                                         .renderArea = {{0, 0}, {SHOT_SIZE, SHOT_SIZE}},
                                         .clearValueCount = 1,
                                         .pClearValues = &clear};
    const VkBufferImageCopy copy = {.imageSubresource = {VK_IMAGE_ASPECT_DEPTH_BIT, 0, 0, 1},
                                    .imageExtent = {SHOT_SIZE, SHOT_SIZE, 1}};
    const VkMemoryBarrier read = {.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER,
                                  .srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT,
                                  .dstAccessMask = VK_ACCESS_HOST_READ_BIT};
    g->call.vkCmdResetQueryPool(g->commands, g->query, 0, 1);
    g->call.vkCmdBeginRenderPass(g->commands, &begin, VK_SUBPASS_CONTENTS_INLINE);
    draw(g, s, pipeline[0], g->vertices);
    if (s->again) {
        g->call.vkCmdBeginQuery(g->commands, g->query, 0, g->machine->counts ? VK_QUERY_CONTROL_PRECISE_BIT : 0);
        draw(g, s, pipeline[1], g->seconds);
        g->call.vkCmdEndQuery(g->commands, g->query, 0);
    }
    g->call.vkCmdEndRenderPass(g->commands);
    g->call.vkCmdCopyImageToBuffer(g->commands, d->image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, g->codes, 1, &copy);
    g->call.vkCmdPipelineBarrier(g->commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &read,
                                 0, NULL, 0, NULL);
}

/* Of 24 bits the upper 8 of a word mean nothing. */
static void take_codes(const gpu *g, shot *s) {
    const uint16_t *narrow = g->at_codes;
    const uint32_t *wide = g->at_codes;
    for (int i = 0; i < SHOT_PIXELS; i++)
        s->code[i] = s->format == SHOT_D16 ? narrow[i] : s->format == SHOT_D24 ? wide[i] & 0xFFFFFFU : wide[i];
}

static bool begin_commands(gpu *g) {
    const VkCommandBufferBeginInfo begin = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                            .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT};
    return good(g, g->call.vkBeginCommandBuffer(g->commands, &begin), "commands");
}

static bool do_commands(gpu *g, uint64_t seconds) {
    const VkSubmitInfo submit = {
        .sType = VK_STRUCTURE_TYPE_SUBMIT_INFO, .commandBufferCount = 1, .pCommandBuffers = &g->commands};
    return good(g, g->call.vkEndCommandBuffer(g->commands), "commands") &&
           good(g, g->call.vkResetFences(g->device, 1, &g->fence), "a fence") &&
           good(g, g->call.vkQueueSubmit(g->queue, 1, &submit, g->fence), "commands") &&
           good(g, g->call.vkWaitForFences(g->device, 1, &g->fence, VK_TRUE, seconds * 1000000000ULL), "to wait");
}

static bool take_shot(gpu *g, shot *s) {
    VkPipeline pipeline[2] = {VK_NULL_HANDLE, VK_NULL_HANDLE};
    memcpy(g->at_vertices, s->vertex, s->count * sizeof *s->vertex);
    if (s->again)
        memcpy(g->at_seconds, s->second, s->count * sizeof *s->second);
    if (!make_pipeline(g, s, false, &pipeline[0]) || (s->again && !make_pipeline(g, s, true, &pipeline[1])) ||
        !begin_commands(g))
        return false;
    draw_pass(g, s, pipeline);
    if (!do_commands(g, WAIT_SECONDS))
        return false;
    if (s->again &&
        !good(g,
              g->call.vkGetQueryPoolResults(g->device, g->query, 0, 1, sizeof s->passed, &s->passed, sizeof s->passed,
                                            VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
              "the result of a query"))
        return false;
    take_codes(g, s);
    s->drawn = true;
    return true;
}

/* ---- Computing --------------------------------------------------------------------------------------------------- */

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
    if (!good(g, g->call.vkCreateDescriptorSetLayout(g->device, &bindings, NULL, &layout), "bindings") ||
        !good(g, g->call.vkCreateDescriptorPool(g->device, &sets, NULL, &pool), "a pool of bindings") ||
        !good(g, g->call.vkCreatePipelineLayout(g->device, &whole, NULL, &g->layout), "the layout"))
        return false;
    const VkDescriptorSetAllocateInfo one = {.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
                                             .descriptorPool = pool,
                                             .descriptorSetCount = 1,
                                             .pSetLayouts = &layout};
    if (!good(g, g->call.vkAllocateDescriptorSets(g->device, &one, &set), "bindings"))
        return false;
    for (uint32_t i = 0; i < BINDINGS; i++) {
        buffer[i] = (VkDescriptorBufferInfo){VK_NULL_HANDLE, 0, VK_WHOLE_SIZE};
        if (!make_buffer(g, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, &buffer[i].buffer, &at[i]))
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
    return good(g, g->call.vkCreateComputePipelines(g->device, VK_NULL_HANDLE, 1, &wish, NULL, pipeline), "a pipeline");
}

/* `times` dispatches of as many workgroups. */
static bool dispatch(gpu *g, VkPipeline pipeline, uint32_t groups, uint32_t times) {
    const VkMemoryBarrier read = {.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER,
                                  .srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT,
                                  .dstAccessMask = VK_ACCESS_HOST_READ_BIT};
    if (!begin_commands(g))
        return false;
    g->call.vkCmdBindPipeline(g->commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
    g->call.vkCmdBindDescriptorSets(g->commands, VK_PIPELINE_BIND_POINT_COMPUTE, g->layout, 0, 1, &g->set, 0, NULL);
    for (uint32_t i = 0; i < times; i++)
        g->call.vkCmdDispatch(g->commands, groups, 1, 1);
    g->call.vkCmdPipelineBarrier(g->commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1,
                                 &read, 0, NULL, 0, NULL);
    return do_commands(g, COMPUTE_SECONDS);
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

/* What is timed: the depths in a buffer, again and again. */
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
    if (!make_shader(&t->g, run->code, run->size) || !make_compute(&t->g, run, at, &t->pipeline))
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

/* ---- The back end ------------------------------------------------------------------------------------------------ */

static bool open_all(gpu *g, const char *wanted) {
    static const library loader = {"a GPU", {"libvulkan.so.1", NULL}, "libvulkan1", symbols};
    char unused[DYNLOAD_ERROR_SIZE];
    if (!dynload_open(&loader, g->call.all, unused))
        return fail(g, "the Vulkan loader, libvulkan.so.1, is not there: Debian's package libvulkan1 has it, and "
                       "mesa-vulkan-drivers has drivers");
    return list(g, wanted) && open_device(g);
}

bool shot_compute(const char *wanted, const compute_run *run, size_t runs, shot_machine *machine, FILE *out) {
    gpu g = {.machine = machine};
    VkPipeline pipeline;
    void *at[BINDINGS];
    if (!open_all(&g, wanted) || !make_commands(&g))
        return false;
    return runs > 0 ? time_all(&g, run, runs, out)
                    : make_shader(&g, run->code, run->size) && make_compute(&g, run, at, &pipeline) &&
                          compute(&g, run, at, pipeline, out);
}

bool shot_vulkan(const char *wanted, shot_plan *plan, shot_machine *machine) {
    gpu g = {.machine = machine};
    if (!open_all(&g, wanted) || !make_tools(&g))
        return false;
    const shot_device *device = &machine->device[machine->chosen];
    char name[SHOT_NAME_SIZE];
    for (int i = 0; i < SHOT_FORMATS; i++) {
        g.depth[i].format = format_of(&g, g.physical, (shot_format)i, name);
        if (device->has[i] && !make_depth(&g, &g.depth[i]))
            return false;
    }
    for (size_t i = 0; i < plan->count; i++)
        if (device->has[plan->shot[i].format] && !take_shot(&g, &plan->shot[i]))
            return false;
    return true;
}

#else

static const char absent[] = "this build has no Vulkan: build it where Debian's package libvulkan-dev is installed";

bool shot_vulkan(const char *wanted, shot_plan *plan, shot_machine *machine) {
    (void)wanted;
    (void)plan;
    snprintf(machine->error, sizeof machine->error, absent);
    return false;
}

bool shot_compute(const char *wanted, const compute_run *run, size_t runs, shot_machine *machine, FILE *out) {
    (void)wanted;
    (void)run;
    (void)runs;
    (void)out;
    snprintf(machine->error, sizeof machine->error, absent);
    return false;
}

#endif
