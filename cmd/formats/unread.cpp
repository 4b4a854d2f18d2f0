#include "formats/unread.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <numbers>
#include <unordered_map>
#include <unordered_set>

#include "camera/fields.hpp"
#include "formats/finder/finder.hpp"
#include "formats/parts.hpp"
#include "formats/value.hpp"
#include "formats/words.hpp"
#include "text/names.hpp"
#include "text/number.hpp"
#include "text/pattern.hpp"

namespace viewproj::cmd {
namespace {

constexpr std::string_view kPoseWords =
    "pose poses extrinsic extrinsics transform transformation rotation rot quat quaternion orientation translation "
    "trans rvec tvec rvecs tvecs r t rt c2w w2c cam2world world2cam euler ypr rpy xyz position location center centre "
    "eye pos campos matrix";
/// One number of a pose, beside the numbers of a camera.
constexpr std::string_view kPoseNumbers =
    "x y z tx ty tz px py pz qw qx qy qz rx ry rz roll pitch yaw heading azimuth omega phi kappa pan tilt east north "
    "easting northing lat lon lng latitude longitude alt altitude";
/// Words of names beside those of what is measured.
constexpr std::string_view kUnits = "deg degs degree degrees rad rads radian radians m mm cm meter meters metre metres";
constexpr std::string_view kLensWords =
    "dist disto distortion distortions xi alpha skew crop binning offset shift rectif zoom rolling mirror poly "
    "polynomial tangential radial ftheta fisheye kappa gamma s prism rotate rotated flip flipped aspect scale resize "
    "downsample barrel pincushion coeffs coeff coefs coef coefficients";
/// Objects whose numbers are a lens's, but for those of the glass itself.
constexpr std::string_view kLensBoxes = "lens lenses optics dist disto distortion distortions undistort undistortion",
                           kOfGlass = "focal focus aperture stop number sensor width height diameter weight min max";
/// Ratios, of which 1 says nothing.
constexpr std::string_view kRatios = "binning zoom ratio aspect scale downsample gamma resize orientation";
/// Objects of what a calibration was tried with, and how well it went.
constexpr std::string_view kOfTrials = "error errors std cov covariance board corners points noise bias search range";
/// Turns of the picture, as one number.
constexpr std::string_view kPictureTurns = "rotation rot orientation turn";
/// What belongs to pictures that were undistorted or cropped.
constexpr std::string_view kOfOtherPictures =
    "newcameramtx newcameramatrix newmtx newk optimalcameramatrix map1 map2 mapx mapy roi";
/// Pictures that are no pinhole's with numbers in pixels from the top left, as a text or a flag names them.
constexpr std::string_view kProjections =
    "fisheye equidistant equirectangular latlong panorama panoramic spherical cylindrical orthographic stereographic "
    "equisolid orthogonal ftheta omnidirectional catadioptric rational normalized normalised bottom upside mirrored "
    "flipped";
constexpr std::string_view kChoices = "estimate estimated has use";  // first words of what was chosen, yes or no
constexpr std::string_view kFlags =
    "flip flipped vflip hflip flipx flipy flipud fliplr mirror mirrored invert inverted upside rotated";
/// Names of texts that say how the picture lies or is made; values that mean another picture than OpenCV's, and those
/// that mean its own.
constexpr std::string_view kOfAxes = "axis axes origin handedness handed chirality convention coordinate coordinates",
                           kOfLens = "projection lens distortion",
                           kOtherAxes = "up left lefthanded back backward backwards opengl directx d3d vulkan metal",
                           kOwnPicture =
                               "topleft upperleft lefttop down downward right righthanded opencv none pinhole "
                               "perspective rectilinear plumbbob brown brownconrady radtan forward false no off";
/// Sizes that are not the picture's.
constexpr std::string_view kSizeWords = "size sz resolution res dim dims dimension dimensions shape sensor",
                           kOtherSizes = "tile patch window kernel block cell grid pixel";

bool areAllOf(const std::vector<double>& numbers, double value) {
  return std::all_of(numbers.begin(), numbers.end(), [value](double number) { return number == value; });
}

/// An identity says as little as zeros.
bool isNothing(const std::vector<double>& m) {
  if (areAllOf(m, 0)) return true;
  const std::size_t columns = m.size() == 9 ? 3 : m.size() == 12 || m.size() == 16 ? 4 : 0;
  if (m.size() == 4)
    return (m[0] == 1 && m[1] == 0 && m[2] == 0 && m[3] == 0) || (m[0] == 0 && m[1] == 0 && m[2] == 0 && m[3] == 1);
  if (columns == 0) return false;
  for (std::size_t i = 0; i < m.size(); ++i)
    if (m[i] != (i / columns == i % columns ? 1 : 0)) return false;
  return true;
}

/// Numbers of the lens and the picture that a file may say twice, under one of these names.
constexpr std::pair<std::string_view, std::string_view> kTwice[] = {{"fx", "fx flx focalx fu"},
                                                                    {"fy", "fy fly focaly fv"},
                                                                    {"cx", "cx ppx u0 cu"},
                                                                    {"cy", "cy ppy v0 cv"},
                                                                    {"width", "width w imagewidth"},
                                                                    {"height", "height h imageheight"},
                                                                    {"fovX", "fovx hfov cameraanglex"},
                                                                    {"fovY", "fovy vfov cameraangley"}};
constexpr std::string_view kSizes = "size imagesize imgsize imageresolution cameraresolution resolution";

/// What a camera has of these; nothing if its file does not say.
std::optional<double> statedOf(const Json& camera, std::string_view name) {
  const auto at = [&](const char* object, const auto& member) -> std::optional<double> {
    const Json& value = camera.value(Json::json_pointer(std::string("/") + object + "/" + std::string(member)), Json());
    return value.is_number() ? std::optional(value.get<double>()) : std::nullopt;
  };
  const bool isAcross = name == "width" || name == "fovX";
  if (name == "width" || name == "height") {
    const auto pixels = at("projection/pixels", isAcross ? "0" : "1");
    return pixels ? pixels : at("viewport", name);
  }
  if (!name.starts_with("fov")) return at("projection", name);
  const auto f = at("projection", isAcross ? "fx" : "fy"), side = statedOf(camera, isAcross ? "width" : "height");
  if (!f || !side || camera.contains("distortion")) return std::nullopt;
  return 2 * std::atan(*side / *f / 2) * 180 / std::numbers::pi;
}

/// Whether a name and its number say what was chosen, yes or no.
bool isChoice(std::string_view name, const std::vector<double>& numbers) {
  const std::vector<std::string> words = wordsOf(name);
  return numbers.size() == 1 && (numbers[0] == 0 || numbers[0] == 1) && !words.empty() &&
         isAmong(words.front(), kChoices);
}

/// The numbers of a text such as 1280x960; a ratio such as 1/2 or 16:9.
std::optional<std::vector<double>> measuresIn(const Json& value, std::string_view name) {
  if (!value.is_string()) return std::nullopt;
  const std::string& text = value.get_ref<const std::string&>();
  const bool isRatio = hasWord(name, kRatios);
  const std::size_t at = text.find_first_of(isRatio ? "xX*/:" : "xX*");
  if (at == text.npos) return std::nullopt;
  const double a = parseNumber(text.substr(0, at)).value_or(0), b = parseNumber(text.substr(at + 1)).value_or(0);
  if (a == 0 || b == 0) return std::nullopt;
  return isRatio && text.find_first_of("/:") == at ? std::vector{a / b} : std::vector{a, b};
}

enum class Meaning { nothing, unclear, otherPicture };

/// What a flag or a text that is not read says of the picture.
Meaning meaningOf(std::string_view name, const Json& value) {
  if (value.is_boolean()) {
    const bool isOther = hasWord(name, kProjections) || hasWord(name, kFlags);
    return value == false || isChoice(name, {1}) ? Meaning::nothing
           : isOther                             ? Meaning::otherPicture
                                                 : Meaning::unclear;
  }
  if (!value.is_string()) return Meaning::nothing;
  const std::string& text = value.get_ref<const std::string&>();
  const std::vector<std::string> words = wordsOf(text);
  constexpr std::size_t kMost = 3;  // more are a sentence
  if (words.empty() || words.size() > kMost || text.find_first_of("/.\\@") != text.npos) return Meaning::nothing;
  const std::string letters = lettersOf(text);
  if (hasWord(name, kFlags) && isAmong(letters, "yes true on y")) return Meaning::otherPicture;
  const bool isOfAxes = hasWord(name, kOfAxes);
  if (hasWord(text, kProjections) || (isOfAxes && isAmong(letters, kOtherAxes))) return Meaning::otherPicture;
  return (isOfAxes || hasWord(name, kOfLens)) && !isAmong(letters, kOwnPicture) ? Meaning::unclear : Meaning::nothing;
}

bool areNear(double a, double b, double part, double least) {
  return std::fabs(a - b) <= std::max(part * std::fabs(b), least);
}

bool isCoefficient(std::string_view name) {
  std::string letters = lettersOf(name.substr(name.rfind('.') + 1));
  if (letters.starts_with("kc")) letters.erase(1, 1);
  return letters == "k" ||
         (letters.size() == 2 && std::string_view("kpst").find(letters[0]) != std::string_view::npos &&
          letters[1] >= '1' && letters[1] <= '8');
}

/// "pitch" of pitch_deg.
std::string withoutUnits(std::string_view name) {
  std::string letters;
  for (const std::string& word : wordsOf(name))
    if (!isAmong(word, kUnits)) letters += word;
  return letters;
}

/// The numbers of a value, or of the first item of a list of them.
std::vector<double> oneOf(const Node& node, const std::vector<double>& numbers) {
  const Json& value = node.json();
  constexpr std::size_t kMatrix = 16;
  if (!value.is_array() || value.empty() || numbers.size() <= kMatrix) return numbers;
  const std::size_t count = numbers.size() / value.size();
  return {numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(count)};
}

/// Where a member stands: beside one that was read or an object of such, in an object that is beside one, or elsewhere.
enum class Nearness { far, inside, beside };

struct Left {
  Node node;
  std::vector<double> numbers;
  std::string name;
  Nearness nearness;
  std::string box = {};                     ///< the names of the objects that it stands in, below what was read
  Meaning meaning = Meaning::otherPicture;  ///< of what has no numbers
  bool areMembers = false;                  ///< the numbers stand in members of their own, which are in the list too
};
struct Lists {
  std::vector<Left> left;
  std::vector<std::vector<double>> read;
};

/// Judges what is left of a file after a camera of it was read. Several threads may ask for cameras.
class Unread {
 public:
  Unread(std::shared_ptr<Document> file, const Import& cameras, std::string_view known)
      : file_(std::move(file)),
        known_(wordsIn(known)),
        apart_(cameras.apart.begin(), cameras.apart.end()),
        areSeveral_(cameras.cameras.size() > 1) {
    for (const std::string_view name : wordsIn(kSaysNothing)) known_.push_back(name);
    for (const CameraEntry& camera : cameras.cameras)
      if (camera.own) apart_.insert(&camera.own->json());
  }

