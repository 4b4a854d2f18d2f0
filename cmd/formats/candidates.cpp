#include "formats/candidates.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <unordered_map>

#include "formats/claims.hpp"
#include "formats/value.hpp"
#include "formats/words.hpp"
#include "text/number.hpp"

namespace viewproj::cmd {
namespace {

constexpr std::size_t kMostCandidates = 20000, kMostItems = 2000, kDeepest = 12;

// The words of each kind's names.
constexpr std::string_view kOfK = "k m mtx matrix intrinsic intrinsics intr intri kmat camk cammatrix cammtx",
                           kOfD =
                               "dvec dcoef dcoeffs d dist disto distort distortion distortions distcoeff distcoeffs "
                               "distcoef distcoefs coeff coeffs lens kappa radial dc "
                               "coef coefs coefficients kc",
                           kOfS = "size resolution res dimension dimensions shape wh hw image",
                           kOfR = "r rot rotation rotate rmat rotmat",
                           kOfV = "rvec rvecs rodrigues om omc rotation rotvec vector rotations r",
                           kOfQ = "q quat quaternion quaternions orientation rotation qvec rot",
                           kOfT = "t tvec tvecs trans translation translations translate tc",
                           kOfE = "position pos center centre eye origin location loc",
                           kOfX =
                               "t tf tr rt transform transformation extrinsic extrinsics extr pose poses rig view "
                               "world toworld cam camera body w2c c2w bs sc "
                               "imu lidar velo matrix ext tcl tlc tcw twc",
                           kOfP = "p projection proj",
                           kBoxes =
                               "camera cameras cam cams calibration calib calibrations param params parameters data "
                               "value values info config settings "
                               "sensor sensors model color raw mat camerainfo extrinsic extrinsics intrinsic "
                               "intrinsics pose poses frame frames "
                               "calibrated perspective cv mode projection transform the of to from image images img";

struct ScalarNames {
  std::string_view kind, names;
};
constexpr ScalarNames kScalars[] = {
    {"fx", "fx fxpixels fxpixel flx focalx fu focallengthx focallengthxpx fxpx camerafx fpx"},
    {"fy", "fy fypixels fypixel fly focaly fv focallengthy focallengthypx fypx camerafy fpy"},
    {"cx", "cx ppx u0 cu pu xc principalpointx cxpx centerx xcenter c0x"},
    {"cy", "cy ppy v0 cv pv yc principalpointy cypx centery ycenter c0y"},
    {"f", "f focal focallength focallengthpx focalpx fpix"},
    {"w",
     "width sensorwidthpixels widthpixels w rwidth imagewidth imgwidth cols wpx renderwidth framewidth nx imagesizex "
     "xresolution resolutionx integerxresolution camerawidth resx sizex"},
    {"h",
     "height sensorheightpixels heightpixels h imageheight imgheight rows hpx renderheight frameheight ny imagesizey "
     "yresolution resolutiony integeryresolution cameraheight resy sizey"},
    {"fovY", "cameraangley fovy yfov vfov verticalfov fovvertical fovv"},
    {"fovX", "cameraanglex fovx xfov hfov horizontalfov fovhorizontal fovh fovdegrees"},
    {"fov", "fov fieldofview floatfov fovdeg"},
    {"k1", "k1 kud"},
    {"k2", "k2"},
    {"k3", "k3"},
    {"k4", "k4"},
    {"k5", "k5"},
    {"k6", "k6"},
    {"p1", "p1"},
    {"p2", "p2"},
    {"gx", "px mu gamma1"},
    {"gy", "py mv gamma2"},
    {"pz", "pz"},
    {"x", "x"},
    {"y", "y"},
    {"z", "z"},
    {"tx", "tx"},
    {"ty", "ty"},
    {"tz", "tz"},
    {"qx", "qx"},
    {"qy", "qy"},
    {"qz", "qz"},
    {"qw", "qw"},
    {"r11", "r11"},
    {"r12", "r12"},
    {"r13", "r13"},
    {"r21", "r21"},
    {"r22", "r22"},
    {"r23", "r23"},
    {"r31", "r31"},
    {"r32", "r32"},
    {"r33", "r33"},
};

std::string_view scalarOf(std::string_view letters) {
  for (const ScalarNames& scalar : kScalars)
    if (isAmong(letters, scalar.names)) return scalar.kind;
  return "";
}

bool isDigits(std::string_view text) { return !text.empty() && std::all_of(text.begin(), text.end(), isDigit); }

/// Words that say what a part is.
const std::string& kindWords() {
  static const std::string kWords = std::string(kOfK) + " " + std::string(kOfD) + " " + std::string(kOfS) + " " +
                                    std::string(kOfR) + " " + std::string(kOfV) + " " + std::string(kOfQ) + " " +
                                    std::string(kOfT) + " " + std::string(kOfE) + " " + std::string(kBoxes) +
                                    " p w h fx fy cx cy f fov width height vec";
  return kWords;
}

/// A path that --parts can name.
bool isNameable(std::string_view step) {
  return !step.empty() && step.find_first_of(",+|*~?=#[]^\"' \t\n") == std::string_view::npos;
}

class Finder {
 public:
  explicit Finder(const Document& file) : file_(file) {}

  Candidates find() {
    std::vector<std::string> steps;
    walk(*file_.root, steps);
    addStars();
    for (const auto& each : found_) each->tag = findTag(*each);
    return {found_.begin(), found_.end()};
  }

