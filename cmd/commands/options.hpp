// Options that several commands share, beside those of the camera and of streams.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "commands/cli.hpp"
#include "commands/standard_input.hpp"
#include "commands/values.hpp"
#include "output/report.hpp"
#include "viewproj/screen.hpp"

namespace viewproj::cmd {

/// --model FILE, which readModel() reads.
void addModel(CLI::App& app, std::optional<std::string>& model, const std::string& help);
/// --scene FILE, which readScene() reads. help: what its shapes are for.
CLI::Option* addScene(CLI::App& app, std::optional<std::string>& scene, const std::string& help);
/// --digits N. otherwise: what holds where it is not given.
void addDigits(CLI::App& app, std::optional<std::size_t>& digits, const std::string& otherwise);
/// --precision MODE.
void addPrecision(CLI::App& app, Precision& precision);

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
