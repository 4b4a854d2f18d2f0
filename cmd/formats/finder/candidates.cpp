#include "formats/finder/candidates.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <unordered_map>

#include "formats/value.hpp"
#include "formats/words.hpp"
#include "text/names.hpp"
#include "text/number.hpp"

namespace viewproj::cmd {
namespace {

constexpr std::size_t kMostCandidates = 20000, kMostItems = 2000, kDeepest = 12;

// The words of each kind's names.
constexpr std::string_view
    kOfK = "k m mtx matrix intrinsic intrinsics intr intri kmat camk cammatrix cammtx",
    kOfD =
        "dvec dcoef dcoeffs d dist disto distort distortion distortions distcoeff distcoeffs distcoef distcoefs coeff "
        "coeffs lens kappa radial dc coef coefs coefficients kc dewarp",
    kLensModels = "brown conrady brownconrady radtan plumb plumbbob kannala brandt kannalabrandt kb4 equidistant",
    kOfOtherLens = "inverse modified d dist distortion distortions coeff coeffs coef coefs coefficients lens kc",
    kOfS = "size sz pixels resolution res dimension dimensions shape wh hw image",
    kOfR = "r rot rotation rotate rmat rotmat camrot",
    kOfV = "rvec rvecs rodrigues om omc rotation rotvec vector rotations r",
    kOfQ = "q quat quaternion quaternions orientation rotation qvec rot wxyz xyzw qwxyz qxyzw",
    kOfT = "t tvec tvecs trans translation translations translate tc",
    kOfE = "position pos campos center centre c eye origin location loc",
    kOfX =
        "t tf tr rt transform transformation extrinsic extrinsics extr pose poses rig view world toworld cam camera "
        "body w2c c2w bs sc imu lidar velo matrix ext tcl tlc tcw twc",
    kOfP = "p projection proj";
/// What other words say nothing of which camera a part is of.
constexpr std::string_view kBoxes =
    "camera cameras cam cams calibration calib calibrations param params parameters data value values info config "
    "settings sensor sensors model color raw mat camerainfo extrinsic extrinsics intrinsic intrinsics pose poses frame "
    "frames world calibrated perspective cv mode projection transform the of to in from image images img p w h fx fy "
    "cx cy f focal princpt fov width height vec interne externe mm cm deg degrees rad radians euler angles attitude "
    "lat lon alt gps axis";

struct ScalarNames {
  std::string_view kind, names;
};
constexpr ScalarNames kScalars[] = {
    {"fx", "fx fxpixels fxpixel flx focalx fu focallengthx focallengthxpx fxpx camerafx fpx"},
    {"fy", "fy fypixels fypixel fly focaly fv focallengthy focallengthypx fypx camerafy fpy"},
    {"cx", "cx ppx u0 cu pu xc principalpointx cxpx centerx xcenter c0x mx"},
    {"cy", "cy ppy v0 cv pv yc principalpointy cypx centery ycenter c0y my"},
    {"f", "f focal focallength focallengthpx focalpx fpix fpixels focallengthmm focalmm fmm lens lensmm"},
    {"lat", "lat latitude gpslat gpslatitude"},
    {"lon", "lon lng long longitude gpslon gpslongitude"},
    {"alt", "alt altitude elevation ele gpsalt gpsaltitude heightellipsoid ellipsoidheight ellipsoidalheight"},
    {"heading", "heading azimuth bearing"},
    {"pitch", "pitch tilt gimbalpitch camerapitch cameratilt"},
    {"yaw", "yaw gimbalyaw camerayaw"},
    {"roll", "roll gimbalroll cameraroll"},
    {"sensor",
     "sensor sensorw sensorwidth sensorwidthmm horizontalfilmaperture horizontalaperture haperture filmwidth "
     "filmwidthmm"},
    {"w",
     "width sensorwidthpixels widthpixels w rwidth imagewidth imgwidth cols wpx renderwidth framewidth nx imagesizex "
     "xresolution resolutionx integerxresolution camerawidth resx sizex"},
    {"h",
     "height sensorheightpixels heightpixels h imageheight imgheight rows hpx renderheight frameheight ny imagesizey "
     "yresolution resolutiony integeryresolution cameraheight resy sizey"},
    {"fovY", "cameraangley fovy yfov vfov verticalfov fovvertical fovv"},
    {"fovX", "cameraanglex fovx xfov hfov horizontalfov fovhorizontal fovh fovdegrees"},
    {"fov", "fov fieldofview floatfov fovdeg viewangle"},
    {"k1", "k1 kud"},
    {"gx", "px mu gamma1"},
    {"gy", "py mv gamma2"}};
/// Those that are called as the kind is.
constexpr std::string_view kPlainScalars =
    "k2 k3 k4 k5 k6 p1 p2 pz x y z tx ty tz qx qy qz qw r00 r01 r02 r10 r20 r11 r12 r13 r21 r22 r23 r31 r32 r33 rx ry "
    "rz omega phi kappa";

std::string_view scalarOf(std::string_view letters) {
  for (const auto& [kind, names] : kScalars)
    if (isAmong(letters, names)) return kind;
  return isAmong(letters, kPlainScalars) ? letters : "";
}

/// "tx" of tx_m: metres, pixels and degrees are what is meant without a unit.
std::string_view withoutUnit(std::string_view name) {
  for (const std::string_view unit : {"_m", "_px", "_deg", "_degrees"})
    if (name.size() > unit.size() && name.ends_with(unit)) return name.substr(0, name.size() - unit.size());
  return name;
}

/// A tangential coefficient that has no name of its own: "tangential distortion coefficient x".
std::string_view tangentialOf(std::string_view name) {
  if (!hasWord(name, "tangential")) return "";
  const std::string last = wordsOf(name).back();
  return isAmong(last, "x 1") ? "p1" : isAmong(last, "y 2") ? "p2" : "";
}

/// An angle of view by a word of its name: fovX, fovY, or fov where no other word says which.
std::string_view angleOf(std::string_view name) {
  if (!hasWord(name, "fov") || hasWord(name, "tan")) return "";
  return hasWord(name, "y v vert vertical") ? "fovY" : hasWord(name, "x h horiz horizontal") ? "fovX" : "fov";
}

/// A focal length, a centre or a size that is the first or the last of a name's words, and which of them.
std::pair<std::string_view, std::size_t> scalarAmong(const std::vector<std::string>& words) {
  for (const std::size_t at : {std::size_t{0}, words.size() - 1})
    if (words.size() > 1 && words[at].size() > 1 && isAmong(scalarOf(words[at]), "fx fy cx cy w h"))
      return {scalarOf(words[at]), at};
  return {"", 0};
}

bool areAll(const std::vector<double>& numbers, bool (*fits)(double)) {
  return std::all_of(numbers.begin(), numbers.end(), fits);
}
bool isK(const std::vector<double>& m) { return isIntrinsic(m) && m[2] > 0 && std::fabs(m[1]) < 0.01 * m[0]; }
bool isTaken(const std::vector<double>& m) { return isProjection(m, 10); }
bool isTurn(const std::vector<double>& v) {
  return areAll(v, [](double x) { return std::fabs(x) < 7; });
}
bool areAngles(const std::vector<double>& v) {
  return areAll(v, [](double x) { return std::fabs(x) <= 360; });
}
bool isAny(const std::vector<double>&) { return true; }
bool isUnit(const std::vector<double>& q) {
  return std::fabs(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3] - 1) < 1e-3;
}
bool isFourOfK(const std::vector<double>& k) {
  return areAll(k, [](double x) { return x > 20; }) && k[0] / k[1] > 0.2 && k[0] / k[1] < 5;
}
bool isLens(const std::vector<double>& d) {
  const double most = d.size() == 2 ? 1e2 : 1e5;  // two larger ones are a place or a size
  return std::all_of(d.begin(), d.end(), [most](double x) { return std::fabs(x) < most; });
}
bool isSmall(const std::vector<double>& d) {
  return areAll(d, [](double x) { return std::fabs(x) < 20; });
}
bool isSize(const std::vector<double>& s) {
  return areAll(s, [](double x) { return x == std::floor(x) && x >= 16 && x <= 65535; });
}
bool isFocalPair(const std::vector<double>& f) { return f[0] > 5 && f[1] > 5; }
bool isSensor(const std::vector<double>& s) { return s[0] > 1 && s[0] < 100 && s[1] > 1 && s[1] < 100; }
bool isCentre(const std::vector<double>& c) { return c[0] > 0 && c[1] > 0; }

/// A kind of part by its numbers and its name. Of those that are whole matrices the first that fits counts.
struct Look {
  std::string_view kind, counts;
  bool (*fits)(const std::vector<double>& numbers);
  std::string_view words;                              ///< of its names
  double score = 0;                                    ///< without a name
  enum Needs { numbers, name, letters } needs = name;  ///< letters: they are all of the name
  std::string_view also = "", excluded = "";           ///< other words
  bool mayBeObject = true;
  std::string_view suffix = "";  ///< "^T": by columns
};
constexpr Look kLooks[] = {
    {"K", "9", isK, kOfK, 1, Look::numbers, "", "", false},
    {"K", "9", isK, kOfK, 1, Look::numbers, "", "", false, "^T"},
    {"R", "9", isRotation, kOfR, 0, Look::numbers, "", "", false},
    {"K", "12 16", isK, kOfK, 0, Look::numbers, "p projection"},
    {"X", "12 16", isRigid, kOfX, 1, Look::numbers},
    {"P", "12 16", isTaken, kOfP, 1, Look::numbers},
    {"P", "12", isTaken, kOfP, 1, Look::numbers, "", "", false, "^T"},
    {"X", "16", isRigid, kOfX, 1, Look::numbers, "", "", true, "^T"},
    {"V", "3", isTurn, kOfV, 0, Look::name, "", "matrix translation trans position"},
    {"A", "3", areAngles, "euler eulers rpy ypr opk angles rot rotation orientation attitude", 0, Look::name, "",
     "axis vector rvec"},
    {"axis", "3", isTurn, "axis"},
    {"sensor", "2", isSensor, "sensor", 0, Look::name, "", "resolution res pixels pixel px"},
    {"T", "3", isAny, kOfT},
    {"E", "3", isAny, kOfE},
    {"direction", "3", isAny, "direction dir forward lookdir"},
    {"target", "3", isAny, "target lookat look looks"},
    {"target", "3", isAny, "focalpoint", 0, Look::letters},
    {"up", "3", isAny, "up vup upvector headup viewup camup cameraup"},
    {"Q", "4", isUnit, kOfQ},
    {"K", "4", isFourOfK, kOfK, -1, Look::name, "projection parameters proj", "", false},
    {"D", "2 4 5 8 12 14", isLens, kOfD, 0, Look::name, "", "c center centre pp principal", false},
    {"D", "4 5 8", isLens, kLensModels, 0, Look::name, "", kOfOtherLens, false},
    {"D", "4 5 8", isSmall, "k", 0, Look::letters, "", "", false},
    {"d", "3 6 7 9", isLens, kOfD, 0, Look::name, "", "c center centre pp principal matrix", false},
    {"S", "2", isSize, kOfS, 0, Look::name, "", "sensor crop window grid board pattern chess"},
    {"F", "2", isFocalPair, "fc focal focallength foc f", 0, Look::letters},
    {"C", "2", isCentre, "cc principalpoint princpt pp center ctr c p", 0, Look::letters},
    {"k", "2 3", isLens, "k radial", 0, Look::letters, "", "", false},
    {"p", "2", isLens, "p tangential", 0, Look::letters, "", "", false}};

bool isDigits(std::string_view text) { return !text.empty() && std::all_of(text.begin(), text.end(), isDigit); }

/// Whether a word says what a part is, and not which camera it is of.
bool isKindWord(std::string_view word) {
  for (const std::string_view words : {kOfK, kOfD, kOfS, kOfR, kOfV, kOfQ, kOfT, kOfE, kBoxes})
    if (isAmong(word, words)) return true;
  return false;
}

/// A path that --parts can name.
bool isNameable(std::string_view step) {
  return !step.empty() && step.find_first_of(",+|*~?=#[]^\"'\t\n") == std::string_view::npos;
}

class Finder {
 public:
  explicit Finder(const Document& file) : file_(file) {}

