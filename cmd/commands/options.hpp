// Options that several commands share, beside those of the camera and of streams.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "commands/cli.hpp"
#include "commands/standard_input.hpp"
#include "commands/values.hpp"
#include "viewproj/screen.hpp"

namespace viewproj::cmd {

/// --model FILE, which readModel() reads. what: "points".
void addModel(CLI::App& app, std::optional<std::string>& model, const std::string& help);
/// --scene FILE, which readScene() reads.
CLI::Option* addScene(CLI::App& app, std::optional<std::string>& scene, const std::string& help);
/// --digits N. otherwise: what holds where it is not given.
void addDigits(CLI::App& app, std::optional<std::size_t>& digits, const std::string& otherwise);
/// --precision MODE.
void addPrecision(CLI::App& app, Precision& precision);

/// --model FILE, which readModel() reads. what: "points"; effect: of giving it.
void addModelOption(CommandLine& line, std::optional<std::string>& model, const std::string& what,
                    const std::string& effect = "");

/// --scene FILE, which readScene() reads.
void addSceneOption(CommandLine& line, std::optional<std::string>& scene, const std::string& help);

inline constexpr std::string_view kDigitsOption = "--digits";
/// --digits N. otherwise: what holds where it is not given.
void addDigits(CommandLine& line, std::optional<std::size_t>& digits, const std::string& otherwise);

/// The forms of a report.
enum class ReportForm { table, json };

/// --to table or json.
void addReportForm(CommandLine& line, ReportForm& form);

struct PrecisionRow {
  std::string_view name;
  Precision precision;
  std::string_view arithmetic, promise;  ///< the promise is of screen x, y and depth
};
std::span<const PrecisionRow> precisions();
/// --precision MODE.
void addPrecision(CommandLine& line, Precision& precision);

}  // namespace viewproj::cmd
