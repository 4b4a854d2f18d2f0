// What writers make of every kind of result, also of those that no command gives them.
#include <cmath>
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
const ResultRows kEach = {&kNumber, &kVector, &kFlag, &kWord, &kJson, &kGroup};

const std::string_view kSomeNames[] = {"left", "top"};

void addEach(ResultValues& values) {
  values.add(1.5);
  values.add(Vec3{1, 2, 3});
  values.add(true);
  values.addWord("near");
  values.addWord("[1]");
  values.addCount(1);
  values.add(Vec2{4, 5});
}

ResultRows with(ResultRows rows, const ResultRow& row) {
  rows.push_back(&row);
  return rows;
}

/// Of a record [7,8].
std::string written(OutputForm form, const ResultRows& rows, const ResultValues& values) {
  const Schema schema{.isArray = true, .size = 2, .names = {}};
  StreamSetup stream;
  stream.arrayName = "own";
  const WriterSetup setup{.stream = stream, .form = form, .rows = rows};
  TextBuffer out;
  CsvColumns columns;
  const auto writer = form == OutputForm::csv    ? makeCsvWriter(setup, columns, out)
                      : form == OutputForm::text ? makeTextWriter(setup, out)
                                                 : makeJsonWriter(setup, out);
  const std::string_view own[] = {"7", "8"};
  writer->beginBlock("");
  writer->write({"[7,8]", &schema, own}, rows, values);
  return std::string(out.view());
}

}  // namespace

TEST_CASE("every kind of result is written, or refused, in every form") {
  const ResultRows named = with(kEach, kNames);
  ResultValues each;
  addEach(each);
  CHECK(written(OutputForm::text, kEach, each) == "1.5 1 2 3 1 4 5\n");  // words are left out
  each.addNames(kSomeNames);
  CHECK(written(OutputForm::csv, named, each) ==
        "own_x,own_y,number,vector_x,vector_y,vector_z,flag,word,json,group_inner_x,group_inner_y,names\n"
        "7,8,1.5,1,2,3,true,near,[1],4,5,left top\n");
  each.addCount(2);
  each.add(1.0);
  each.add(2.0);
  CHECK(written(OutputForm::lines, with(named, kList), each) ==
        "{\"own\":[7,8],\"number\":1.5,\"vector\":[1,2,3],\"flag\":true,\"word\":\"near\",\"json\":[1],"
        "\"group\":{\"inner\":[4,5]},\"names\":[\"left\",\"top\"],\"list\":[{\"n\":1},{\"n\":2}]}\n");
  const ResultRows lists = with(kEach, kList);
  for (const OutputForm form : {OutputForm::text, OutputForm::f64}) {
    CHECK_NOTHROW(requireRoom(kEach, form));
    CHECK_THROWS_AS(requireRoom(named, form), UsageError);
    CHECK_THROWS_AS(requireRoom(lists, form), UsageError);
    CHECK_THROWS_AS(requireRoom(ResultRows{&kWord}, form), UsageError);
  }
  for (const OutputForm form : {OutputForm::csv, OutputForm::table}) {
    CHECK_NOTHROW(requireRoom(named, form));
    CHECK_THROWS_AS(requireRoom(lists, form), UsageError);
  }
  CHECK_NOTHROW(requireRoom(with(named, kList), OutputForm::lines));
}

TEST_CASE("a result without a value is null, empty cells or NaN, whatever it has of parts") {
  ResultValues none;
  none.add(NAN);
  none.add(Vec3{1, INFINITY, 3});
  none.add(false);
  none.addWord("");
  none.addWord("");
  none.addCount(0);
  CHECK(written(OutputForm::text, kEach, none) == "NaN NaN NaN NaN 0 NaN NaN\n");
  CHECK(written(OutputForm::csv, kEach, none).ends_with("\n7,8,,,,,false,,,,\n"));
  CHECK(written(OutputForm::lines, kEach, none) ==
        "{\"own\":[7,8],\"number\":null,\"vector\":null,\"flag\":false,\"word\":null,\"json\":null,\"group\":null}\n");
}

TEST_CASE("a zero of a report has no sign") {
  CHECK(jsonText({{"x", -0.0}}) == "{\"x\": 0}");
  CHECK(tableText({{"x", -0.0}}, 9).find("-0") == std::string::npos);
}

TEST_CASE("a bad record has as many NaN as a good one has numbers") {
  const StreamSetup stream;
  const WriterSetup setup{.stream = stream, .form = OutputForm::text, .rows = kEach};
  TextBuffer out;
  makeTextWriter(setup, out)->writeBad({}, 1, "");
  CHECK(out.view() == "NaN NaN NaN NaN NaN NaN NaN\n");
}

TEST_CASE("each result of a command is one row, with a name of its own and a kind") {
  std::set<std::string_view> ofProject;
  for (const ResultRow* row : results::kPoint) CHECK(ofProject.insert(row->name).second);
  for (const ResultRow* row : allResults()) {
    INFO(row->name);
    CHECK(findResult(row->name) != nullptr);
    CHECK((row->kind == ResultKind::vector) == (row->size > 1));
    CHECK((row->kind == ResultKind::group || row->kind == ResultKind::list) == !row->parts.empty());
  }
  CHECK(findResult("scren") == nullptr);
}
