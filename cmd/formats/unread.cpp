#include "formats/unread.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "formats/claims.hpp"
#include "formats/value.hpp"
#include "formats/words.hpp"

namespace viewproj::cmd {
namespace {

constexpr std::string_view kPoseWords =
    "pose poses extrinsic extrinsics transform transformation rotation rot quat quaternion orientation translation "
    "trans rvec "
    "tvec rvecs tvecs r t rt c2w w2c cam2world world2cam euler ypr rpy xyz position location center centre eye matrix";
/// One number of a pose, beside the numbers of a camera.
constexpr std::string_view kPoseNumbers =
    "x y z tx ty tz px py pz qw qx qy qz rx ry rz roll pitch yaw heading azimuth omega phi kappa";
constexpr std::string_view kLensWords =
    "dist disto distortion distortions xi alpha skew crop binning offset shift rectif zoom rolling mirror poly "
    "polynomial "
    "tangential radial ftheta fisheye";
/// Pictures that are no pinhole's, as a text or a flag names them.
constexpr std::string_view kProjections =
    "fisheye equidistant equirectangular latlong panorama panoramic spherical cylindrical orthographic";
/// Members that no format reads and that say nothing about the picture.
constexpr std::string_view kKnown =
    "T_imu_body timestamp* time date *_time version* units unit description name id index serial* frame_id seq stamp "
    "sec nsec "
    "class_name comment* license $schema";

bool areZero(const std::vector<double>& numbers) {
  return std::all_of(numbers.begin(), numbers.end(), [](double number) { return number == 0; });
}

/// An identity says as little as zeros.
bool isNothing(const std::vector<double>& m) {
  if (areZero(m)) return true;
  const std::size_t columns = m.size() == 9 ? 3 : m.size() == 12 || m.size() == 16 ? 4 : 0;
  if (m.size() == 4)
    return (m[0] == 1 && m[1] == 0 && m[2] == 0 && m[3] == 0) || (m[0] == 0 && m[1] == 0 && m[2] == 0 && m[3] == 1);
  if (columns == 0) return false;
  for (std::size_t i = 0; i < m.size(); ++i)
    if (m[i] != (i / columns == i % columns ? 1 : 0)) return false;
  return true;
}

bool isCoefficient(std::string_view name) {
  const std::string letters = lettersOf(name.substr(name.rfind('.') + 1));
  return letters.size() == 2 && (letters[0] == 'k' || letters[0] == 'p' || letters[0] == 's') && letters[1] >= '1' &&
         letters[1] <= '8';
}

/// The numbers of a value, or of the first item of a list of them.
std::vector<double> oneOf(const Node& node, const std::vector<double>& numbers) {
  const Json& value = node.json();
  constexpr std::size_t kMatrix = 16;
  if (!value.is_array() || value.empty() || numbers.size() <= kMatrix) return numbers;
  const std::size_t count = numbers.size() / value.size();
  return {numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(count)};
}

}  // namespace

Unread::Unread(const Document& file, const Import& result, std::string_view known)
    : file_(file), known_(known), own_(result.own), apart_(result.apart.begin(), result.apart.end()) {
  for (std::size_t i = 0; own_ && i < result.cameras.size(); ++i)
    if (const auto node = own_(i)) apart_.insert(&node->json());
}

bool Unread::isKnown(std::string_view name) const {
  for (std::string_view rest : {known_, kKnown})
    while (!rest.empty()) {
      const std::size_t end = std::min(rest.find(' '), rest.size());
      if (end > 0 && fitsPattern(name, rest.substr(0, end))) return true;
      rest.remove_prefix(std::min(end + 1, rest.size()));
    }
  return false;
}

void Unread::walk(const Node& node, std::string_view name, std::size_t depth, bool isBesideRead, Lists& lists) const {
  constexpr std::size_t kDeepestLevel = 12, kMostNumbers = 1000;
  const Json& value = node.json();
  if (depth > 0 && apart_.contains(&value)) return;
  const bool isRead = node.isMarked();
  // Members or items of it may have been read one by one.
  const bool isReadInParts =
      !isRead && value.is_structured() &&
      std::any_of(value.begin(), value.end(), [&](const Json& part) { return Node(file_, part, "").isMarked(); });
  const bool isProjection = value.is_string() ? isAmong(lettersOf(value.get_ref<const std::string&>()), kProjections)
                                              : value == true && hasWord(name, kProjections);
  if (!isRead && isProjection) lists.left.push_back({node, {}, std::string(name), isBesideRead});
  const bool isNumbers = depth > 0 && !isReadInParts && !value.is_null() && !value.is_boolean() && !value.empty();
  if (const auto numbers = isNumbers ? numbersIn(value) : std::nullopt) {
    if (numbers->size() > kMostNumbers) return;
    if (isRead)
      lists.read.push_back(*numbers);
    else if (!isNothing(*numbers))
      lists.left.push_back({node, *numbers, std::string(name), isBesideRead});
    return;
  }
  if (isRead || depth == kDeepestLevel) return;
  if (value.is_object())
    for (const auto& [key, member] : value.items()) {
      if (!isKnown(key)) walk(Node(file_, member, joinedPath(node.path(), key)), key, depth + 1, isReadInParts, lists);
    }
  else if (value.is_array() && value.size() <= kMostNumbers)
    for (std::size_t i = 0; i < value.size(); ++i)
      walk(Node(file_, value[i], joinedPath(node.path(), std::to_string(i))), name, depth + 1, false, lists);
}

void Unread::judge(const Left& left, const Lists& lists, std::string& names) const {
  for (const Lists* each : {&lists, shared_ ? &*shared_ : nullptr})
    if (each && std::find(each->read.begin(), each->read.end(), left.numbers) != each->read.end()) return;
  if (hasWord(left.name, kNoise)) return;
  const std::vector<double> m = oneOf(left.node, left.numbers);
  const std::size_t count = m.size();
  const bool isFew = count == 3 || count == 4 || count == 6 || count == 7 || count == 9 || count == 12 || count == 16;
  const bool isTurnOfNone = count == 1 && m.front() == 1 && left.name.ends_with('w');
  const bool isPoseNumber =
      count == 1 && left.isBesideRead && isAmong(lettersOf(left.name), kPoseNumbers) && !isTurnOfNone;
  if (isPoseNumber ||
      (isFew && (isRigid(m) || isRotation(m) || (hasWord(left.name, kPoseWords) && !isIntrinsic(m))) && !isNothing(m)))
    left.node.fail(
        "is not read, and may be the camera's pose: call it cameraFromWorld or worldFromCamera, or take it out; "
        "--parts reads "
        "it under any name");
  if (count == 9 && isIntrinsic(m))
    left.node.fail("is not read, and is another K than the one that is; take one of them out");
  const bool isOne = count == 1 && m.front() == 1 && hasWord(left.name, "binning zoom ratio");
  const bool isLens = count == 0 || hasWord(left.name, kLensWords) || isCoefficient(left.name);
  if (isLens && !isOne && count <= 16)
    left.node.fail("is not read, and may bend, move or scale the picture; take it out, or say by --parts what it is");
  if (count < 3) return;
  names += (names.empty() ? "" : ", ") + left.node.path();
}

std::string Unread::judge(std::size_t which) {
  if (known_ == "*") return "";
  const Node root(file_);
  if (!shared_) {
    Lists lists;
    walk(root, "", 0, false, lists);
    shared_ = std::move(lists);
  }
  std::string names;
  Lists lists;
  if (const auto own = own_ ? own_(which) : std::nullopt) {
    apart_.erase(&own->json());
    walk(*own, "", 0, false, lists);
    apart_.insert(&own->json());
  }
  constexpr std::size_t kMost = 8;
  for (const Left& left : lists.left) judge(left, lists, names);
  for (const Left& left : shared_->left) judge(left, lists, names);
  std::size_t at = 0;
  for (std::size_t i = 0; i < kMost && at != std::string::npos; ++i) at = names.find(", ", at + 1);
  return at == std::string::npos ? names : names.substr(0, at) + " and more";
}

}  // namespace viewproj::cmd
