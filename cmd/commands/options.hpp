// Options that several commands share.
#pragma once

#include <CLI/CLI.hpp>
#include <initializer_list>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "commands/notes.hpp"
#include "commands/values.hpp"
#include "input/camera_file.hpp"
#include "input/camera_source.hpp"
#include "input/column_choice.hpp"
#include "stream/filter.hpp"
#include "viewproj/screen.hpp"

namespace viewproj::cmd {

/// --model FILE, which readModel() reads. what: "points"; effect: of giving it.
void addModelOption(CLI::App& app, std::optional<std::string>& model, const std::string& what,
                    const std::string& effect = "");

/// --scene FILE, which readScene() reads.
void addSceneOption(CLI::App& app, std::optional<std::string>& scene, const std::string& help);

/// Whether a file is standard input, which is then read for it.
inline bool isStandardInput(const std::optional<std::string>& file) { return file == "-"; }

/// The presets of conventions by name.
Names<Convention> presetConventions();

/// The camera, how it is read, and the convention it is written in.
class CameraOptions {
 public:
  void add(CLI::App& app);
  void addWriting(CLI::App& app);
  /// FILE, for a command that reads nothing but the camera.
  void addFile(CLI::App& app);

  /// --list, which takes the place of all that the command does otherwise.
  bool lists() const { return list_; }
  /// Returns the exit status.
  int list() const;

  /// From -c, or from FILE where the command has it.
  CameraFile read() const;
  /// Every camera of the file, and what picks it.
  std::vector<std::pair<std::string, CameraFile>> readAll() const;
  bool fromStandardInput() const;
  /// The fields that options gave in place of a file, as a camera file: where they say all of the camera that is
  /// written.
  std::optional<std::string> asTyped(const CameraFile& file) const;
  bool allowsStretch() const { return allowStretch_; }
  const Notes& notes() const { return notes_; }

  /// The convention to write in: the file's world, and the axes that options name.
  Convention writing(const CameraFile& file) const;

  /// What of the convention that is written can be seen in what a command prints.
  struct Shown {
    bool axes = true;      ///< the axes of view space, row or column vectors, storage
    bool range = true;     ///< that of NDC z
    bool reversal = true;  ///< whether depth is reversed
    bool world = true;     ///< the handedness of the world
  };
  /// Notes what of the convention was named to no effect, and a preset of the other handedness. where: what would show
  /// it, "--fields ndc or clip".
  void noteWriting(const CameraFile& file, const Shown& shown, const std::string& where) const;
  bool namesConvention() const { return convention_.has_value(); }
  bool namesAxis() const { return reverseZ_.has_value() || ndcZ_.has_value(); }

 private:
  CameraSource source() const;
  std::unique_ptr<Document> open(const CameraSource& picked) const;
  void addFields(CLI::App& app);
  /// The camera is what options say of it, and no file's.
  bool isTyped() const { return !camera_ && !file_ && !typed_.empty(); }
  std::string readAs() const;

  std::optional<std::string> camera_, file_, readAs_;
  std::optional<Size> viewport_;
  std::optional<ConventionPreset> convention_;
  std::optional<NdcZ> ndcZ_;
  std::optional<bool> reverseZ_;
  std::vector<Assignment> set_;
  TypedCamera typed_;
  bool takesFile_ = false, allowStretch_ = false, ignoreDistortion_ = false, list_ = false;
  Notes notes_;
  mutable bool statesConvention_ = true;            ///< of the camera that was read
  mutable std::unique_ptr<const Document> fields_;  ///< of a camera that options give
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

  /// Throws UsageError for columns that are none.
  FilterSetup setup(const ChoosableColumns& choosable) const;

  /// Throws UsageError where records come from the command line and from a file, or two inputs from standard input.
  /// other: what else the command reads.
  void requireOneInput(const FilterSetup& setup, const CameraOptions& camera, const NamedInput& other = {}) const;

  /// With a camera on the Earth, columns that are named by neither lat, lon, height nor x, y, z are a UsageError; and
  /// what has no names in the output gets x, y, z.
  static void settleOnEarth(FilterSetup& setup, bool worldIsEcef);

  /// Throws UsageError for an option that tells how FILE is to be read. why: "--point takes the place of".
  void requireNoInputOption(const std::string& why) const;

  /// For a command that only reads records: a bad one need not end it.
  void addKeepGoing(CLI::App& app);

  bool hasFile() const { return file_.has_value(); }

 private:
  std::optional<std::string> file_, prefix_, columns_;
  std::optional<Form> from_;
  std::optional<OutputForm> to_;
  std::optional<char> delimiter_, decimal_, comment_;
  std::optional<std::size_t> jobs_, firstLine_, digits_;
  bool keepGoing_ = false, noHeader_ = false, force_ = false, writes_ = false;
};

/// A point of the command line: X,Y,Z[,W], or x=..,y=..,z=..[,w=..] or lat=..,lon=..,height=.. in any order.
struct GivenPoint {
  std::string text;  ///< as typed, after the option
  std::vector<std::pair<std::string, double>> numbers;
  bool named = false;

  /// As a record.
  std::string json() const;
  /// Throws UsageError for a place with a camera elsewhere, and for numbers without names with one on the Earth.
  void requireFit(bool worldIsEcef) const;
  /// In the world.
  Vec4 point() const;
};
inline constexpr const char* kPointForm = "X,Y,Z[,W]|lat=..,lon=..,height=..";
GivenPoint readGivenPoint(const std::string& option, const std::string& text);

/// --digits N. otherwise: what holds where it is not given.
void addDigits(CLI::App& app, std::optional<std::size_t>& digits, const std::string& otherwise);

/// The forms of a report.
enum class ReportForm { table, json, svg };

/// --to table or json, or else svg, if there is one. svg: what it plots.
void addReportForm(CLI::App& app, ReportForm& form, const std::string& svg = "");

/// What `auto` keeps on screen x and y, in pixels, where nothing else is asked for.
inline constexpr double kDefaultTolerance = 1e-6;

/// --tolerance PX.
void addTolerance(CLI::App& app, std::optional<double>& tolerance);

/// The arithmetic, or nothing for `auto`.
struct PrecisionMode {
  std::optional<Precision> arithmetic = Precision::exact;
  bool operator==(const PrecisionMode&) const = default;
};
struct PrecisionRow {
  std::string_view name;
  PrecisionMode mode;
  std::string_view arithmetic, promise;  ///< the promise is of screen x, y and depth
};
std::span<const PrecisionRow> precisionModes();
void addPrecision(CLI::App& app, PrecisionMode& mode);

}  // namespace viewproj::cmd
