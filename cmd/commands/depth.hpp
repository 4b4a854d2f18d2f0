// viewproj depth: what a depth buffer resolves.
#pragma once

#include <span>
#include <vector>

#include "output/report.hpp"
#include "viewproj/camera.hpp"

namespace viewproj::cmd {

/// How a camera maps distance along the view to window depth.
struct DepthMapping {
  Projection projection;
  double atNear = 0, atFar = 1;  ///< window depths, not negative
  NdcZ ndcZ = NdcZ::zeroToOne;
};

/// Of each distance its depth, the depth's change per unit of distance, and what d16, d24 and f32 resolve there: how
/// much nearer than a surface at this distance another must be to be stored apart from it for certain.
OrderedJson depthReport(const DepthMapping& mapping, std::span<const double> distances);

/// The distance of each depth; throws UsageError for one that no buffer of the range holds.
OrderedJson distanceReport(const DepthMapping& mapping, std::span<const double> depths);

/// Of each distance the nearest near plane with which each buffer resolves the gap; perspective. Throws UsageError for
/// a distance beyond far.
OrderedJson nearReport(const DepthMapping& mapping, double gap, std::span<const double> distances);

/// Decades from near to far, or for 1e8 near distances where far is infinite, with 2 and 5 between them in a short
/// range; orthographic: tenths of the range.
std::vector<double> usualDistances(const Projection& projection);

}  // namespace viewproj::cmd
