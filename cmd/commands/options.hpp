// Options that several commands share.
#pragma once

#include <CLI/CLI.hpp>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "input/camera_file.hpp"
#include "input/column_choice.hpp"
#include "stream/filter.hpp"
#include "viewproj/camera.hpp"

namespace viewproj::cmd {

/// While it lives, options that are added stand under this heading in the help. The same heading has the same options
/// in every command.
class Heading {
 public:
  Heading(CLI::App& app, const std::string& name);
  ~Heading();  // NOLINT(bugprone-exception-escape)
  Heading(const Heading&) = delete;
  Heading& operator=(const Heading&) = delete;

 private:
  CLI::App& app_;
};

/// An option that may be given several times, one value each, and never takes the argument behind that value.
CLI::Option* addRepeatable(CLI::App& app, const std::string& name, std::vector<std::string>& values,
                           const std::string& description);

/// --model FILE, which readModel() reads. what: "points".
void addModel(CLI::App& app, std::string& model, const std::string& what);

/// The camera, how it is read, and the convention it is written in.
class CameraOptions {
 public:
  void add(CLI::App& app);
  void addWriting(CLI::App& app);
  /// FILE, for a command that reads nothing but the camera.
  void addFile(CLI::App& app);

  /// From -c, or from FILE where the command has it. Throws HelpGiven after --list.
  CameraFile read() const;
  bool fromStandardInput() const;
  bool allowsStretch() const { return allowStretch_; }

  /// The convention to write in: the file's world, and the axes that options name.
  Convention writing(const CameraFile& file) const;

 private:
  std::string camera_, file_, viewport_, readAs_, convention_, ndcZ_;
  std::vector<std::string> set_;
  bool takesFile_ = false, allowStretch_ = false, reverseZ_ = false, ignoreDistortion_ = false, list_ = false;
  const CLI::Option* reverseZGiven_ = nullptr;
};

/// Something that is read, and whether from standard input.
struct NamedInput {
  const char* what = "";
  bool isStandard = false;
};

/// Throws UsageError where two of these come from standard input.
void requireOneStandardInput(std::initializer_list<NamedInput> inputs);

/// The stream of records that a command works on.
class StreamOptions {
 public:
  /// For a filter, with results in the records. what: "points" or "pixels".
  void add(CLI::App& app, const std::string& what);
  /// For a command that only reads them.
  void addInput(CLI::App& app, const std::string& what);

  /// Throws UsageError for a value that is none.
  FilterSetup setup(const ChoosableColumns& choosable) const;

  /// Throws UsageError where records come from the command line and from a file, or two inputs from standard input.
  /// other: what else the command reads.
  void requireOneInput(const FilterSetup& setup, const CameraOptions& camera, const NamedInput& other = {}) const;

  /// With a camera on the Earth, columns that are named by neither lat, lon, height nor x, y, z are a UsageError; and
  /// what has no names in the output gets x, y, z.
  static void settleOnEarth(FilterSetup& setup, bool worldIsEcef);

  /// Throws UsageError for an option that tells how FILE is to be read. why: "--point takes the place of".
  void requireNoInputOption(const std::string& why) const;

 private:
  std::string file_, from_, to_, prefix_, columns_, jobs_, firstLine_;
  bool keepGoing_ = false, noHeader_ = false;
};

/// What `auto` keeps on screen x and y, in pixels, where nothing else is asked for.
inline constexpr double kDefaultTolerance = 1e-6;

/// --tolerance PX. Throws UsageError for what is no number of pixels.
class ToleranceOption {
 public:
  void add(CLI::App& app);
  bool given() const { return !text_.empty(); }
  double value() const;

 private:
  std::string text_;
};

class PrecisionOption {
 public:
  void add(CLI::App& app);

  /// The arithmetic of that name, or nothing for `auto`. Throws UsageError.
  std::optional<Precision> value() const;

 private:
  std::string name_ = "exact";
};

/// "a,b,c" to its parts. Throws UsageError for one that is named twice.
std::vector<std::string> splitNames(const std::string& option, const std::string& text);

/// "1,2,3", from fewest to most numbers. Throws UsageError, which says what form was expected: "X,Y or X,Y,DEPTH".
std::vector<double> readNumbers(const std::string& option, const std::string& text, std::size_t fewest,
                                std::size_t most, const std::string& form);

/// A point of the command line: X,Y,Z[,W], or x=..,y=..,z=..[,w=..] or lat=..,lon=..,height=.. in any order.
struct GivenPoint {
  std::string text;  ///< as typed
  std::vector<std::pair<std::string, double>> numbers;
  bool named = false;

  /// As a record.
  std::string json() const;
  /// Throws UsageError for a place with a camera elsewhere, and for numbers without names with one on the Earth.
  void requireFit(bool worldIsEcef) const;
  /// In the world.
  Vec4 point() const;
};
GivenPoint readPointOption(const std::string& text);

/// --pixel X,Y[,DEPTH].
std::vector<double> readPixelOption(const std::string& text);

/// Throws UsageError for a name that is not known, with the nearest that is.
[[noreturn]] void failUnknown(const std::string& option, std::string_view name,
                              std::span<const std::string_view> known);
void requireKnown(const std::string& option, std::string_view name, std::span<const std::string_view> known);

}  // namespace viewproj::cmd
