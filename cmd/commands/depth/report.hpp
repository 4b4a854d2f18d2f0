// What a depth buffer resolves, as a table or JSON.
#pragma once

#include <string>
#include <vector>

#include "commands/depth/depth_buffer.hpp"

namespace viewproj::cmd {

struct NamedMapping {
  std::string name;
  DepthMapping mapping;
  bool own = false;       ///< the camera's
  bool reversed = false;  ///< near has the greatest NDC z
};

struct NamedFormat {
  std::string name;
  DepthFormat format;
};

/// Everything that is asked; the answers are computed as they are written.
struct DepthReport {
  std::vector<NamedMapping> mappings;
  std::vector<NamedFormat> formats;
  std::vector<double> distances;
  std::vector<std::string> notes;

  const DepthMapping& own() const;
};

/// Depths to distances: of window depths, and of NDC z from -1 to 1.
struct DepthsReport {
  std::vector<NamedMapping> mappings;
  std::vector<double> depths;
};

std::string distancesAsTable(const DepthsReport& report);
std::string distancesAsJson(const DepthsReport& report);

std::string depthAsTable(const DepthReport& report);
std::string depthAsJson(const DepthReport& report);

}  // namespace viewproj::cmd