  Candidates find() {
    std::vector<std::string> steps;
    walk(*file_.root, steps);
    nameLookAt();
    addStars();
    for (const auto& each : found_) each->tag = findTag(*each);
    return {found_.begin(), found_.end()};
  }

 private:
  void add(const std::string& kind, const std::vector<std::string>& steps, std::vector<double> numbers, double name,
           std::string suffix = "") {
    found_.push_back(std::make_shared<Candidate>(Candidate{kind, steps, std::move(numbers), name, std::move(suffix)}));
  }

  /// The numbers of a value, or those of an object of numbers in no order.
  static std::optional<std::vector<double>> partsOf(const Json& value) {
    if (auto numbers = numbersIn(value)) return numbers;
    constexpr std::size_t kLeast = 3, kMost = 7;
    if (!value.is_object() || value.size() < kLeast || value.size() > kMost) return std::nullopt;
    std::vector<double> numbers(kMost + 1);  // a count that no kind has
    for (const Json& member : value) {
      if (!member.is_number()) return std::nullopt;
      numbers.front() = numbers.front() != 0 ? numbers.front() : member.get<double>();
    }
    return numbers;
  }

  void look(std::string_view key, const Json& value, const std::vector<std::string>& steps) {
    const auto numbers = value.is_boolean() || value.is_null() ? std::nullopt : partsOf(value);
    constexpr std::size_t kMost = 17;
    if (numbers && numbers->size() == 21) return addCamera(*numbers, steps);
    if (!numbers || numbers->empty() || numbers->size() > kMost) return;
    const std::vector<double>& n = *numbers;
    if (!areAll(n, [](double number) { return std::isfinite(number); })) return;
    const std::string letters = lettersOf(withoutUnit(key));
    if (n.size() == 1) {
      const std::string_view bare = std::string_view(letters).substr(0, letters.find_last_not_of("0123456789") + 1);
      const std::string_view whole = scalarOf(letters), numbered = scalarOf(bare);
      const bool isPixel = hasWord(key, "pixel") && hasWord(key, "size pitch") && n[0] > 0;
      for (const std::string_view kind :
           {whole, isAmong(numbered, "w h fx fy cx cy") ? numbered : "", scalarAmong(wordsOf(key)).first,
            tangentialOf(key), angleOf(key), std::string_view(isPixel ? "pixel" : "")})
        if (!kind.empty()) return add(std::string(kind), steps, n, whole.empty() ? 1 : 2);
      return;
    }
    const double noise = hasWord(key, kNoise) ? -3 : 0;
    const std::string count = std::to_string(n.size());
    const std::size_t before = found_.size();
    bool isMatrix = false;
    for (const Look& look : kLooks) {
      const bool isOf = look.needs == Look::letters ? isAmong(letters, look.words) : hasWord(key, look.words);
      const bool isAlso = hasWord(key, look.also), isWhole = look.needs == Look::numbers;
      const std::vector<double> m = look.suffix.empty() ? n : transposed(n, n.size() == 16 ? 4 : 3);
      const bool mayBe = isOf || isAlso || isWhole || (look.kind == "Q" && value.is_object());
      if (!mayBe || !isAmong(count, look.counts) || (isWhole && isMatrix) || (value.is_object() && !look.mayBeObject) ||
          hasWord(key, look.excluded) || !look.fits(m))
        continue;
      isMatrix = isMatrix || isWhole;
      const bool isNamed = isOf || (isAlso && isWhole);
      const bool isPlain = look.needs == Look::letters || isAmong(look.kind, "direction target up");
      add(std::string(look.kind), steps, m, look.score + (isNamed ? 2 : 0) + (isPlain ? 0 : noise),
          std::string(look.suffix));
      found_.back()->isOrdered = value.is_object();
      found_.back()->isFlat = value.is_array() && value.front().is_number();
    }
    // Items of a list may be thousands of points.
    if (found_.size() == before && (n.size() > 2 || hasWord(key, "dist distortion")) && noise == 0 &&
        !isDigits(steps.back()))
      add("?", steps, n, 0);
  }

