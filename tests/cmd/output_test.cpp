// What writers make of every kind of result, also of those that no command gives them; and where a plot puts its
// labels.
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "catch.hpp"
#include "input/coordinates.hpp"
#include "output/cost_plot.hpp"
#include "output/record_writer.hpp"
#include "schema/schemas.hpp"
#include "text/error.hpp"
#include "text/format_number.hpp"

using namespace viewproj;
using namespace viewproj::cmd;

namespace {

constexpr ResultRow kNumber{"number"}, kVector{"vector", ResultKind::vector, 3}, kFlag{"flag", ResultKind::flag},
    kWord{"word", ResultKind::word}, kJson{"json", ResultKind::json}, kInner{"inner", ResultKind::vector, 2},
    kNames{"names", ResultKind::names}, kN{"n"};
constexpr const ResultRow *kGroupParts[] = {&kInner}, *kListParts[] = {&kN};
constexpr ResultRow kGroup = groupResult("group", kGroupParts, ""), kList = listResult("list", kListParts, "");

/// All kinds but names and a list.
const Results kEach = {&kNumber, &kVector, &kFlag, &kWord, &kJson, &kGroup};

void writeEach(ResultSink& sink) {
  sink.number(kNumber, 1.5);
  sink.vector(kVector, Vec3{1, 2, 3});
  sink.flag(kFlag, true);
  sink.word(kWord, "near");
  sink.json(kJson, "[1]");
  sink.group(kGroup, true, [](ResultSink& part) { part.vector(kInner, Vec2{4, 5}); });
}

void writeNames(ResultSink& sink) { sink.names(kNames, std::vector<std::string_view>{"left", "top"}, true); }

void writeList(ResultSink& sink) {
  sink.list(kList, 1, [](ResultSink& part, std::size_t) { part.number(kN, 1); });
}

Results with(Results rows, const ResultRow& row) {
  rows.push_back(&row);
  return rows;
}

/// Of a record [7,8].
std::string written(RecordWriter& writer, const TextBuffer& out, void (*results)(ResultSink&)) {
  const Shape shape{.isArray = true, .size = 2, .names = {}};
  writer.beginBlock(false);
  writer.beginRecord({"[7,8]", &shape});
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
  CsvColumns columns = csvColumns(setup, nullptr, "", {}, out);
  const std::string rows = written(*makeCsvWriter(setup, columns, out), out, results);
  std::string header;
  writeDueHeader(columns, setup, [&](std::string_view text) { header += text; });
  return header + rows;
}

std::string asText(const Results& given, void (*results)(ResultSink&)) {
  const WriterSetup setup = setupFor(given);
  TextBuffer out;
  return written(*makeTextWriter(setup, out), out, results);
}

}  // namespace

TEST_CASE("A count has three digits and the unit that suits them, whichever side of the next one it lies") {
  const std::pair<double, const char*> cases[] = {
      {0, "0"},           {0.00123456, "0.00123"}, {1e-12, "1e-12"},  {0.9996, "1"},      {12.345, "12.3"},
      {999, "999"},       {999.4, "999"},          {999.5, "1 k"},    {999.6, "1 k"},     {1000, "1 k"},
      {1049.9, "1.05 k"}, {9996, "10 k"},          {12345, "12.3 k"}, {999.4e3, "999 k"}, {999500, "1 M"},
      {999.6e6, "1 G"},   {999.4e6, "999 M"},      {1e9, "1 G"},      {999.6e9, "1 T"},   {1.5e12, "1.5 T"},
      {1e15, "1000 T"},   {1.234e18, "1230000 T"}, {-999.6, "-1 k"},  {999.6e-6, "0.001"}};
  for (const auto& [value, text] : cases) {
    INFO(value);
    CHECK(formatCount(value) == text);
  }
}

