// Vulkan without a window, on Mesa's software rasteriser.
#include <cstdint>
#include <cstring>
#include <map>
#include <tuple>

#include "points_column_major.spv.hpp"
#include "points_fragment.spv.hpp"
#include "points_row_major.spv.hpp"
#include "points_row_vectors.spv.hpp"
#include "rasteriser.hpp"
#include "vulkan_device.hpp"

namespace rasterisers {
namespace {

constexpr VkFormat kIdFormat = VK_FORMAT_R32_UINT;

VkFormat depthFormat(DepthFormat format) {
  if (format == DepthFormat::f32) return VK_FORMAT_D32_SFLOAT;
  return format == DepthFormat::d24 ? VK_FORMAT_X8_D24_UNORM_PACK32 : VK_FORMAT_D16_UNORM;
}

template <std::size_t Size>
VkShaderModule shader(const std::uint32_t (&code)[Size]) {
  VkShaderModuleCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
  info.codeSize = sizeof code;
  info.pCode = code;
  VkShaderModule made;
  require(vkCreateShaderModule(theDevice().device, &info, nullptr, &made), "shader");
  return made;
}

VkShaderModule vertexShader(bool rowVectors, bool rowMajor) {
  if (rowVectors) return shader(kPointsRowVectors);
  return rowMajor ? shader(kPointsRowMajor) : shader(kPointsColumnMajor);
}

VkPipelineLayout makeLayout() {
  const VkPushConstantRange matrices{VK_SHADER_STAGE_VERTEX_BIT, 0, 2 * sizeof(Matrix)};
  VkPipelineLayoutCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
  info.pushConstantRangeCount = 1;
  info.pPushConstantRanges = &matrices;
  VkPipelineLayout made;
  require(vkCreatePipelineLayout(theDevice().device, &info, nullptr, &made), "pipeline layout");
  return made;
}

VkPipeline makePipeline(const Draw& draw, VkPipelineLayout layout) {
  VkPipelineShaderStageCreateInfo stages[2] = {};
  for (VkPipelineShaderStageCreateInfo& stage : stages) {
    stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    stage.pName = "main";
  }
  stages[0].stage = VK_SHADER_STAGE_VERTEX_BIT;
  stages[0].module = vertexShader(draw.rowVectors, draw.rowMajor);
  stages[1].stage = VK_SHADER_STAGE_FRAGMENT_BIT;
  stages[1].module = shader(kPointsFragment);

  const VkVertexInputBindingDescription binding{0, sizeof(Vertex), VK_VERTEX_INPUT_RATE_VERTEX};
  const VkVertexInputAttributeDescription position{0, 0, VK_FORMAT_R32G32B32_SFLOAT, 0};
  VkPipelineVertexInputStateCreateInfo input{};
  input.sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO;
  input.vertexBindingDescriptionCount = 1;
  input.pVertexBindingDescriptions = &binding;
  input.vertexAttributeDescriptionCount = 1;
  input.pVertexAttributeDescriptions = &position;
  VkPipelineInputAssemblyStateCreateInfo assembly{};
  assembly.sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO;
  assembly.topology = VK_PRIMITIVE_TOPOLOGY_POINT_LIST;

  VkPipelineViewportDepthClipControlCreateInfoEXT clipControl{};
  clipControl.sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_DEPTH_CLIP_CONTROL_CREATE_INFO_EXT;
  clipControl.negativeOneToOne = VK_TRUE;
  VkPipelineViewportStateCreateInfo viewport{};
  viewport.sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO;
  viewport.pNext = draw.zeroToOne ? nullptr : &clipControl;
  viewport.viewportCount = 1;
  viewport.scissorCount = 1;
  VkPipelineRasterizationStateCreateInfo rasterization{};
  rasterization.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO;
  rasterization.lineWidth = 1;
  VkPipelineMultisampleStateCreateInfo samples{};
  samples.sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO;
  samples.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
  VkPipelineDepthStencilStateCreateInfo depth{};
  depth.sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO;
  depth.depthTestEnable = VK_TRUE;
  depth.depthWriteEnable = VK_TRUE;
  depth.depthCompareOp = VK_COMPARE_OP_ALWAYS;
  VkPipelineColorBlendAttachmentState red{};
  red.colorWriteMask = VK_COLOR_COMPONENT_R_BIT;
  VkPipelineColorBlendStateCreateInfo blend{};
  blend.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO;
  blend.attachmentCount = 1;
  blend.pAttachments = &red;
  const VkDynamicState dynamicStates[] = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
  VkPipelineDynamicStateCreateInfo dynamic{};
  dynamic.sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO;
  dynamic.dynamicStateCount = 2;
  dynamic.pDynamicStates = dynamicStates;
  VkPipelineRenderingCreateInfo rendering{};
  rendering.sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO;
  rendering.colorAttachmentCount = 1;
  rendering.pColorAttachmentFormats = &kIdFormat;
  rendering.depthAttachmentFormat = depthFormat(draw.format);

  VkGraphicsPipelineCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO;
  info.pNext = &rendering;
  info.stageCount = 2;
  info.pStages = stages;
  info.pVertexInputState = &input;
  info.pInputAssemblyState = &assembly;
  info.pViewportState = &viewport;
  info.pRasterizationState = &rasterization;
  info.pMultisampleState = &samples;
  info.pDepthStencilState = &depth;
  info.pColorBlendState = &blend;
  info.pDynamicState = &dynamic;
  info.layout = layout;
  VkPipeline made;
  require(vkCreateGraphicsPipelines(theDevice().device, VK_NULL_HANDLE, 1, &info, nullptr, &made), "pipeline");
  for (const VkPipelineShaderStageCreateInfo& stage : stages)
    vkDestroyShaderModule(theDevice().device, stage.module, nullptr);
  return made;
}

/// One pipeline of each kind, made when first asked for.
struct Pipelines {
  VkPipelineLayout layout = makeLayout();
  std::map<std::tuple<bool, bool, bool, DepthFormat>, VkPipeline> made;

