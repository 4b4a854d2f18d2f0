// The options of a stream of records.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "commands/camera_options.hpp"
#include "commands/options.hpp"
#include "records/column_choice.hpp"
#include "stream/filter.hpp"

namespace viewproj::cmd {

/// The stream of records that a command works on.
class StreamOptions {
 public:
  /// For a filter, with results in the records. what: "points" or "pixels".
  void add(CLI::App& app, const std::string& what);
  /// For a command that only reads them: a bad one need not end it.
  void addInput(CLI::App& app, const std::string& what);

  /// Throws UsageError for columns that are none.
  FilterSetup setup(const ChoosableColumns& choosable) const;

  /// Throws UsageError where records come from the command line and from a file, or two inputs from standard input.
  /// other: what else the command reads.
  void requireOneInput(const FilterSetup& setup, const CameraOptions& camera, const NamedInput& other = {}) const;

  /// Whether records are read where a scene may be enough: without FILE only where standard input is free, or nothing
  /// else is given. instead: after "FILE, which", what stands in their place. Throws UsageError as requireOneInput
  /// does, and for an option that tells how to read what is not read.
  bool readsBeside(const std::optional<std::string>& scene, const FilterSetup& setup, const CameraOptions& camera,
                   const std::string& instead = {}) const;

  /// With a camera on the Earth, columns that are named by neither lat, lon, height nor x, y, z are a UsageError; and
  /// what has no names in the output gets x, y, z.
  static void settleOnEarth(FilterSetup& setup, bool worldIsEcef);

  /// Throws UsageError for an option that tells how FILE is to be read. why: "--point takes the place of".
  void requireNoInputOption(const std::string& why) const;

 private:
  void addReading(CLI::App& app, const std::string& what);

  std::optional<std::string> file_, prefix_, columns_;
  std::optional<Form> from_;
  std::optional<OutputForm> to_;
  std::optional<char> delimiter_;
  std::optional<std::size_t> jobs_, digits_;
  bool keepGoing_ = false, noHeader_ = false, writes_ = false;
};

}  // namespace viewproj::cmd
