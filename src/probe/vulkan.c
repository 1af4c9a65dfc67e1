/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Vulkan without a window. All of it runs in a process that ends when it is done, so nothing is given back, and a
 * driver that breaks down or hangs takes nobody with it.
 */
#define _GNU_SOURCE /* strcasestr() */
#include "probe/vulkan.h"

#ifdef PROBE_VULKAN

#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "probe/spirv.h"

enum { WAIT_SECONDS = 20 };

bool vulkan_fail(gpu *g, const char *what) {
    snprintf(g->machine->error, sizeof g->machine->error, "%s", what);
    return false;
}

/* Whether a result is success; else notes its meaning in a sentence. */
bool vulkan_good(gpu *g, VkResult result, const char *what) {
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
            return vulkan_fail(g, known[i].text);
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
        return vulkan_fail(g, "no device has that name or number");
    g->physical = physical[m->chosen];
    return true;
}

static bool list(gpu *g, const char *wanted) {
    const VkApplicationInfo about = {
        .sType = VK_STRUCTURE_TYPE_APPLICATION_INFO, .pApplicationName = "depthprec", .apiVersion = VK_API_VERSION_1_2};
    const VkInstanceCreateInfo wish = {.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO, .pApplicationInfo = &about};
    VkPhysicalDevice physical[SHOT_DEVICES_MAX];
    uint32_t count = SHOT_DEVICES_MAX;
    if (!vulkan_good(g, g->call.vkCreateInstance(&wish, NULL, &g->instance), "an instance"))
        return false;
    const VkResult result = g->call.vkEnumeratePhysicalDevices(g->instance, &count, physical);
    if (!vulkan_good(g, result == VK_INCOMPLETE ? VK_SUCCESS : result, "its devices"))
        return false;
    if (count == 0)
        return vulkan_good(g, VK_ERROR_INCOMPATIBLE_DRIVER, "");
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
    return vulkan_fail(g, "the device draws nothing");
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
    if (!vulkan_good(g, g->call.vkCreateDevice(g->physical, &wish, NULL, &g->device), "the device"))
        return false;
    g->call.vkGetDeviceQueue(g->device, g->family, 0, &g->queue);
    return true;
}

static bool vulkan_allocate(gpu *g, const VkMemoryRequirements *need, VkMemoryPropertyFlags flags,
                            VkDeviceMemory *out) {
    for (uint32_t i = 0; i < g->memory.memoryTypeCount; i++) {
        const VkMemoryAllocateInfo wish = {
            .sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, .allocationSize = need->size, .memoryTypeIndex = i};
        if ((need->memoryTypeBits >> i & 1U) != 0 && (g->memory.memoryTypes[i].propertyFlags & flags) == flags)
            return vulkan_good(g, g->call.vkAllocateMemory(g->device, &wish, NULL, out), "memory");
    }
    return vulkan_good(g, VK_ERROR_OUT_OF_DEVICE_MEMORY, "");
}

bool vulkan_make_buffer(gpu *g, VkBufferUsageFlags usage, VkBuffer *out, void **at) {
    const VkBufferCreateInfo wish = {
        .sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO, .size = BUFFER_BYTES, .usage = usage};
    VkMemoryRequirements need;
    VkDeviceMemory memory;
    if (!vulkan_good(g, g->call.vkCreateBuffer(g->device, &wish, NULL, out), "a buffer"))
        return false;
    g->call.vkGetBufferMemoryRequirements(g->device, *out, &need);
    return vulkan_allocate(g, &need, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT,
                           &memory) &&
           vulkan_good(g, g->call.vkBindBufferMemory(g->device, *out, memory, 0), "memory of a buffer") &&
           vulkan_good(g, g->call.vkMapMemory(g->device, memory, 0, VK_WHOLE_SIZE, 0, at), "mapped memory");
}

bool vulkan_make_shader(gpu *g, const uint32_t *code, size_t size) {
    const VkShaderModuleCreateInfo shader = {
        .sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO, .codeSize = size, .pCode = code};
    return vulkan_good(g, g->call.vkCreateShaderModule(g->device, &shader, NULL, &g->shader), "the shader");
}

bool vulkan_make_commands(gpu *g) {
    const VkCommandPoolCreateInfo commands = {.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                              .flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT,
                                              .queueFamilyIndex = g->family};
    const VkFenceCreateInfo fence = {.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
    VkCommandPool pool = VK_NULL_HANDLE;
    if (!vulkan_good(g, g->call.vkCreateCommandPool(g->device, &commands, NULL, &pool), "a pool of commands"))
        return false;
    const VkCommandBufferAllocateInfo one = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                             .commandPool = pool,
                                             .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                                             .commandBufferCount = 1};
    return vulkan_good(g, g->call.vkAllocateCommandBuffers(g->device, &one, &g->commands), "a buffer of commands") &&
           vulkan_good(g, g->call.vkCreateFence(g->device, &fence, NULL, &g->fence), "a fence");
}

