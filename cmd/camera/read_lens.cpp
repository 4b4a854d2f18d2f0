#include "camera/read_lens.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "camera/fields.hpp"
#include "camera/values.hpp"
#include "text/names.hpp"

namespace viewproj::cmd {
namespace {

constexpr unsigned counts(std::initializer_list<unsigned> allowed) {
  unsigned bits = 0;
  for (const unsigned count : allowed) bits |= 1U << count;
  return bits;
}

template <std::size_t Count>
std::array<double, Count> firstOf(const std::array<double, 6>& numbers) {
  std::array<double, Count> first{};
  std::copy_n(numbers.begin(), Count, first.begin());
  return first;
}

using N = const LensNumbers&;

constexpr LensParameter kBrownK{"k", "1, 2, 3 or 6 numbers", counts({0, 1, 2, 3, 6})};
constexpr LensParameter kBrownP{"p", "2 numbers", counts({2})};

constexpr LensForm kForms[] = {
    {"brown",
     {{kBrownK, kBrownP, {}}},
     true,
     [](N n) { return brownLens(n.numbers[0], firstOf<2>(n.numbers[1]), n.radius); },
     LensModel::brown},
    {"fisheye",
     {{{"k", "up to 4 numbers", counts({0, 1, 2, 3, 4})}, {}, {}}},
     false,
     [](N n) { return fisheyeLens(firstOf<4>(n.numbers[0])); },
     LensModel::fisheye},
    {"unified",
     {{{"alpha"}, {"beta", "", 0, 1}, {}}},
     false,
     [](N n) { return unifiedLens(n.numbers[0][0], n.numbers[1][0]); },
     LensModel::unified},
    {"double-sphere",
     {{{"xi"}, {"alpha"}, {}}},
     false,
     [](N n) { return doubleSphereLens(n.numbers[0][0], n.numbers[1][0]); },
     LensModel::doubleSphere},
    {"omni",
     {{{"xi"}, kBrownK, kBrownP}},
     false,
     [](N n) { return omniLens(n.numbers[0][0], n.numbers[1], firstOf<2>(n.numbers[2])); },
     LensModel::omni},
    {"fov", {{{"omega"}, {}, {}}}, false, [](N n) { return fovLens(n.numbers[0][0]); }, LensModel::fov},
};

bool isScalar(const LensParameter& parameter) { return parameter.counts.empty(); }

void readParameter(const Node& distortion, const LensParameter& parameter, std::array<double, 6>& numbers,
                   std::size_t& count) {
  if (isScalar(parameter)) {
    const auto value = distortion.find(parameter.name);
    if (!value && !std::isnan(parameter.absent)) {
      numbers[0] = parameter.absent;
      return;
    }
    numbers[0] = distortion.require(parameter.name).number();
    count = 1;
    return;
  }
  const auto value = distortion.find(parameter.name);
  if (!value) return;
  count = value->size();
  const std::vector<double> all = count > 0 ? value->numbers() : std::vector<double>{};
  if (count > numbers.size() || all.size() != count || (parameter.allowed >> count & 1) == 0)
    value->fail("expected " + std::string(parameter.counts));
  std::copy(all.begin(), all.end(), numbers.begin());
}

void readLimit(const Node& limit, const LensForm& form, LensNumbers& lens) {
  std::vector<std::string_view> names{"degrees"};
  if (form.hasRadius) names.emplace_back("radius");
  allowMembers(limit, names);
  const auto radius = limit.find("radius");
  if (radius && limit.find("degrees")) limit.fail("degrees and radius are the same thing; keep one");
  if (radius) {
    lens.radius = radius->number();
    if (!(lens.radius > 0)) limit.fail("must be above 0");
    return;
  }
  lens.degrees = limit.require("degrees").number();
  if (!(lens.degrees > 0 && lens.degrees <= 180)) limit.fail("expected degrees above 0 and up to 180");
}

}  // namespace

std::span<const LensForm> lensForms() { return kForms; }

std::vector<std::string_view> lensModelNames() {
  std::vector<std::string_view> names;
  for (const LensForm& form : kForms) names.push_back(form.model);
  return names;
}

std::string_view nameOf(LensModel model) {
  const auto* const form =
      std::find_if(std::begin(kForms), std::end(kForms), [&](const LensForm& each) { return each.ofLibrary == model; });
  return form->model;
}

std::vector<std::string_view> lensMembers(const LensForm& form) {
  std::vector<std::string_view> names{"model"};
  for (const LensParameter& parameter : form.parameters)
    if (!parameter.name.empty()) names.push_back(parameter.name);
  names.push_back("limit");
  return names;
}

LensNumbers readLensNumbers(const Node& distortion) {
  if (!distortion.json().is_object())
    distortion.fail(R"(expected an object, as in {"model": "brown", "k": [-0.2, 0.05]})");
  const Node model = distortion.require("model");
  const auto* const form = std::find_if(std::begin(kForms), std::end(kForms),
                                        [&](const LensForm& each) { return each.model == model.text(); });
  if (form == std::end(kForms)) model.fail("is not a known model; known are " + together(lensModelNames()));
  const std::vector<std::string_view> names = lensMembers(*form);
  for (const LensForm& other : kForms)
    for (const LensParameter& parameter : other.parameters)
      if (std::find(names.begin(), names.end(), parameter.name) == names.end() && !parameter.name.empty())
        if (const auto member = distortion.find(parameter.name))
          member->fail("does not belong to the model " + model.text());
  allowMembers(distortion, names);
  LensNumbers result;
  result.form = form;
  for (std::size_t i = 0; i < result.numbers.size(); ++i)
    if (const LensParameter& parameter = form->parameters[i]; !parameter.name.empty())
      readParameter(distortion, parameter, result.numbers[i], result.counts[i]);
  if (const auto limit = distortion.find("limit")) readLimit(*limit, *form, result);
  return result;
}

Lens makeLens(const LensNumbers& numbers) {
  const Lens lens = numbers.form->make(numbers);
  return numbers.degrees < kInfiniteFar ? limitedTo(lens, numbers.degrees) : lens;
}

}  // namespace viewproj::cmd
