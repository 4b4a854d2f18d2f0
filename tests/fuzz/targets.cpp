#include "targets.hpp"

#include <algorithm>

#include "fuzz.hpp"

namespace viewproj::fuzz {

std::span<const Target> targets() {
  static constexpr Target kTargets[] = {
      {"camera", fuzzCamera},     {"scene", fuzzScene},      {"model", fuzzModel},
      {"matrices", fuzzMatrices}, {"json", fuzzJsonRecords}, {"csv", fuzzCsvRecords},
      {"text", fuzzTextRecords},  {"f64", fuzzF64Records},   {"arguments", fuzzArguments},
  };
  return kTargets;
}

const Target* findTarget(std::string_view name) {
  const auto all = targets();
  const auto at = std::find_if(all.begin(), all.end(), [&](const Target& target) { return target.name == name; });
  return at == all.end() ? nullptr : &*at;
}

}  // namespace viewproj::fuzz