TEST_CASE("every kind of result is written, or refused, in every form") {
  const auto both = [](ResultSink& sink) {
    writeEach(sink);
    writeNames(sink);
  };
  const Results named = with(kEach, kNames);
  {
    TextBuffer out;
    const WriterSetup setup = setupFor(named);
    const std::string json = written(*makeJsonWriter(setup, out), out, [](ResultSink& sink) {
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

TEST_CASE("a bad record has as many NaN as a good one has numbers") {
  const WriterSetup setup = setupFor(kEach);
  TextBuffer out;
  makeTextWriter(setup, out)->badRecord("", 1, "");
  CHECK(out.view() == "NaN NaN NaN NaN NaN NaN NaN\n");
}

TEST_CASE("each result of a command is one row, with a name of its own, a kind and a line of help") {
  std::set<std::string_view> ofProject;
  for (const PointResult& result : pointResults()) CHECK(ofProject.insert(result.row.name).second);
  const std::function<void(const ResultRow&)> check = [&](const ResultRow& row) {
    INFO(row.name);
    CHECK(findResult(row.name) != nullptr);
    CHECK(!row.help.empty());
    CHECK((row.kind == ResultKind::vector) == (row.size > 1));
    CHECK((row.kind == ResultKind::group || row.kind == ResultKind::list) == !row.parts.empty());
    for (const ResultRow* part : row.parts) CHECK(!part->help.empty());
  };
  for (const ResultRow* row : allResults()) check(*row);
  CHECK(findResult("p_screen", "p_") != nullptr);
  CHECK(findResult("scren") == nullptr);
}

TEST_CASE("the schemas of points and of results are JSON, and name every row") {
  const std::string points = pointsSchema(), all = resultsSchema();
  CHECK(nlohmann::json::accept(points));
  CHECK(nlohmann::json::accept(all));
  const auto names = [](const std::string& schema, std::string_view name) {
    return schema.find("\"" + std::string(name) + "\": ") != std::string::npos;
  };
  for (const ResultRow* row : allResults()) CHECK(names(all, row->name));
  for (const Coordinate* row : allCoordinates()) {
    if (row->form != CoordinateForm::numbers) CHECK(names(points, row->name));
    for (const CoordinatePart& part : row->parts) CHECK(names(points, part.name));
  }
}

TEST_CASE("labels of a plot lie on neither dots nor each other, however close the dots are") {
  CostPlot plot{.title = "a crowd", .caption = "", .series = {"one"}, .dots = {}};
  // Dots in a row, nearer to each other than a label is wide; others far away give the axes their range.
  plot.dots.push_back({.label = "", .nanoseconds = 1, .pixels = 1e-12, .bound = {}});
  plot.dots.push_back({.label = "", .nanoseconds = 10000, .pixels = 1, .bound = {}});
  for (int i = 0; i < 5; ++i)
    plot.dots.push_back(
        {.label = "label " + std::to_string(i), .nanoseconds = 100 * std::pow(1.35, i), .pixels = 1e-6, .bound = {}});
  const std::string svg = costPlotSvg(plot);

  struct Box {
    double left, top, right, bottom;
  };
  std::vector<Box> boxes;
  std::size_t inTheMiddle = 0;
  // The narrowest that a letter of a sans-serif face of 14 px is taken for here.
  const double letter = 5.5;
  const std::regex label("<text x=\"([0-9.]+)\" y=\"([0-9.]+)\" class=\"label\"([^>]*)>(label [0-9])</text>");
  for (std::sregex_iterator it(svg.begin(), svg.end(), label), end; it != end; ++it) {
    const double x = std::stod((*it)[1]), y = std::stod((*it)[2]);
    const std::string anchor = (*it)[3];
    const double width = letter * double((*it)[4].length());
    const bool middle = anchor.find("middle") != std::string::npos;
    inTheMiddle += middle;
    const double left = x - (middle ? width / 2 : anchor.find("end") != std::string::npos ? width : 0);
    boxes.push_back({left, y - 9, left + width, y});
  }
  REQUIRE(boxes.size() == 5);
  CHECK(inTheMiddle > 0);
  const std::regex dot("<circle cx=\"([0-9.]+)\" cy=\"([0-9.]+)\"");
  for (std::sregex_iterator it(svg.begin(), svg.end(), dot), end; it != end; ++it) {
    const double x = std::stod((*it)[1]), y = std::stod((*it)[2]);
    boxes.push_back({x - 5, y - 5, x + 5, y + 5});
  }
  REQUIRE(boxes.size() == 5 + 7 + 1);  // and the legend's dot
  for (std::size_t i = 0; i < 5; ++i)
    for (std::size_t j = i + 1; j < boxes.size(); ++j) {
      INFO(i << " and " << j);
      CHECK((boxes[i].right <= boxes[j].left || boxes[j].right <= boxes[i].left || boxes[i].bottom <= boxes[j].top ||
             boxes[j].bottom <= boxes[i].top));
    }
}