  Json document(const CameraEntry& camera, std::size_t which) {
    const std::lock_guard lock(mutex_);
    Json made = camera.document();
    if (std::string names = judge(camera.own, made); !names.empty()) notes_[which] = std::move(names);
    return made;
  }
  std::string note(std::size_t which) {
    const std::lock_guard lock(mutex_);
    const auto found = notes_.find(which);
    return found == notes_.end() ? "" : found->second;
  }

 private:
  std::string judge(const std::optional<Node>& own, const Json& camera) {
    if (!shared_) {
      Lists lists;
      walk(Node(*file_), "", 0, Nearness::far, lists);
      shared_ = std::move(lists);
    }
    Lists lists;
    if (own) {
      apart_.erase(&own->json());
      walk(*own, "", 0, Nearness::far, lists);
      apart_.insert(&own->json());
    }
    constexpr std::size_t kMost = 8;
    std::vector<std::string> names, faulty;
    std::string fault;  // the first
    const std::string in = own ? own->path() : "";
    const bool isItem = in.find_first_not_of("0123456789", in.rfind('.') + 1) == in.npos && !in.empty();
    const std::string item = isItem ? in + "." : "";
    for (const std::vector<Left>* list : {&lists.left, &shared_->left})
      for (const Left& left : *list) {
        try {
          requirePixels(left, camera);
          if (!isSaidTwice(left, camera)) judge(left, lists, item, names);
        } catch (const InputError& e) {
          if (fault.empty()) fault = e.what();
          if (std::find(faulty.begin(), faulty.end(), left.node.path()) == faulty.end())
            faulty.push_back(left.node.path());
        }
      }
    if (faulty.size() > 1) faulty.erase(faulty.begin()), fault += "; others like it: " + someOf(faulty, kMost);
    if (!fault.empty()) throw InputError(fault);
    const bool isMore = names.size() > kMost;
    names.resize(std::min(names.size(), kMost));
    return joined(names) + (isMore ? " and more" : "");
  }

