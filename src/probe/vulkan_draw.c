/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shots: what the depth buffers of a device hold of what is drawn. */
#include "probe/vulkan.h"

#ifdef PROBE_VULKAN

#include <string.h>

#include "probe/spirv.h"

enum { WAIT_SECONDS = 20 };

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

bool shot_vulkan(const char *wanted, shot_plan *plan, shot_machine *machine) {
    gpu g = {.machine = machine};
    if (!vulkan_open(&g, wanted) || !make_tools(&g))
        return false;
    const shot_device *device = &machine->device[machine->chosen];
    char name[SHOT_NAME_SIZE];
    for (int i = 0; i < SHOT_FORMATS; i++) {
        g.depth[i].format = vulkan_format(&g, g.physical, (shot_format)i, name);
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