 private:
  void add(const std::string& kind, const std::vector<std::string>& steps, std::vector<double> numbers, double name,
           std::string suffix = "") {
    found_.push_back(std::make_shared<Candidate>(Candidate{kind, steps, std::move(numbers), name, std::move(suffix)}));
  }

  void look(std::string_view key, const Json& value, const std::vector<std::string>& steps) {
    const auto numbers = value.is_boolean() || value.is_null() ? std::nullopt : numbersIn(value);
    constexpr std::size_t kMost = 17;
    if (!numbers || numbers->empty() || numbers->size() > kMost) return;
    const std::vector<double>& n = *numbers;
    for (const double number : n)
      if (!std::isfinite(number)) return;
    const std::string letters = lettersOf(key);
    if (n.size() == 1) {
      std::string bare = letters;
      while (!bare.empty() && isDigit(bare.back())) bare.pop_back();
      if (const std::string_view kind = scalarOf(letters); !kind.empty())
        add(std::string(kind), steps, n, 2);
      else if (const std::string_view other = scalarOf(bare); isAmong(other, "w h fx fy cx cy"))
        add(std::string(other), steps, n, 1);
      return;
    }
    const auto score = [&](std::string_view words) {
      return (hasWord(key, words) ? 2 : 0) - (hasWord(key, kNoise) ? 3 : 0);
    };
    const bool isObject = value.is_object();
    const auto isK = [](const std::vector<double>& m) {
      return isIntrinsic(m) && m[2] > 0 && std::fabs(m[1]) < 0.01 * m[0];
    };
    if (n.size() == 9 && !isObject) {
      if (isK(n))
        add("K", steps, n, 1 + score(kOfK));
      else if (isK(transposed(n)))
        add("K", steps, transposed(n), 1 + score(kOfK), "^T");
      else if (isRotation(n))
        add("R", steps, n, score(kOfR));
    }
    if (n.size() == 12 || n.size() == 16) {
      if (isK(n))
        add("K", steps, n, score(std::string(kOfK) + " p projection"));
      else if (isRigid(n))
        add("X", steps, n, 1 + score(kOfX));
      else if (isProjection(n, 10))
        add("P", steps, n, 1 + score(kOfP));
      else if (n.size() == 16 && isRigid(transposed(n)))
        add("X", steps, n, 1 + score(kOfX), "^T");
    }
    if (n.size() == 3) {
      if (hasWord(key, kOfV) && !hasWord(key, "matrix") &&
          std::all_of(n.begin(), n.end(), [](double x) { return std::fabs(x) < 7; }))
        add("V", steps, n, score(kOfV));
      if (hasWord(key, kOfT)) add("T", steps, n, score(kOfT));
      if (hasWord(key, kOfE)) add("E", steps, n, score(kOfE));
      if (hasWord(key, "direction dir forward lookdir")) add("direction", steps, n, 2);
      if (hasWord(key, "target lookat look")) add("target", steps, n, 2);
    }
    if (n.size() == 4) {
      const double square = n[0] * n[0] + n[1] * n[1] + n[2] * n[2] + n[3] * n[3];
      if (std::fabs(square - 1) < 1e-3 && (hasWord(key, kOfQ) || isObject)) add("Q", steps, n, score(kOfQ));
      if (n[0] > 20 && n[1] > 20 && n[2] > 20 && n[3] > 20 && n[0] / n[1] > 0.2 && n[0] / n[1] < 5 && !isObject &&
          hasWord(key, std::string(kOfK) + " projection parameters proj"))
        add("K", steps, n, score(kOfK) - 1);
    }
    const bool isList =
        n.size() == 2 || n.size() == 4 || n.size() == 5 || n.size() == 8 || n.size() == 12 || n.size() == 14;
    if (isList && hasWord(key, kOfD) && !isObject &&
        std::all_of(n.begin(), n.end(), [](double x) { return std::fabs(x) < 1e5; }))
      add("D", steps, n, score(kOfD));
    if (n.size() == 2) {
      const auto isSide = [](double x) { return x == std::floor(x) && x >= 16 && x <= 65535; };
      if (isSide(n[0]) && isSide(n[1]) && hasWord(key, kOfS) &&
          !hasWord(key, "sensor crop window grid board pattern chess"))
        add("S", steps, n, score(kOfS));
      if (isAmong(letters, "fc focal focallength f") && n[0] > 5 && n[1] > 5) add("F", steps, n, 2);
      if (isAmong(letters, "cc principalpoint pp center c") && n[0] > 0 && n[1] > 0) add("C", steps, n, 2);
    }
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
    sizes_[joinedSteps(steps)] = value.is_structured() ? value.size() : 0;
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
           std::all_of(words.begin(), words.end(), [&](const std::string& word) { return isAmong(word, kindWords()); });
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
          const bool isPose = isAmong(each->kind, "X R V Q T");
          if (isKindOnly(text) || hasWord(text, kNoise)) continue;
          if (isPose && (each->steps[i].find("_to_") != std::string::npos) &&
              (form != "*" || i + 1 == each->steps.size()))
            continue;
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
      if (group.candidate->star.size() < 2) continue;
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
      step = dot != std::string::npos            ? step.substr(0, dot)
             : scalarOf(lettersOf(step)).empty() ? step.substr(digits)
                                                 : "";
    }
    for (std::string& word : wordsOf(step))
      if (!isAmong(word, kindWords()) && (candidate.isStarred() || candidate.steps.size() > 1 || !isDigits(word)))
        tag.push_back(std::move(word));
  }
  std::sort(tag.begin(), tag.end());
  tag.erase(std::unique(tag.begin(), tag.end()), tag.end());
  return tag;
}

}  // namespace viewproj::cmd
