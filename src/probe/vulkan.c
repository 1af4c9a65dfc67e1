/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Vulkan without a window. All of it runs in a process that ends when it is done, so nothing is given back, and a
 * driver that breaks down or hangs takes nobody with it.
 */
#define _GNU_SOURCE 1 /* strcasestr() */
#include "probe/vulkan.h"

#ifdef PROBE_VULKAN

#include <stdlib.h>
#include <string.h>
#include <strings.h>

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

VkFormat vulkan_format(const gpu *g, VkPhysicalDevice physical, shot_format asked, char name[SHOT_NAME_SIZE]) {
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
        out->has[i] = vulkan_format(g, physical, (shot_format)i, out->format[i]) != VK_FORMAT_UNDEFINED;
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

bool vulkan_allocate(gpu *g, const VkMemoryRequirements *need, VkMemoryPropertyFlags flags, VkDeviceMemory *out) {
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

#endif
