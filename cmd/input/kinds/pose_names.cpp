#include "input/kinds/pose_names.hpp"

#include <algorithm>
#include <array>
#include <string>

#include "input/distortion_names.hpp"

namespace viewproj::cmd {
namespace {

/// What a word of a name is.
enum class Word {
  pose,
  part,    ///< of a pose, or of anything else that stands somewhere
  turn,    ///< an angle
  shape,   ///< makes a part one that is calculated with
  letter,  ///< stands before frames, or alone
  world,
  camera,
  frame,  ///< another
  link,   ///< between frames
  filler,
  number,
};

struct PoseWord {
  std::string_view text;
  Word is;
};
constexpr PoseWord kWords[] = {
    {"pose", Word::pose},
    {"extrinsic", Word::pose},
    {"extrin", Word::pose},
    {"extr", Word::pose},
    {"rvec", Word::pose},
    {"tvec", Word::pose},
    {"qvec", Word::pose},
    {"viewmatrix", Word::pose},
    {"viewmat", Word::pose},
    {"matrixworld", Word::pose},
    {"worldmatrix", Word::pose},
    {"modelview", Word::pose},
    {"bodytcam", Word::pose},
    {"bodytimu", Word::pose},
    {"rotation", Word::part},
    {"rot", Word::part},
    {"translation", Word::part},
    {"trans", Word::part},
    {"transform", Word::pose},
    {"transformation", Word::pose},
    {"position", Word::part},
    {"pos", Word::part},
    {"location", Word::part},
    {"orientation", Word::part},
    {"quaternion", Word::part},
    {"quat", Word::part},
    {"euler", Word::part},
    {"eulerangles", Word::part},
    {"rpy", Word::part},
    {"ypr", Word::part},
    {"eye", Word::part},
    {"lookat", Word::part},
    {"center", Word::part},
    {"centre", Word::part},
    {"cameracenter", Word::part},
    {"cameracentre", Word::part},
    {"cameraorigin", Word::part},
    {"rodrigues", Word::part},
    {"rollpitchyaw", Word::part},
    {"yawpitchroll", Word::part},
    {"yaw", Word::turn},
    {"pitch", Word::turn},
    {"roll", Word::turn},
    {"heading", Word::turn},
    {"azimuth", Word::turn},
    {"elevation", Word::turn},
    {"matrix", Word::shape},
    {"mat", Word::shape},
    {"vector", Word::shape},
    {"vec", Word::shape},
    {"t", Word::letter},
    {"r", Word::letter},
    {"rt", Word::letter},
    {"tf", Word::letter},
    {"world", Word::world},
    {"w", Word::world},
    {"map", Word::world},
    {"camera", Word::camera},
    {"cam", Word::camera},
    {"c", Word::camera},
    {"view", Word::camera},
    {"base", Word::frame},
    {"b", Word::frame},
    {"bs", Word::frame},
    {"sensor", Word::frame},
    {"body", Word::frame},
    {"imu", Word::frame},
    {"hand", Word::frame},
    {"gripper", Word::frame},
    {"robot", Word::frame},
    {"board", Word::frame},
    {"target", Word::frame},
    {"object", Word::frame},
    {"lidar", Word::frame},
    {"velo", Word::frame},
    {"rig", Word::frame},
    {"vehicle", Word::frame},
    {"ego", Word::frame},
    {"flange", Word::frame},
    {"tool", Word::frame},
    {"ee", Word::frame},
    {"to", Word::link},
    {"2", Word::link},
    {"from", Word::link},
    {"in", Word::link},
    {"of", Word::link},
    {"parameter", Word::filler},
    {"param", Word::filler},
    {"global", Word::filler},
    {"initial", Word::filler},
    {"estimated", Word::filler},
    {"optimized", Word::filler},
    {"degrees", Word::filler},
    {"deg", Word::filler},
    {"radians", Word::filler},
    {"rad", Word::filler},
    {"xyz", Word::filler},
    {"wxyz", Word::filler},
    {"xyzw", Word::filler},
};
/// Longer ones are no names of this kind, and cost time.
constexpr std::size_t kLongest = 24;

/// The words of a name so far.
struct Words {
  std::array<std::size_t, static_cast<std::size_t>(Word::number) + 1> counts{};
  std::size_t all = 0;
  bool ofSeveral = false;

  void add(Word word) {
    ++counts[static_cast<std::size_t>(word)];
    ++all;
  }
  std::size_t count(Word word) const { return counts[static_cast<std::size_t>(word)]; }

  PoseName meaning() const {
    const std::size_t parts = count(Word::part), letters = count(Word::letter), links = count(Word::link),
                      worlds = count(Word::world), cameras = count(Word::camera),
                      frames = worlds + cameras + count(Word::frame);
    const bool ofCamera = worlds > 0 && cameras > 0, isLetter = letters == 1 && all == 1,
               isNumbered = letters == 1 && all == 2 && count(Word::number) == 1;
    PoseName is = PoseName::none;
    if (count(Word::pose) > 0 || (parts > 0 && (count(Word::shape) > 0 || ofCamera)) ||
        ((letters > 0 || links > 0) && ofCamera) || isLetter)
      is = PoseName::certain;
    else if (parts > 0 || (letters > 0 && frames > 0) || (links > 0 && frames > 1) || isNumbered)
      is = PoseName::vague;
    return ofSeveral ? std::min(is, PoseName::vague) : is;
  }
};

bool isDigit(char c) { return c >= '0' && c <= '9'; }

/// What a name means whose words before `rest` are known: the most of all ways to divide the rest into words.
PoseName meaningOf(std::string_view rest, const Words& before) {
  if (rest.empty()) return before.meaning();
  PoseName most = PoseName::none;
  const auto goOn = [&](std::size_t size, const Words& words) {
    most = std::max(most, meaningOf(rest.substr(size), words));
  };
  if (isDigit(rest[0])) {
    const std::size_t size = std::min(rest.find_first_not_of("0123456789"), rest.size());
    Words words = before;
    words.add(Word::number);
    goOn(size, words);
  }
  for (const PoseWord& word : kWords) {
    if (!rest.starts_with(word.text)) continue;
    // A letter stands in front.
    if (word.is == Word::letter && before.all > 0) continue;
    Words words = before;
    words.add(word.is);
    goOn(word.text.size(), words);
    const bool isLong = word.text.size() > 2;
    if (!isLong || rest.size() == word.text.size() || rest[word.text.size()] != 's') continue;
    // Extrinsics are one pose.
    words.ofSeveral = words.ofSeveral || !(word.is == Word::filler || word.text.starts_with("extr"));
    goOn(word.text.size() + 1, words);
  }
  return most;
}

}  // namespace

PoseName poseName(std::string_view name) {
  return name.size() > kLongest ? PoseName::none : meaningOf(plainName(name), {});
}

bool isTurnName(std::string_view name) {
  const std::string plain = plainName(name);
  return plain.size() <= kLongest && std::any_of(std::begin(kWords), std::end(kWords), [&](const PoseWord& word) {
           return word.is == Word::turn && plain.find(word.text) != std::string::npos;
         });
}

}  // namespace viewproj::cmd