  /// K, R and t, one after the other.
  void addCamera(const std::vector<double>& n, const std::vector<std::string>& steps) {
    const std::vector<double> k(n.begin(), n.begin() + 9), r(n.begin() + 9, n.begin() + 18);
    if (!isK(k) || !isRotation(r)) return;
    add("K", steps, k, 2, "[0:9]");
    add("R", steps, r, 2, "[9:18]");
    add("T", steps, {n.begin() + 18, n.end()}, 2, "[18:21]");
  }

  /// The name that says what a value is: of an item of a list the list's, of "coefficients" the one above.
  static std::string keyOf(const std::vector<std::string>& steps) {
    if (steps.empty()) return "#1";
    std::string key = steps.back();
    if (steps.size() > 1 &&
        (isDigits(key) ||
         (hasWord(key, "coefficients coeffs coeff data value values") &&
          hasWord(steps[steps.size() - 2], "rotation quaternion orientation rot quat translation position"))))
      key = steps[steps.size() - 2];
    return key.substr(key.rfind('.') + 1);
  }

  void walk(const Json& value, std::vector<std::string>& steps) {
    if (steps.size() > kDeepest || found_.size() > kMostCandidates) return;
    const std::size_t before = found_.size();
    if (!steps.empty()) look(keyOf(steps), value, steps);
    std::size_t size = value.is_structured() ? value.size() : 0, blocks = 0;  // without a name
    if (value.is_object())
      for (const auto& [key, member] : value.items()) blocks += key.starts_with('#') ? 1 : 0;
    sizes_[joinedSteps(steps)] = blocks < size ? size - blocks : size;
    const bool isPart = value.is_array() && found_.size() > before;
    if (isPart || (value.is_array() && !value.empty() && value.front().is_number())) return;
    std::size_t items = 0;
    const auto visit = [&](const std::string& step, const Json& member) {
      if (!isNameable(step) || ++items > kMostItems) return;
      steps.push_back(step);
      walk(member, steps);
      steps.pop_back();
    };
    if (value.is_object())
      for (const auto& [key, member] : value.items()) visit(key, member);
    else if (value.is_array())
      for (std::size_t i = 0; i < value.size() && i < kMostItems; ++i) visit(std::to_string(i), value[i]);
  }

