// A Vulkan 1.3 device without a window, and the memory on it.
#pragma once

#include <vulkan/vulkan.h>

#include <string>

namespace rasterisers {

/// Throws where Vulkan did not succeed.
void require(VkResult result, const char* what);

struct Device {
  std::string trouble;  ///< why there is none; empty where there is one
  std::string name;
  bool minusOneToOne = false;  ///< VK_EXT_depth_clip_control
  VkInstance instance = VK_NULL_HANDLE;
  VkPhysicalDevice physical = VK_NULL_HANDLE;
  VkDevice device = VK_NULL_HANDLE;
  VkQueue queue = VK_NULL_HANDLE;
  VkCommandPool pool = VK_NULL_HANDLE;

  Device();
  ~Device();
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;
};

/// The one device, made on the first call.
const Device& theDevice();

struct Buffer {
  VkBuffer buffer = VK_NULL_HANDLE;
  VkDeviceMemory memory = VK_NULL_HANDLE;
  void* data = nullptr;  ///< mapped, coherent

  Buffer(VkDeviceSize size, VkBufferUsageFlags usage);
  ~Buffer();
  Buffer(const Buffer&) = delete;
  Buffer& operator=(const Buffer&) = delete;
};

struct Image {
  VkImage image = VK_NULL_HANDLE;
  VkDeviceMemory memory = VK_NULL_HANDLE;
  VkImageView view = VK_NULL_HANDLE;
  VkImageAspectFlags aspect = 0;

  Image(VkExtent2D size, VkFormat format, VkImageUsageFlags usage, VkImageAspectFlags aspect);
  ~Image();
  Image(const Image&) = delete;
  Image& operator=(const Image&) = delete;
};

}  // namespace rasterisers