  Pipelines() = default;
  ~Pipelines() {
    for (const auto& entry : made) vkDestroyPipeline(theDevice().device, entry.second, nullptr);
    vkDestroyPipelineLayout(theDevice().device, layout, nullptr);
  }
  Pipelines(const Pipelines&) = delete;
  Pipelines& operator=(const Pipelines&) = delete;

  VkPipeline of(const Draw& draw) {
    VkPipeline& p = made[{draw.rowVectors, draw.rowMajor, draw.zeroToOne, draw.format}];
    if (!p) p = makePipeline(draw, layout);
    return p;
  }
};

Pipelines& pipelines() {
  static Pipelines all;
  return all;
}

void transition(VkCommandBuffer commands, const Image& image, VkImageLayout from, VkImageLayout to) {
  VkImageMemoryBarrier2 barrier{};
  barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2;
  barrier.srcStageMask = barrier.dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  barrier.srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT;
  barrier.dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;
  barrier.oldLayout = from;
  barrier.newLayout = to;
  barrier.image = image.image;
  barrier.subresourceRange = {image.aspect, 0, 1, 0, 1};
  VkDependencyInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
  info.imageMemoryBarrierCount = 1;
  info.pImageMemoryBarriers = &barrier;
  vkCmdPipelineBarrier2(commands, &info);
}

VkRenderingAttachmentInfo attachment(const Image& image) {
  VkRenderingAttachmentInfo info{};
  info.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO;
  info.imageView = image.view;
  info.imageLayout = VK_IMAGE_LAYOUT_ATTACHMENT_OPTIMAL;
  info.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;  // to all zero
  info.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
  return info;
}

void readBack(VkCommandBuffer commands, const Image& image, const Buffer& buffer, VkExtent2D size) {
  transition(commands, image, VK_IMAGE_LAYOUT_ATTACHMENT_OPTIMAL, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
  VkBufferImageCopy region{};
  region.imageSubresource = {image.aspect, 0, 0, 1};
  region.imageExtent = {size.width, size.height, 1};
  vkCmdCopyImageToBuffer(commands, image.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, buffer.buffer, 1, &region);
}

/// What was copied may be read by the host.
void showHost(VkCommandBuffer commands) {
  VkMemoryBarrier2 barrier{};
  barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2;
  barrier.srcStageMask = VK_PIPELINE_STAGE_2_COPY_BIT;
  barrier.srcAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT;
  barrier.dstStageMask = VK_PIPELINE_STAGE_2_HOST_BIT;
  barrier.dstAccessMask = VK_ACCESS_2_HOST_READ_BIT;
  VkDependencyInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
  info.memoryBarrierCount = 1;
  info.pMemoryBarriers = &barrier;
  vkCmdPipelineBarrier2(commands, &info);
}

void drawPoints(VkCommandBuffer commands, const Draw& draw, const Image& ids, const Image& depths,
                const Buffer& vertices) {
  const VkExtent2D size{static_cast<std::uint32_t>(draw.width), static_cast<std::uint32_t>(draw.height)};
  const VkRenderingAttachmentInfo idsInfo = attachment(ids), depthsInfo = attachment(depths);
  VkRenderingInfo rendering{};
  rendering.sType = VK_STRUCTURE_TYPE_RENDERING_INFO;
  rendering.renderArea = {{0, 0}, size};
  rendering.layerCount = 1;
  rendering.colorAttachmentCount = 1;
  rendering.pColorAttachments = &idsInfo;
  rendering.pDepthAttachment = &depthsInfo;
  vkCmdBeginRendering(commands, &rendering);
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines().of(draw));
  const double bottom = draw.y + draw.viewportHeight;
  const VkViewport viewport{static_cast<float>(draw.x),
                            static_cast<float>(draw.mirrored ? bottom : draw.y),
                            static_cast<float>(draw.viewportWidth),
                            static_cast<float>(draw.mirrored ? -draw.viewportHeight : draw.viewportHeight),
                            static_cast<float>(draw.depthRange[0]),
                            static_cast<float>(draw.depthRange[1])};
  vkCmdSetViewport(commands, 0, 1, &viewport);
  vkCmdSetScissor(commands, 0, 1, &rendering.renderArea);
  const Matrix matrices[] = {draw.view, draw.projection};
  vkCmdPushConstants(commands, pipelines().layout, VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof matrices, matrices);
  const VkDeviceSize start = 0;
  vkCmdBindVertexBuffers(commands, 0, 1, &vertices.buffer, &start);
  vkCmdDraw(commands, static_cast<std::uint32_t>(draw.points.size()), 1, 0, 0);
  vkCmdEndRendering(commands);
}

void submit(VkCommandBuffer commands) {
  VkSubmitInfo info{};
  info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
  info.commandBufferCount = 1;
  info.pCommandBuffers = &commands;
  require(vkQueueSubmit(theDevice().queue, 1, &info, VK_NULL_HANDLE), "queue");
  require(vkQueueWaitIdle(theDevice().queue), "end of the work");
}

/// The buffer's own numbers.
double depthAt(const void* data, std::size_t index, DepthFormat format) {
  if (format == DepthFormat::f32) return static_cast<double>(static_cast<const float*>(data)[index]);
  if (format == DepthFormat::d24) return (static_cast<const std::uint32_t*>(data)[index] & 0xffffff) / 16777215.0;
  return static_cast<const std::uint16_t*>(data)[index] / 65535.0;
}

}  // namespace

std::string driver() { return "Vulkan, " + theDevice().name; }

std::string unavailable() { return theDevice().trouble; }

bool drawsMinusOneToOne() { return theDevice().minusOneToOne; }

Picture render(const Draw& draw) {
  const VkExtent2D size{static_cast<std::uint32_t>(draw.width), static_cast<std::uint32_t>(draw.height)};
  const std::size_t pixels = std::size_t{size.width} * size.height;
  const Image ids(size, kIdFormat, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT, VK_IMAGE_ASPECT_COLOR_BIT);
  const Image depths(size, depthFormat(draw.format), VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT,
                     VK_IMAGE_ASPECT_DEPTH_BIT);
  const Buffer idData(4 * pixels, VK_BUFFER_USAGE_TRANSFER_DST_BIT),
      depthData(4 * pixels, VK_BUFFER_USAGE_TRANSFER_DST_BIT);
  const Buffer vertices(draw.points.size() * sizeof(Vertex) + 1, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
  if (!draw.points.empty()) std::memcpy(vertices.data, draw.points.data(), draw.points.size() * sizeof(Vertex));

  const Device& d = theDevice();
  VkCommandBufferAllocateInfo allocation{};
  allocation.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
  allocation.commandPool = d.pool;
  allocation.commandBufferCount = 1;
  VkCommandBuffer commands;
  require(vkAllocateCommandBuffers(d.device, &allocation, &commands), "command buffer");
  VkCommandBufferBeginInfo begin{};
  begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
  require(vkBeginCommandBuffer(commands, &begin), "command buffer");
  for (const Image* image : {&ids, &depths})
    transition(commands, *image, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_ATTACHMENT_OPTIMAL);
  drawPoints(commands, draw, ids, depths, vertices);
  readBack(commands, ids, idData, size);
  readBack(commands, depths, depthData, size);
  showHost(commands);
  require(vkEndCommandBuffer(commands), "command buffer");
  submit(commands);
  vkFreeCommandBuffers(d.device, d.pool, 1, &commands);

  Picture picture;
  picture.ids.resize(pixels);
  std::memcpy(picture.ids.data(), idData.data, 4 * pixels);
  for (std::size_t i = 0; i < pixels; ++i) picture.depths.push_back(depthAt(depthData.data, i, draw.format));
  return picture;
}

}  // namespace rasterisers
