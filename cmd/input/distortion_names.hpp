// What files call the distortion of a lens.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace viewproj::cmd {

/// Coefficients of Brown's model, one by one.
inline constexpr std::string_view kCoefficientNames[] = {"k1", "k2", "k3", "k4", "k5", "k6", "p1", "p2"};

/// Names of arrays of coefficients, without underscores and in small letters.
inline constexpr std::string_view kDistortionArrays[] = {"dist",
                                                         "distcoeff",
                                                         "distcoeffs",
                                                         "distcoef",
                                                         "distcoefs",
                                                         "distortion",
                                                         "coeffs",
                                                         "distortioncoefs",
                                                         "distortioncoeffs",
                                                         "distortioncoefficients",
                                                         "d",

                                                         "distortionparams",
                                                         "radialdistortion",
                                                         "distortionparameters",
                                                         "lensdistortion",
                                                         "distparams",
                                                         "tangentialdistortion",
                                                         "distortioncoefficient",
                                                         "distortions",
                                                         "radial",
                                                         "kc",
                                                         "kd",
                                                         "k",
                                                         "distortionvector",
                                                         "distortionk",
                                                         "cameradistortion",
                                                         "cameradistortioncoeffs",
                                                         "camdistortion",
                                                         "distvec"};

/// Flags of what is no picture on a plane, or how their names begin.
inline constexpr std::string_view kNoPlaneFlags[] = {"latlong", "equirectangular", "fisheye", "isfisheye",
                                                     "fisheyemodel"};
inline constexpr std::string_view kNoPlaneBegin = "ftheta";

/// Names of fields that say which model a lens is of, and what such a text holds of those without a picture plane;
/// without underscores, hyphens and blanks, in small letters.
inline constexpr std::string_view kLensModels[] = {
    "model", "cameramodel",     "lensmodel",       "type",           "cameratype",
    "lens",  "projectionmodel", "distortionmodel", "projectiontype", "projection"};
inline constexpr std::string_view kNoPlaneModels[] = {"fisheye", "equidistant",  "kannala",   "omni",
                                                      "eucm",    "doublesphere", "scaramuzza"};

template <class Names>
bool isAmong(const Names& names, std::string_view name) {
  return std::find(std::begin(names), std::end(names), name) != std::end(names);
}

/// Small letters and digits alone.
inline std::string plainName(std::string_view name) {
  std::string plain;
  for (const char c : name)
    if (c != '_' && c != '-' && c != ' ') plain += static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
  return plain;
}

/// Texts that say that there is none.
inline bool saysNone(std::string_view text) {
  constexpr std::string_view kNone[] = {"", "none", "no", "false"};
  return isAmong(kNone, plainName(text));
}

/// Whether a lens of that model has no picture plane. OmniVision makes sensors.
inline bool isNoPlaneModel(std::string_view model) {
  const std::string plain = plainName(model);
  return std::any_of(std::begin(kNoPlaneModels), std::end(kNoPlaneModels), [&](std::string_view part) {
    for (std::size_t at = plain.find(part); at != std::string::npos; at = plain.find(part, at + 1))
      if (plain.compare(at, 10, "omnivision") != 0) return true;
    return false;
  });
}

/// Which of kCoefficientNames a name is, in any case and with what stands before them: k1, K1, dist_k1, kappa1.
inline std::optional<std::size_t> coefficientIndex(std::string_view name) {
  std::string plain = plainName(name);
  for (const std::string_view before : {"distortion", "dist", "radial", "tangential", "lens"})
    if (plain.starts_with(before)) plain.erase(0, before.size());
  if (plain.starts_with("kappa")) plain.replace(0, 5, "k");
  const auto at = std::find(std::begin(kCoefficientNames), std::end(kCoefficientNames), plain);
  if (at == std::end(kCoefficientNames)) return std::nullopt;
  return static_cast<std::size_t>(at - std::begin(kCoefficientNames));
}

enum class DistortionName { none, coefficient, array, flag };

/// Without what says whose it is in a file of several: dist of dist_1, D of D_left.
inline std::string_view withoutOwner(std::string_view plain) {
  for (const std::string_view side : {"left", "right"})
    if (plain.ends_with(side)) plain.remove_suffix(side.size());
  while (!plain.empty() && plain.back() >= '0' && plain.back() <= '9') plain.remove_suffix(1);
  return plain;
}

/// What a field of that name would say.
inline DistortionName distortionName(std::string_view name) {
  constexpr std::size_t kLongest = 40;
  if (name.size() > kLongest) return DistortionName::none;
  if (coefficientIndex(name)) return DistortionName::coefficient;
  const std::string plain = plainName(name);
  if (isAmong(kDistortionArrays, plain) || isAmong(kDistortionArrays, withoutOwner(plain)))
    return DistortionName::array;
  return isAmong(kNoPlaneFlags, plain) || plain.starts_with(kNoPlaneBegin) ? DistortionName::flag
                                                                           : DistortionName::none;
}

}  // namespace viewproj::cmd