  static std::string joinedSteps(const std::vector<std::string>& steps) {
    std::string text;
    for (const std::string& step : steps) text += step + "\n";
    return text;
  }

  /// Beside an eye, center is what gluLookAt calls the target; from has a to.
  void nameLookAt() {
    std::map<std::vector<std::string>, std::map<std::string, Candidate*>> boxes;
    for (const auto& each : found_)
      if (each->numbers.size() == 3 && isAmong(each->kind, "E ?"))
        boxes[{each->steps.begin(), each->steps.end() - 1}].emplace(lettersOf(each->steps.back()), each.get());
    constexpr const char* kPairs[][2] = {
        {"eye", "center"}, {"eye", "centre"}, {"eye", "at"}, {"from", "to"}, {"from", "at"}};
    for (const auto& [box, places] : boxes)
      for (const auto& [of, at] : kPairs) {
        const auto eye = places.find(of), target = places.find(at);
        if (eye == places.end() || target == places.end()) continue;
        eye->second->kind = "E";
        target->second->kind = "target";
        eye->second->name = target->second->name = 2;
      }
  }

  /// A step with a star, and what the star stands for: all of it, a run of digits, or what is before or after a _.
  static std::vector<std::pair<std::string, std::string>> templatesOf(const std::string& step) {
    std::vector<std::pair<std::string, std::string>> templates{{"*", step}};
    for (std::size_t i = 0; i < step.size();) {
      std::size_t end = i;
      while (end < step.size() && isDigit(step[end])) ++end;
      if (end > i && end - i < step.size())
        templates.emplace_back(step.substr(0, i) + "*" + step.substr(end), step.substr(i, end - i));
      i = end > i ? end : i + 1;
    }
    for (const std::size_t at : {step.find('_'), step.rfind('_')}) {
      if (at == std::string::npos || at == 0 || at + 1 == step.size()) continue;
      templates.emplace_back("*" + step.substr(at), step.substr(0, at));
      templates.emplace_back(step.substr(0, at + 1) + "*", step.substr(at + 1));
    }
    for (const std::string_view side : {"Left", "Right", "left", "right", "L", "R"})
      if (step.size() > side.size() && step.ends_with(side)) {
        templates.emplace_back(step.substr(0, step.size() - side.size()) + "*", std::string(side));
        break;
      }
    return templates;
  }