  bool isKnown(std::string_view name, std::string_view front = "") const {
    return std::any_of(known_.begin(), known_.end(), [&](std::string_view pattern) {
      return pattern.starts_with(front) && fitsPattern(name, pattern.substr(front.size()));
    });
  }

  /// Whether a member says what the camera has already. Throws if it says otherwise: but for half a pixel, which is
  /// another way to count, and for rounded angles.
  static bool isSaidTwice(const Left& left, const Json& camera) {
    const std::string letters = lettersOf(left.name);
    if (left.nearness != Nearness::beside || hasWord(left.name, kNoise)) return false;
    const auto fail = [&](std::string_view name, double stated) {
      left.node.fail("differs from the camera's " + std::string(name) + ", " + formatDigits(stated, 6) +
                     "; take one of them out");
    };
    const std::vector<double>& n = left.numbers;
    for (const auto& [name, names] : kTwice) {
      const auto stated = n.size() == 1 && isAmong(letters, names) ? statedOf(camera, name) : std::nullopt;
      if (!stated) continue;
      const bool isAngle = name.starts_with("fov"), isCentre = name[0] == 'c';
      constexpr double kMostRadians = 3.2;
      const double value = isAngle && n[0] < kMostRadians ? n[0] * 180 / std::numbers::pi : n[0];
      if (!areNear(value, *stated, isAngle ? 0.01 : 0.001, isCentre ? 0.5 : 0)) fail(name, *stated);
      return true;
    }
    const auto width = statedOf(camera, "width"), height = statedOf(camera, "height");
    if (!width || !height) return false;
    if (n.size() == 1 && hasWord(left.name, "aspect") &&
        (areNear(n[0], *width / *height, 0.01, 0) || areNear(n[0], *height / *width, 0.01, 0)))
      return true;
    constexpr double kLeastSide = 64;
    const auto isSide = [](double side) { return side == std::floor(side) && side >= kLeastSide; };
    const bool isOther = !hasWord(left.name, kSizeWords) || hasWord(left.name, kOtherSizes);
    if (n.size() != 2 || !(isAmong(letters, kSizes) || (!isOther && isSide(n[0]) && isSide(n[1])))) return false;
    if (std::minmax(n[0], n[1]) != std::minmax(*width, *height))
      fail(n[0] == *width ? "height" : "width", n[0] == *width ? *height : *width);
    return true;
  }

