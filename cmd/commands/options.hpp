// Options that several commands share, beside those of the camera and of streams.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "commands/cli.hpp"
#include "commands/values.hpp"
#include "output/report.hpp"
#include "viewproj/screen.hpp"

namespace viewproj::cmd {

/// --model FILE, which readModel() reads.
void addModel(CLI::App& app, std::optional<std::string>& model, const std::string& help);
/// --scene FILE, which readScene() reads.
CLI::Option* addScene(CLI::App& app, std::optional<std::string>& scene, const std::string& help);
/// --digits N. otherwise: what holds where it is not given.
void addDigits(CLI::App& app, std::optional<std::size_t>& digits, const std::string& otherwise);
/// --precision MODE.
void addPrecision(CLI::App& app, Precision& precision);

/// Whether a file is standard input, which is then read for it.
inline bool isStandardInput(const std::optional<std::string>& file) { return file == "-"; }

/// Something that is read, and whether from standard input.
struct NamedInput {
  const char* what = "";
  bool isStandard = false;
};

/// Throws UsageError where two of these come from standard input.
void requireOneStandardInput(std::initializer_list<NamedInput> inputs);

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

/// Reads numbers separated by commas; form: in messages.
inline auto numberList(const char* form) {
  return [form](const std::string& option, const std::string& text) {
    return readNumbers(option, text, 1, SIZE_MAX, form);
  };
}

/// The forms of a report.
enum class ReportForm { table, json, csv };

/// --to table, json or csv, and --digits.
class ReportOptions {
 public:
  /// tableDigits: significant ones for people; programs get all.
  void add(CLI::App& app, int tableDigits);
  ReportForm form() const { return form_; }
  int digits() const;
  /// rows: the member that CSV is of; empty: all of the report is one row.
  void write(const OrderedJson& report, const char* rows = "") const;

 private:
  ReportForm form_ = ReportForm::table;
  std::optional<std::size_t> digits_;
  int tableDigits_ = 0;
};

}  // namespace viewproj::cmd