  static bool isKindOnly(const std::string& text) {
    const std::vector<std::string> words = wordsOf(text);
    return !words.empty() && !isDigits(text) && text != "L" && text != "R" && text != "l" && text != "r" &&
           std::all_of(words.begin(), words.end(), isKindWord);
  }

  void addStars() {
    struct Group {
      std::shared_ptr<Candidate> candidate;
      bool isWhole;
    };
    std::map<std::string, Group> groups;
    const std::size_t count = std::min<std::size_t>(found_.size(), kMostCandidates);
    for (std::size_t c = 0; c < count; ++c) {
      const auto& each = found_[c];
      for (std::size_t i = 0; i < each->steps.size(); ++i)
        for (const auto& [form, text] : templatesOf(each->steps[i])) {
          const bool isLink = isAmong(each->kind, "X R V Q T") && each->steps[i].find("_to_") != std::string::npos &&
                              (form != "*" || i + 1 == each->steps.size());
          if (each->kind == "?" || isLink || isKindOnly(text) || hasWord(text, kNoise)) continue;
          std::vector<std::string> steps = each->steps;
          steps[i] = form;
          Group& group = groups[each->kind + each->suffix + "\n" + std::to_string(i) + "\n" + joinedSteps(steps)];
          if (!group.candidate) {
            group.candidate =
                std::make_shared<Candidate>(Candidate{each->kind, steps, each->numbers, each->name, each->suffix});
            group.candidate->at = i;
            group.isWhole = form == "*" && i + 1 == each->steps.size();
          }
          group.candidate->name = std::max(group.candidate->name, each->name);
          group.candidate->star.emplace(text, each);
        }
    }
    for (const auto& [key, group] : groups) {
      // A table may have one row.
      const bool isRow = file_.root->is_array() && group.candidate->at == 0;
      if (group.candidate->star.size() < 2 && !isRow) continue;
      std::vector<std::string> box(group.candidate->steps.begin(),
                                   group.candidate->steps.begin() + static_cast<std::ptrdiff_t>(group.candidate->at));
      // K=* wants nothing else there.
      if (group.isWhole && group.candidate->star.size() != sizes_[joinedSteps(box)]) continue;
      found_.push_back(group.candidate);
    }
  }

