#include "stream/record_reader.hpp"

#include <algorithm>

#include "text/csv.hpp"
#include "text/error.hpp"

namespace viewproj::cmd {
namespace {

/// The most names of all schemas together that are kept, unless one alone has more.
constexpr std::size_t kMostNames = 1 << 16;

bool isNothing(std::string_view value, Form form) {
  if (form == Form::json) return value == "null" || value == "\"\"";
  return csvValue(value).find_first_not_of(" \t") == std::string::npos;
}

}  // namespace

RecordReader::Known* RecordReader::add(std::string_view key, Schema schema, RecordSink& sink) {
  if (names_ += 1 + schema.size; names_ > kMostNames) {
    sink.forgetPlans();
    schemas_.clear();
    names_ = 1 + schema.size;
  }
  auto known = std::make_unique<Known>(Known{std::move(schema), {}, {}});
  if (passErrors_) known->error = known->schema.find(kErrorName);
  return (schemas_[std::string(key)] = std::move(known)).get();
}

void RecordReader::takeKnown(const RecordView& record, RecordSink& sink) {
  Known& known = *last_;
  if (known.error && !isNothing(record.values[*known.error], known.schema.form))
    return sink.takeError(record, *known.error);
  auto plan = std::find_if(known.plans.begin(), known.plans.end(),
                           [&](const auto& one) { return one->numbers.fits(record.values); });
  if (plan == known.plans.end()) {
    known.plans.push_back(std::make_unique<Plan>(sink.plan(record)));
    plan = known.plans.end() - 1;
  }
  Numbers numbers;
  readNumbers(record, (*plan)->numbers, numbers);
  sink.take(record, **plan, numbers);
}

}  // namespace viewproj::cmd
