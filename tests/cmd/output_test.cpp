// What writers make of every kind of result, also of those that no command gives them; and where a plot puts its
// labels.
#include <cmath>
#include <regex>

#include "catch.hpp"
#include "output/cost_plot.hpp"
#include "output/record_writer.hpp"
#include "text/error.hpp"
#include "text/format_number.hpp"

using namespace viewproj;
using namespace viewproj::cmd;

namespace {

/// All kinds but a list.
void writeEach(ResultSink& sink) {
  sink.number("number", 1.5);
  sink.vector("vector", Vec3{1, 2, 3});
  sink.flag("flag", true);
  sink.word("word", "near");
  sink.json("json", "[1]");
  sink.group("group", true, [](ResultSink& part) { part.vector("inner", Vec2{4, 5}); });
}

void writeNames(ResultSink& sink) { sink.names("names", std::vector<std::string_view>{"left", "top"}, true); }

void writeList(ResultSink& sink) {
  sink.list("list", 1, [](ResultSink& part, std::size_t) { part.number("n", 1); });
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

WriterSetup setupFor(void (*results)(ResultSink&)) {
  WriterSetup setup;
  setup.arrayName = "own";
  setup.exampleResults = results;
  return setup;
}

std::string asCsv(void (*results)(ResultSink&)) {
  const WriterSetup setup = setupFor(results);
  TextBuffer out;
  CsvColumns columns = csvColumns(setup, nullptr, "", out);
  const std::string rows = written(*makeCsvWriter(setup, columns, out), out, results);
  std::string header;
  writeDueHeader(columns, setup, [&](std::string_view text) { header += text; });
  return header + rows;
}

std::string asText(void (*results)(ResultSink&)) {
  const WriterSetup setup = setupFor(results);
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

TEST_CASE("every kind of result has its name") {
  NameCollector names("p_");
  writeEach(names);
  writeNames(names);
  writeList(names);
  CHECK(names.found ==
        std::vector<std::string>{"p_number", "p_vector", "p_flag", "p_word", "p_json", "p_group", "p_names", "p_list"});
}

TEST_CASE("every kind of result is written, or refused, in every form") {
  const auto both = [](ResultSink& sink) {
    writeEach(sink);
    writeNames(sink);
  };
  {
    TextBuffer out;
    const WriterSetup setup = setupFor(both);
    const std::string json = written(*makeJsonWriter(setup, out), out, [](ResultSink& sink) {
      writeEach(sink);
      writeNames(sink);
      writeList(sink);
    });
    CHECK(json ==
          "{\"own\":[7,8],\"number\":1.5,\"vector\":[1,2,3],\"flag\":true,\"word\":\"near\",\"json\":[1],"
          "\"group\":{\"inner\":[4,5]},\"names\":[\"left\",\"top\"],\"list\":[{\"n\":1}]}\n");
  }
  CHECK(asCsv(both) ==
        "own_x,own_y,number,vector_x,vector_y,vector_z,flag,word,json,group_inner_x,group_inner_y,names\n"
        "7,8,1.5,1,2,3,true,near,[1],4,5,left top\n");
  CHECK(asText(writeEach) == "1.5 1 2 3 1 4 5\n");  // words are left out
  CHECK_THROWS_AS(asText(writeNames), UsageError);
  CHECK_THROWS_AS(asText(writeList), UsageError);
  CHECK_THROWS_AS(asCsv(writeList), UsageError);  // as soon as columns are asked for

  TextBuffer out;
  const WriterSetup setup = setupFor(writeEach);
  CsvColumns columns = csvColumns(setup, nullptr, "", out);
  CHECK_THROWS_AS(written(*makeCsvWriter(setup, columns, out), out, writeList), UsageError);
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