  const Document& file_;
  std::vector<std::shared_ptr<Candidate>> found_;
  std::unordered_map<std::string, std::size_t> sizes_;  ///< members of each container
};

}  // namespace

std::string Candidate::path() const {
  std::string text;
  for (const auto& term : terms) text += (text.empty() ? "" : "+") + term->path();
  if (!terms.empty()) return text;
  for (const std::string& step : steps) text += (text.empty() ? "" : ".") + step;
  return text + suffix;
}

Candidates candidatesIn(const Document& file) { return Finder(file).find(); }

std::string besideScalar(std::string_view name) {
  std::vector<std::string> words = wordsOf(name.substr(name.rfind('.') + 1));
  const auto [kind, at] = scalarAmong(words);
  if (kind.empty() || !scalarOf(lettersOf(name)).empty()) return "";
  words.erase(words.begin() + static_cast<std::ptrdiff_t>(at));
  return joined(words, "_");
}

std::vector<std::string> findTag(const Candidate& candidate) {
  std::vector<std::string> tag;
  for (std::size_t i = 0; i < candidate.steps.size(); ++i) {
    std::string step = candidate.steps[i];
    if (candidate.isStarred() && step == "*") continue;
    const bool isLast = i + 1 == candidate.steps.size(), isScalar = candidate.numbers.size() == 1;
    if (isLast && isAmong(candidate.kind, "F C")) continue;
    // fx, k1: only what is before a dot, or a number behind.
    if (isLast && isScalar) {
      const std::size_t dot = step.rfind('.');
      const std::size_t digits = step.find_last_not_of("0123456789") + 1;
      const std::string beside = besideScalar(step);
      step = dot != std::string::npos            ? step.substr(0, dot)
             : !beside.empty()                   ? beside
             : scalarOf(lettersOf(step)).empty() ? step.substr(digits)
                                                 : "";
    }
    for (std::string& word : wordsOf(step))
      if (!isKindWord(word) && (candidate.isStarred() || candidate.steps.size() > 1 || !isDigits(word)))
        tag.push_back(std::move(word));
  }
  std::sort(tag.begin(), tag.end());
  tag.erase(std::unique(tag.begin(), tag.end()), tag.end());
  return tag;
}

}  // namespace viewproj::cmd