static bool make_tools(gpu *g) {
    const VkPushConstantRange range = {VK_SHADER_STAGE_VERTEX_BIT, 0, 2 * sizeof(float)};
    const VkPipelineLayoutCreateInfo layout = {.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                               .pushConstantRangeCount = 1,
                                               .pPushConstantRanges = &range};
    const VkQueryPoolCreateInfo query = {
        .sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO, .queryType = VK_QUERY_TYPE_OCCLUSION, .queryCount = 1};
    return vulkan_make_commands(g) && vulkan_make_shader(g, probe_spirv, sizeof probe_spirv) &&
           vulkan_good(g, g->call.vkCreatePipelineLayout(g->device, &layout, NULL, &g->layout), "the layout") &&
           vulkan_good(g, g->call.vkCreateQueryPool(g->device, &query, NULL, &g->query), "a query") &&
           vulkan_make_buffer(g, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, &g->vertices, &g->at_vertices) &&
           vulkan_make_buffer(g, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, &g->seconds, &g->at_seconds) &&
           vulkan_make_buffer(g, VK_BUFFER_USAGE_TRANSFER_DST_BIT, &g->codes, &g->at_codes);
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
    if (!vulkan_good(g, g->call.vkCreateImage(g->device, &wish, NULL, &d->image), "a depth buffer"))
        return false;
    g->call.vkGetImageMemoryRequirements(g->device, d->image, &need);
    if (!vulkan_allocate(g, &need, 0, &memory) ||
        !vulkan_good(g, g->call.vkBindImageMemory(g->device, d->image, memory, 0), "memory of a depth buffer"))
        return false;
    const VkImageViewCreateInfo seen = {.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
                                        .image = d->image,
                                        .viewType = VK_IMAGE_VIEW_TYPE_2D,
                                        .format = d->format,
                                        .subresourceRange = {VK_IMAGE_ASPECT_DEPTH_BIT, 0, 1, 0, 1}};
    return vulkan_good(g, g->call.vkCreateImageView(g->device, &seen, NULL, view), "a view of a depth buffer");
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
    if (!make_image(g, d, &view) ||
        !vulkan_good(g, g->call.vkCreateRenderPass(g->device, &pass, NULL, &d->pass), "a pass"))
        return false;
    const VkFramebufferCreateInfo frame = {.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO,
                                           .renderPass = d->pass,
                                           .attachmentCount = 1,
                                           .pAttachments = &view,
                                           .width = SHOT_SIZE,
                                           .height = SHOT_SIZE,
                                           .layers = 1};
    return vulkan_good(g, g->call.vkCreateFramebuffer(g->device, &frame, NULL, &d->frame), "a frame");
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
    const VkViewport view = {0.0F, 0.0F, SHOT_SIZE, SHOT_SIZE, s->range[0], shot_range_end(s)};
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
    return vulkan_good(g, g->call.vkCreateGraphicsPipelines(g->device, VK_NULL_HANDLE, 1, &wish, NULL, out),
                       "a pipeline");
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

/* Copies the codes; with 24 bits the upper 8 of a word mean nothing. */
static void take_codes(const gpu *g, shot *s) {
    const uint16_t *narrow = g->at_codes;
    const uint32_t *wide = g->at_codes;
    for (int i = 0; i < SHOT_PIXELS; i++)
        s->code[i] = s->format == SHOT_D16 ? narrow[i] : s->format == SHOT_D24 ? wide[i] & 0xFFFFFFU : wide[i];
}

bool vulkan_begin_commands(gpu *g) {
    const VkCommandBufferBeginInfo begin = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                            .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT};
    return vulkan_good(g, g->call.vkBeginCommandBuffer(g->commands, &begin), "commands");
}

bool vulkan_do_commands(gpu *g, uint64_t seconds) {
    const VkSubmitInfo submit = {
        .sType = VK_STRUCTURE_TYPE_SUBMIT_INFO, .commandBufferCount = 1, .pCommandBuffers = &g->commands};
    return vulkan_good(g, g->call.vkEndCommandBuffer(g->commands), "commands") &&
           vulkan_good(g, g->call.vkResetFences(g->device, 1, &g->fence), "a fence") &&
           vulkan_good(g, g->call.vkQueueSubmit(g->queue, 1, &submit, g->fence), "commands") &&
           vulkan_good(g, g->call.vkWaitForFences(g->device, 1, &g->fence, VK_TRUE, seconds * 1000000000ULL),
                       "to wait");
}

static bool take_shot(gpu *g, shot *s) {
    VkPipeline pipeline[2] = {VK_NULL_HANDLE, VK_NULL_HANDLE};
    memcpy(g->at_vertices, s->vertex, s->count * sizeof *s->vertex);
    if (s->again)
        memcpy(g->at_seconds, s->second, s->count * sizeof *s->second);
    if (!make_pipeline(g, s, false, &pipeline[0]) || (s->again && !make_pipeline(g, s, true, &pipeline[1])) ||
        !vulkan_begin_commands(g))
        return false;
    draw_pass(g, s, pipeline);
    if (!vulkan_do_commands(g, WAIT_SECONDS))
        return false;
    if (s->again &&
        !vulkan_good(g,
                     g->call.vkGetQueryPoolResults(g->device, g->query, 0, 1, sizeof s->passed, &s->passed,
                                                   sizeof s->passed, VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
                     "the result of a query"))
        return false;
    take_codes(g, s);
    s->drawn = true;
    return true;
}

/* ---- The back end ------------------------------------------------------------------------------------------------ */

bool vulkan_open(gpu *g, const char *wanted) {
    static const char *const symbols[] = {FUNCTIONS(DYNLOAD_NAME) NULL};
    static const library loader = {"a GPU", {"libvulkan.so.1", NULL}, "libvulkan1", symbols};
    char unused[DYNLOAD_ERROR_SIZE];
    if (!dynload_open(&loader, g->call.all, unused))
        return vulkan_fail(g,
                           "the Vulkan loader, libvulkan.so.1, is not there: Debian's package libvulkan1 has it, and "
                           "mesa-vulkan-drivers has drivers");
    return list(g, wanted) && open_device(g);
}

bool shot_vulkan(const char *wanted, shot_plan *plan, shot_machine *machine) {
    gpu g = {.machine = machine};
    if (!vulkan_open(&g, wanted) || !make_tools(&g))
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

bool shot_vulkan(const char *wanted, shot_plan *plan, shot_machine *machine) {
    (void)wanted;
    (void)plan;
    snprintf(machine->error, sizeof machine->error, PROBE_ABSENT);
    return false;
}

#endif
