// What writers make of every kind of result, also of those that no command gives them.
#include <functional>
#include <nlohmann/json.hpp>
#include <set>

#include "catch.hpp"
#include "output/record_writer.hpp"
#include "output/report.hpp"
#include "output/results.hpp"
#include "text/error.hpp"

using namespace viewproj;
using namespace viewproj::cmd;

namespace {

constexpr ResultRow kNumber{"number"}, kVector{"vector", ResultKind::vector, 3}, kFlag{"flag", ResultKind::flag},
    kWord{"word", ResultKind::word}, kJson{"json", ResultKind::json}, kInner{"inner", ResultKind::vector, 2},
    kNames{"names", ResultKind::names}, kN{"n"};
constexpr const ResultRow *kGroupParts[] = {&kInner}, *kListParts[] = {&kN};
constexpr ResultRow kGroup = groupResult("group", kGroupParts), kList{"list", ResultKind::list, 1, kListParts};

/// All kinds but names and a list.
const Results kEach = {&kNumber, &kVector, &kFlag, &kWord, &kJson, &kGroup};

void writeEach(ResultSink& sink) {
  sink.number(kNumber, 1.5);
  sink.vector(kVector, Vec3{1, 2, 3});
  sink.flag(kFlag, true);
  sink.text(kWord, "near");
  sink.text(kJson, "[1]");
  sink.object(kGroup, 1, [](ResultSink& part, std::size_t) { part.vector(kInner, Vec2{4, 5}); });
}

void writeNames(ResultSink& sink) { sink.text(kNames, std::vector<std::string_view>{"left", "top"}); }

void writeList(ResultSink& sink) {
  sink.object(kList, 1, [](ResultSink& part, std::size_t) { part.number(kN, 1); });
}

Results with(Results rows, const ResultRow& row) {
  rows.push_back(&row);
  return rows;
}

/// Of a record [7,8].
std::string written(RecordWriter& writer, const Results& rows, const TextBuffer& out, void (*results)(ResultSink&)) {
  const Shape shape{.isArray = true, .size = 2, .names = {}};
  writer.beginBlock("");
  writer.beginRecord({"[7,8]", &shape}, rows);
  results(writer);
  writer.endRecord();
  return std::string(out.view());
}

WriterSetup setupFor(const Results& rows) {
  WriterSetup setup;
  setup.arrayName = "own";
  setup.results = rows;
  return setup;
}

std::string asCsv(const Results& given, void (*results)(ResultSink&)) {
  const WriterSetup setup = setupFor(given);
  TextBuffer out;
  CsvColumns columns;
  return written(*makeCsvWriter(setup, columns, out), given, out, results);
}

std::string asText(const Results& given, void (*results)(ResultSink&)) {
  const WriterSetup setup = setupFor(given);
  TextBuffer out;
  return written(*makeTextWriter(setup, out), given, out, results);
}

}  // namespace

TEST_CASE("every kind of result is written, or refused, in every form") {
  const auto both = [](ResultSink& sink) {
    writeEach(sink);
    writeNames(sink);
  };
  const Results named = with(kEach, kNames);
  {
    TextBuffer out;
    const WriterSetup setup = setupFor(named);
    const std::string json = written(*makeJsonWriter(setup, out), named, out, [](ResultSink& sink) {
      writeEach(sink);
      writeNames(sink);
      writeList(sink);
    });
    CHECK(json ==
          "{\"own\":[7,8],\"number\":1.5,\"vector\":[1,2,3],\"flag\":true,\"word\":\"near\",\"json\":[1],"
          "\"group\":{\"inner\":[4,5]},\"names\":[\"left\",\"top\"],\"list\":[{\"n\":1}]}\n");
  }
  CHECK(asCsv(named, both) ==
        "own_x,own_y,number,vector_x,vector_y,vector_z,flag,word,json,group_inner_x,group_inner_y,names\n"
        "7,8,1.5,1,2,3,true,near,[1],4,5,left top\n");
  CHECK(asText(kEach, writeEach) == "1.5 1 2 3 1 4 5\n");  // words are left out
  const Results lists = with(kEach, kList);
  for (const OutputForm form : {OutputForm::text, OutputForm::f64}) {
    CHECK_NOTHROW(requireRoom(kEach, form));
    CHECK_THROWS_AS(requireRoom(named, form), UsageError);
    CHECK_THROWS_AS(requireRoom(lists, form), UsageError);
    CHECK_THROWS_AS(requireRoom(Results{&kWord}, form), UsageError);
  }
  for (const OutputForm form : {OutputForm::csv, OutputForm::table}) {
    CHECK_NOTHROW(requireRoom(named, form));
    CHECK_THROWS_AS(requireRoom(lists, form), UsageError);
  }
  CHECK_NOTHROW(requireRoom(with(named, kList), OutputForm::lines));
}

TEST_CASE("a zero of a report has no sign") {
  CHECK(jsonText({{"x", -0.0}}) == "{\"x\": 0}");
  CHECK(tableText({{"x", -0.0}}, 9).find("-0") == std::string::npos);
}

TEST_CASE("a bad record has as many NaN as a good one has numbers") {
  const WriterSetup setup = setupFor(kEach);
  TextBuffer out;
  makeTextWriter(setup, out)->badRecord("", 1, "");
  CHECK(out.view() == "NaN NaN NaN NaN NaN NaN NaN\n");
}

TEST_CASE("each result of a command is one row, with a name of its own and a kind") {
  std::set<std::string_view> ofProject;
  for (const PointResult& result : pointResults()) CHECK(ofProject.insert(result.row.name).second);
  const std::function<void(const ResultRow&)> check = [&](const ResultRow& row) {
    INFO(row.name);
    CHECK(findResult(row.name) != nullptr);
    CHECK((row.kind == ResultKind::vector) == (row.size > 1));
    CHECK((row.kind == ResultKind::group || row.kind == ResultKind::list) == !row.parts.empty());
  };
  for (const ResultRow* row : allResults()) check(*row);
  CHECK(findResult("scren") == nullptr);
}