  /// A pixel's size beside a focal length that is too short to be in pixels. Throws.
  static void requirePixels(const Left& left, const Json& camera) {
    const bool isPixel = hasWord(left.name, "pixel") && hasWord(left.name, "size pitch");
    const auto f = statedOf(camera, "fx"), cx = statedOf(camera, "cx"), width = statedOf(camera, "width");
    if (isPixel && f && cx && *f < kLeastFocal * width.value_or(2 * *cx))
      left.node.fail("is not read, and the focal length of " + formatDigits(*f, 6) +
                     " is too short to be in pixels; divide it by this in the same unit, as --parts 'K=fx/0.00345+…' "
                     "does");
  }

  /// Whether members or items of it were read one by one.
  bool isReadInParts(const Json& value) const {
    return value.is_structured() &&
           std::any_of(value.begin(), value.end(), [&](const Json& part) { return Node(*file_, part, "").isMarked(); });
  }

  void walk(const Node& node, std::string_view name, std::size_t depth, Nearness nearness, Lists& lists,
            const std::string& box = "") const {
    constexpr std::size_t kDeepestLevel = 12, kMostNumbers = 1000;
    const Json& value = node.json();
    if (depth > 0 && apart_.contains(&value)) return;
    const bool isRead = node.isMarked(), isInParts = !isRead && isReadInParts(value);
    const bool isNumbers = depth > 0 && !isInParts && !value.is_null() && !value.is_boolean() && !value.empty();
    auto numbers = isNumbers ? numbersIn(value) : std::nullopt;
    if (isNumbers && !numbers && nearness != Nearness::far) numbers = measuresIn(value, name);
    Meaning meaning = isRead || numbers ? Meaning::nothing : meaningOf(name, value);
    // Far from the camera, only what is plain.
    const bool isPlain = !value.is_string() || isAmong(lettersOf(value.get_ref<const std::string&>()), kProjections);
    if (nearness == Nearness::far && (meaning == Meaning::unclear || !isPlain)) meaning = Meaning::nothing;
    const bool isOfOther = !isRead && value.is_array() && !value.empty() &&
                           isAmong(lettersOf(name), kOfOtherPictures) && !(numbers && isNothing(*numbers));
    if (isOfOther || meaning != Meaning::nothing)
      lists.left.push_back({node, {}, std::string(name), nearness, box, isOfOther ? Meaning::otherPicture : meaning});
    if (numbers) {
      if (numbers->size() > kMostNumbers) return;
      if (isRead)
        lists.read.push_back(*numbers);
      else if (!isNothing(*numbers))
        lists.left.push_back({node, *numbers, std::string(name), nearness, box});
      return;
    }
    if (isRead || depth == kDeepestLevel) return;
    if (value.is_object()) {
      const bool isBeside = isInParts || std::any_of(value.begin(), value.end(), [&](const Json& part) {
                              return part.is_object() && isReadInParts(part);
                            });
      const Nearness inside = isBeside                    ? Nearness::beside
                              : nearness != Nearness::far ? Nearness::inside
                                                          : Nearness::far;
      const std::string boxInside = inside == Nearness::inside ? joinedPath(box, name) : "";
      for (const auto& [key, member] : value.items())
        if (!isKnown(key))
          walk(Node(*file_, member, joinedPath(node.path(), key)), key, depth + 1, inside, lists, boxInside);
      if (isBeside) addNumbered(node, lists);
    } else if (value.is_array() && value.size() <= kMostNumbers) {
      for (std::size_t i = 0; i < value.size(); ++i)
        walk(Node(*file_, value[i], joinedPath(node.path(), std::to_string(i))), name, depth + 1, Nearness::far, lists);
    }
  }

