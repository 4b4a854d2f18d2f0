// Options that several commands share, beside those of the camera and of streams.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "commands/cli.hpp"
#include "output/report.hpp"
#include "viewproj/screen.hpp"

namespace viewproj::cmd {

/// --model FILE, which readModel() reads.
CLI::Option* addModel(CLI::App& app, std::optional<std::string>& model, const std::string& help);
/// --scene FILE, which readScene() reads. help: what its shapes are for.
CLI::Option* addScene(CLI::App& app, std::optional<std::string>& scene, const std::string& help);
/// --digits N. otherwise: what holds where it is not given.
void addDigits(CLI::App& app, std::optional<std::size_t>& digits, const std::string& otherwise);
/// --precision MODE.
void addPrecision(CLI::App& app, Precision& precision);

/// The forms of a report.
enum class ReportForm : std::uint8_t { table, json, csv };

/// --to table, json or csv, and --digits.
class ReportOptions {
 public:
  /// tableDigits: significant ones for people; programs get all.
  void add(CLI::App& app, int tableDigits);
  ReportForm form() const { return form_; }
  /// rows: the member that CSV is of; empty: all of the report is one row.
  void write(const OrderedJson& report, const char* rows = "") const;

 private:
  ReportForm form_ = ReportForm::table;
  std::optional<std::size_t> digits_;
  int tableDigits_ = 0;
};

}  // namespace viewproj::cmd
