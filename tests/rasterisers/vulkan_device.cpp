#include "vulkan_device.hpp"

#include <cstring>
#include <stdexcept>
#include <vector>

namespace rasterisers {
namespace {

constexpr std::uint32_t kVersion = VK_API_VERSION_1_3;

/// A software device: a graphics card need not follow IEEE 754, on which the bounds rest.
VkPhysicalDevice softwareDevice(VkInstance instance) {
  std::uint32_t count = 0;
  if (vkEnumeratePhysicalDevices(instance, &count, nullptr) != VK_SUCCESS) return VK_NULL_HANDLE;
  std::vector<VkPhysicalDevice> devices(count);
  if (vkEnumeratePhysicalDevices(instance, &count, devices.data()) != VK_SUCCESS) return VK_NULL_HANDLE;
  for (VkPhysicalDevice device : devices) {
    VkPhysicalDeviceProperties properties;
    vkGetPhysicalDeviceProperties(device, &properties);
    if (properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU && properties.apiVersion >= kVersion) return device;
  }
  return VK_NULL_HANDLE;
}

bool hasExtension(VkPhysicalDevice device, const char* name) {
  std::uint32_t count = 0;
  require(vkEnumerateDeviceExtensionProperties(device, nullptr, &count, nullptr), "extensions");
  std::vector<VkExtensionProperties> extensions(count);
  require(vkEnumerateDeviceExtensionProperties(device, nullptr, &count, extensions.data()), "extensions");
  for (const VkExtensionProperties& e : extensions)
    if (std::strcmp(e.extensionName, name) == 0) return true;
  return false;
}

VkDeviceMemory allocate(const VkMemoryRequirements& needs, VkMemoryPropertyFlags flags) {
  VkPhysicalDeviceMemoryProperties memory;
  vkGetPhysicalDeviceMemoryProperties(theDevice().physical, &memory);
  for (std::uint32_t type = 0; type < memory.memoryTypeCount; ++type) {
    if (!(needs.memoryTypeBits >> type & 1) || (memory.memoryTypes[type].propertyFlags & flags) != flags) continue;
    VkMemoryAllocateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
    info.allocationSize = needs.size;
    info.memoryTypeIndex = type;
    VkDeviceMemory made;
    require(vkAllocateMemory(theDevice().device, &info, nullptr, &made), "memory");
    return made;
  }
  throw std::runtime_error("Vulkan has no memory of the kind");
}

}  // namespace

void require(VkResult result, const char* what) {
  if (result != VK_SUCCESS)
    throw std::runtime_error(std::string("Vulkan gives no ") + what + ": " + std::to_string(result));
}

Device::Device() {
  VkApplicationInfo application{};
  application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
  application.apiVersion = kVersion;
  VkInstanceCreateInfo instanceInfo{};
  instanceInfo.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
  instanceInfo.pApplicationInfo = &application;
  if (vkCreateInstance(&instanceInfo, nullptr, &instance) != VK_SUCCESS) {
    trouble = "there is no Vulkan driver";
    return;
  }
  physical = softwareDevice(instance);
  if (!physical) {
    trouble = "no Vulkan driver is a software rasteriser of version 1.3";
    return;
  }
  VkPhysicalDeviceProperties properties;
  vkGetPhysicalDeviceProperties(physical, &properties);
  name = properties.deviceName;
  minusOneToOne = hasExtension(physical, VK_EXT_DEPTH_CLIP_CONTROL_EXTENSION_NAME);

  const float priority = 1;
  VkDeviceQueueCreateInfo queueInfo{};
  queueInfo.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
  queueInfo.queueCount = 1;
  queueInfo.pQueuePriorities = &priority;
  VkPhysicalDeviceDepthClipControlFeaturesEXT clipControl{};
  clipControl.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DEPTH_CLIP_CONTROL_FEATURES_EXT;
  clipControl.depthClipControl = VK_TRUE;
  VkPhysicalDeviceVulkan13Features features{};
  features.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES;
  features.dynamicRendering = VK_TRUE;
  features.synchronization2 = VK_TRUE;
  if (minusOneToOne) features.pNext = &clipControl;
  const char* extension = VK_EXT_DEPTH_CLIP_CONTROL_EXTENSION_NAME;
  VkDeviceCreateInfo deviceInfo{};
  deviceInfo.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
  deviceInfo.pNext = &features;
  deviceInfo.queueCreateInfoCount = 1;
  deviceInfo.pQueueCreateInfos = &queueInfo;
  deviceInfo.enabledExtensionCount = minusOneToOne ? 1 : 0;
  deviceInfo.ppEnabledExtensionNames = &extension;
  require(vkCreateDevice(physical, &deviceInfo, nullptr, &device), "a device");
  vkGetDeviceQueue(device, 0, 0, &queue);
  VkCommandPoolCreateInfo poolInfo{};
  poolInfo.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
  require(vkCreateCommandPool(device, &poolInfo, nullptr, &pool), "a command pool");
}

// The instance stays, and the driver with it: a leak checker would miss who owns what an unloaded one has allocated.
Device::~Device() {
  if (!device) return;
  vkDestroyCommandPool(device, pool, nullptr);
  vkDestroyDevice(device, nullptr);
}

const Device& theDevice() {
  static const Device made;
  return made;
}

Buffer::Buffer(VkDeviceSize size, VkBufferUsageFlags usage) {
  const VkDevice device = theDevice().device;
  VkBufferCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
  info.size = size;
  info.usage = usage;
  require(vkCreateBuffer(device, &info, nullptr, &buffer), "buffer");
  VkMemoryRequirements needs;
  vkGetBufferMemoryRequirements(device, buffer, &needs);
  memory = allocate(needs, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
  require(vkBindBufferMemory(device, buffer, memory, 0), "buffer memory");
  require(vkMapMemory(device, memory, 0, VK_WHOLE_SIZE, 0, &data), "mapped memory");
}

Buffer::~Buffer() {
  vkDestroyBuffer(theDevice().device, buffer, nullptr);
  vkFreeMemory(theDevice().device, memory, nullptr);
}

Image::Image(VkExtent2D size, VkFormat format, VkImageUsageFlags usage, VkImageAspectFlags seen) : aspect(seen) {
  const VkDevice device = theDevice().device;
  VkImageCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
  info.imageType = VK_IMAGE_TYPE_2D;
  info.format = format;
  info.extent = {size.width, size.height, 1};
  info.mipLevels = 1;
  info.arrayLayers = 1;
  info.samples = VK_SAMPLE_COUNT_1_BIT;
  info.usage = usage | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
  require(vkCreateImage(device, &info, nullptr, &image), "image");
  VkMemoryRequirements needs;
  vkGetImageMemoryRequirements(device, image, &needs);
  memory = allocate(needs, 0);
  require(vkBindImageMemory(device, image, memory, 0), "image memory");
  VkImageViewCreateInfo viewInfo{};
  viewInfo.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
  viewInfo.image = image;
  viewInfo.viewType = VK_IMAGE_VIEW_TYPE_2D;
  viewInfo.format = format;
  viewInfo.subresourceRange = {aspect, 0, 1, 0, 1};
  require(vkCreateImageView(device, &viewInfo, nullptr, &view), "image view");
}

Image::~Image() {
  vkDestroyImageView(theDevice().device, view, nullptr);
  vkDestroyImage(theDevice().device, image, nullptr);
  vkFreeMemory(theDevice().device, memory, nullptr);
}

}  // namespace rasterisers