  /// Members that differ in an index alone, as m00, m01 or rvec_x, are the numbers of one.
  void addNumbered(const Node& node, Lists& lists) const {
    std::map<std::string, Left> groups;
    for (const auto& [key, member] : node.json().items()) {
      const Node each(*file_, member, joinedPath(node.path(), key));
      const std::size_t end = key.find_last_not_of("0123456789_");
      const bool isAxis = key.size() > 2 && std::string_view("xyzw").find(key.back()) != std::string_view::npos &&
                          std::string_view("._").find(key[key.size() - 2]) != std::string_view::npos;
      std::string stem = isAxis ? key.substr(0, key.size() - 2) : key.substr(0, end == key.npos ? 0 : end + 1);
      if (stem.size() == key.size() || each.isMarked() || isKnown(key)) continue;
      const auto numbers = numbersIn(member);
      if (!numbers || numbers->size() != 1) continue;
      if (stem.ends_with('.')) stem.pop_back();
      groups.try_emplace(stem, Left{each, {}, stem, Nearness::beside, "", Meaning::nothing, true})
          .first->second.numbers.push_back((*numbers)[0]);
    }
    for (auto& [stem, group] : groups) lists.left.push_back(std::move(group));
  }

  /// What reads a pose that is left: a name, or the line that the finder proposes.
  std::string wayToRead(const Left& left) const {
    const std::size_t count = oneOf(left.node, left.numbers).size();
    const bool isMatrix = (count == 12 || count == 16) && !left.areMembers;
    const bool isFlat = left.node.json().is_array() && left.node.size() == 9;
    const std::string called = isMatrix ? "call it cameraFromWorld or worldFromCamera, or " : "";
    for (const ProposedLine& line : proposeParts(*file_).lines) {
      if (line.pose.find(left.name) == std::string::npos) continue;
      return called + "read it by " + optionsOf(line) +
             (line.isEitherWay      ? ", or cameraFromWorld for worldFromCamera"
              : line.decide.empty() ? ""
                                    : " (decide: " + joined(line.decide, "; ") + ")") +
             (isFlat ? ", and " + left.node.path() + "^T if its numbers go by columns, as RealSense's do" : "");
    }
    return called + "read it by --parts (viewproj help parts)";
  }

  /// item: the path of the list's item that the camera is, with a dot; its members have one name in all of them.
  void judge(const Left& left, const Lists& lists, const std::string& item, std::vector<std::string>& names) const {
    for (const Lists* each : {&lists, shared_ ? &*shared_ : nullptr})
      if (each && std::find(each->read.begin(), each->read.end(), left.numbers) != each->read.end()) return;
    const std::string& path = left.node.path();
    const std::string called = path.starts_with(item) ? path.substr(item.size()) : path;
    if (!left.areMembers && isKnown(left.name, "?")) return names.push_back(called);
    if (!left.numbers.empty() && (hasWord(left.name, kNoise) || hasWord(left.box, kOfTrials))) return;
    if (left.numbers.empty() && left.meaning == Meaning::unclear) return names.push_back(called);
    const std::vector<double> m = oneOf(left.node, left.numbers);
    const std::size_t count = m.size();
    const bool isFew = count == 3 || count == 4 || count == 6 || count == 7 || count == 9 || count == 12 || count == 16;
    const bool isTurnOfNone = count == 1 && m.front() == 1 && left.name.ends_with('w');
    // What is beside several cameras, in an object of its own, is no camera's.
    const bool isNear = left.nearness == Nearness::beside || (left.nearness == Nearness::inside && !areSeveral_);
    const bool isPoseNumber = count == 1 && isNear && isAmong(withoutUnits(left.name), kPoseNumbers) && !isTurnOfNone;
    if (isPoseNumber ||
        (isFew && (isRigid(m) || isRotation(m) || (hasWord(left.name, kPoseWords) && !isIntrinsic(m))) &&
         !isNothing(m)))
      left.node.fail("is not read, and may be the camera's pose: " + wayToRead(left) + ", or take it out");
    if (left.areMembers || isChoice(left.name, m)) return;
    if (count == 9 && isIntrinsic(m))
      left.node.fail("is not read, and is another K than the one that is; take one of them out");
    const bool isOne = areAllOf(m, 1) && hasWord(left.name, kRatios);
    const bool isLens = count == 0 || hasWord(left.name, kLensWords) || hasWord(left.name, kFlags) ||
                        isCoefficient(left.name) || (hasWord(left.box, kLensBoxes) && !hasWord(left.name, kOfGlass)) ||
                        (count == 1 && isAmong(withoutUnits(left.name), kPictureTurns));
    if (isLens && !isOne && count <= 16)
      left.node.fail("is not read, and may bend, move or scale the picture; take it out, or say by --parts what it is");
    if (count < 3 && (left.nearness == Nearness::far || areAllOf(m, 1))) return;
    names.push_back(called);
  }

  std::shared_ptr<Document> file_;
  std::vector<std::string_view> known_;  ///< patterns of names
  std::unordered_set<const void*> apart_;
  bool areSeveral_;
  std::optional<Lists> shared_;  ///< of what belongs to no camera alone
  std::unordered_map<std::size_t, std::string> notes_;
  std::mutex mutex_;
};

}  // namespace

bool mayBeOfCamera(std::string_view name) {
  constexpr std::string_view kTurnsAndAngles = "roll pitch yaw heading azimuth pan tilt hfov vfov fov focal",
                             kOfCameras = "cam camera intrinsic intrinsics principal origin";
  return name.size() > 1 && !hasWord(name, kNoise) && !fitsAny(name, kSaysNothing) &&
         (isAmong(withoutUnits(name), kPoseNumbers) || isCoefficient(name) || hasWord(name, kTurnsAndAngles) ||
          hasWord(name, kLensWords) || hasWord(name, kPoseWords) || hasWord(name, kOfCameras));
}

Import judged(const std::shared_ptr<Document>& file, Import cameras, std::string_view known) {
  if (known == "*") return cameras;
  const auto unread = std::make_shared<Unread>(file, cameras, known);
  for (std::size_t i = 0; i < cameras.cameras.size(); ++i) {
    CameraEntry& camera = cameras.cameras[i];
    camera.document = [unread, camera, i] { return unread->document(camera, i); };
  }
  cameras.unread = [unread](std::size_t which) { return unread->note(which); };
  return cameras;
}

}  // namespace viewproj::cmd
