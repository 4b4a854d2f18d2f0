#include "stream/random_text.hpp"

#include <algorithm>
#include <cstring>
#include <limits>

namespace viewproj::tests {
namespace {

// clang-format off
constexpr const char* kOddNumbers[] = {
    "-0", "0", "-0.0", "1e999", "-1e999", "1e-999", "5e-324", "01", "+1", "1.", ".5", "1e", "1e+", "-", "--1",
    "0x10", "1_000", "1,5", "NaN", "nan", "inf", "1E+2", "1e-05", "1e308", "2e308", "-.5", "1.5.5", "0e0", "-0e5",
    "00", "1e5", "1 2", "1e00", "1.0e1", "123456789012345678901234567890", "12345678901234567890",
    "18446744073709551615", "18446744073709551616", "9223372036854775807", "9223372036854775808",
    "-9223372036854775808", "-9223372036854775809", "9007199254740993", "0.1000000000000000055511151231257827",
    "2.2250738585072011e-308", "1.7976931348623157e308", "1.7976931348623159e308", "123e-10000000", "0e", "1eE2", "0e+-1",
    "- 1", "-2.", "-1.0.", "1ea", "1+2", "-123.123foo", "123\xE5", "\xEF\xBC\x91", "Infinity", "0e1", "-1e+9999"};

constexpr const char* kOddPieces[] = {
    "\\u0000", "\\ud800", "\\udc00", "\\ud83d\\ude00", "\\ud800\\u0041", "\\udc00\\ud800", "\\x", "\\u12", "\\u12g4",
    "\\\"", "\\/", "\\", "\\\\", "\"", "\xC3\xA9", "\xC3", "\xA9", "\xC0\x80", "\xED\xA0\x80", "\xF4\x90\x80\x80",
    "\xF0\x9F\x98\x80", "\xFF", "\xEF\xBB\xBF", "\xE2\x80\xA8", "\x7F", "\x01", "\t", "\n", "\r", "\f", "{", "}",
    "[", "]", ",", ":", "null", "true", "nul", "tru", "/*x*/", "//x", "/*", "#", "*", ";", "'", "{}", "[]", "[[]]",
    "\"points\"", " ", "\v", "\b", "\xC2\xA0", "\xE2\x81\xA0", "\xFF\xFE", "\\uDFAA", "\\uD888\\u1234", "\\U0041", "\\a",
    "\"a\":1,\"a\":2", "\"\":{\"b\":1,\"b\":1}"};
// clang-format on

}  // namespace

std::string RandomText::number() {
  if (oneIn(12)) {
    // clang-format off
    static constexpr const char* kGood[] = {
        "-0", "0", "-0.0", "1e-999", "5e-324", "1E+2", "12345678901234567890", "123456789012345678901234567890",
        "9007199254740993", "-9223372036854775809"};
    // clang-format on
    return oneOf(kGood);
  }
  std::string text = oneIn(3) ? "-" : "";
  text += std::to_string(below(2000));
  if (oneIn(2)) text += "." + std::to_string(below(1000000));
  if (oneIn(8)) text += "e" + std::to_string(below(40));
  return text;
}

std::string RandomText::value(int depth) {
  // clang-format off
  static constexpr const char* kPlain[] = {
      "null", "true", "false", "\"a\"", "\"\"", "[]", "{}", "\"}\\n{\"", "\"]\\\"[\"", "\"\\u00e9\"", "\"\xC3\xA9\"",
      "\"\\ud83d\\ude00\"", "\"a,b\"", "\"{\\\"x\\\":1}\""};
  // clang-format on
  if (depth < 3 && oneIn(4)) return "[" + value(depth + 1) + "," + value(depth + 1) + "]";
  if (depth < 3 && oneIn(4)) return "{\"a\":" + value(depth + 1) + ",\"b\": " + value(depth + 1) + "}";
  return oneIn(3) ? number() : oneOf(kPlain);
}

std::string RandomText::record(bool pretty) {
  const auto space = [&]() -> std::string {
    if (!pretty || !oneIn(3)) return oneIn(6) ? " " : "";
    // clang-format off
    static constexpr const char* kBreaks[] = {
        "\n", "\n  ", "\r\n", " \n\n ", "\t\n"};
    // clang-format on
    return oneOf(kBreaks);
  };
  const auto array = [&](std::size_t count) {
    std::string text = "[" + space();
    for (std::size_t i = 0; i < count; ++i) text += (i > 0 ? "," + space() : "") + number() + space();
    return text + "]";
  };
  if (oneIn(4)) return array(oneIn(6) ? 4 : 3);
  std::vector<std::string> fields;
  if (oneIn(3)) {
    fields.push_back("\"position\":" + space() + array(3));
  } else if (oneIn(8)) {
    fields.push_back("\"direction\":" + array(3));
  } else {
    for (const char* name : {"\"x\"", "\"y\"", "\"z\""}) fields.push_back(name + space() + ":" + space() + number());
    if (oneIn(8)) fields[0].replace(1, 1, "\\u0078");
  }
  // clang-format off
  static constexpr const char* kNames[] = {
      "\"id\"", "\"name\"", "\"\"", "\"a\\\"b\"", "\"points\"", "\"t\\u0000\""};
  // clang-format on
  if (const std::size_t at = below(12); at < 6) {
    const auto where = fields.begin() + static_cast<std::ptrdiff_t>(below(fields.size() + 1));
    const bool document = at == 4 && where == fields.begin();  // an array there would make it one
    fields.insert(where, std::string(kNames[at]) + ":" + space() + (document ? "1" : value()));
  }
  std::string text = "{" + space();
  for (std::size_t i = 0; i < fields.size(); ++i) text += (i > 0 ? "," + space() : "") + fields[i] + space();
  return text + "}";
}

std::string RandomText::badRecord() {
  // clang-format off
  static constexpr const char* kBad[] = {
      "{\"x\":1,\"y\":2}", "{}", "[1]", "[1,2]", "[1,2,3,4,5]", "{\"x\":1,\"y\":2,\"z\":\"3\"}",
      "{\"x\":1,\"y\":2,\"z\":null}", "{\"x\":1,\"y\":2,\"z\":1e999}", "{\"x\":1,\"x\":2,\"y\":1,\"z\":1}",
      "{\"x\":1,\"y\":2,\"z\":3,\"sum\":4}", "{\"position\":[1,2]}", "{\"position\":[1,2,\"3\"]}", "[4713,1,1]",
      "{\"x\":4713,\"y\":2,\"z\":3}", "[0,0,0,0]", "{\"x\":1,\"y\":2,\"z\":3,}", "{\"x\":01,\"y\":2,\"z\":3}",
      "{\"x\":1,\"y\":2,\"z\":3,\"s\":\"\\x\"}", "{\"x\":1,\"y\":2,\"z\":3,\"s\":\"\xFF\"}", "{\"a\":{\"x\":1}}"};
  // clang-format on
  return oneOf(kBad);
}

std::string_view RandomText::mutate(std::string& text) {
  if (text.empty()) text = " ";
  const std::size_t at = below(text.size());
  const auto replaceNumber = [&](const std::string& by) {
    const std::size_t begin = text.find_first_of("0123456789-", at);
    if (begin == std::string::npos) return;
    const std::size_t end = std::min(text.find_first_not_of("0123456789-+.eE", begin), text.size());
    text.replace(begin, end - begin, by);
  };
  switch (below(12)) {
    case 0:
      text[at] = static_cast<char>(text[at] ^ (1 << below(8)));
      return "bit flipped";
    case 1:
      text.insert(at, 1, static_cast<char>(below(256)));
      return "byte put in";
    case 2:
      text.erase(at, 1 + below(3));
      return "bytes left out";
    case 3:
      text.insert(at, text.substr(at, 1 + below(12)));
      return "bytes doubled";
    case 4:
    case 5:
      replaceNumber(oneOf(kOddNumbers));
      return "odd number";
    case 6:
    case 7:
      text.insert(at, oneOf(kOddPieces));
      return "odd piece put in";
    case 8: {
      const std::size_t bracket = text.find_first_of("{}[]\",:", at);
      if (bracket != std::string::npos) text.erase(bracket, 1);
      return "bracket or sign left out";
    }
    case 9: {
      const std::size_t name = text.find('"');
      if (name != std::string::npos) text.insert(name, "\"x\":" + number() + ",");
      return "name twice";
    }
    case 10:
      text.insert(at, 1, '\0');
      return "NUL";
    default: {
      const std::size_t deep = oneIn(20) ? 1100 : 1 + below(40);
      replaceNumber(std::string(deep, '[') + (oneIn(2) ? "1" : "") + std::string(oneIn(4) ? deep - 1 : deep, ']'));
      return "nested";
    }
  }
}

std::string RandomText::json(std::size_t records, std::size_t bad) {
  // clang-format off
  static constexpr const char* kBetween[] = {
      "\n", "\n", "\n", " ", "", "\n\n", "\r\n", "\t", " \n \n\n"};
  static constexpr const char* kComma[] = {
      ",", ",\n", " ,\n  ", ",\r\n", "\n,\n", ", "};
  // clang-format on
  const bool oneArrangement = oneIn(3);
  const std::string between = oneOf(kBetween);
  const bool pretty = oneIn(2);
  std::string all = oneIn(8) ? "\xEF\xBB\xBF" : "";
  const auto next = [&](bool inArray) {
    if (bad == 0 || !oneIn(bad)) return record(pretty);
    if (inArray && oneIn(3)) {
      // clang-format off
      static constexpr const char* kNone[] = {
          "null", "5", "\"a,]\"", "true", "-1e5"};
      // clang-format on
      return std::string(oneOf(kNone));
    }
    return badRecord();
  };
  for (std::size_t i = 0; i < records;) {
    const std::size_t arrangement = oneArrangement ? 0 : below(6);
    if (arrangement < 4) {
      all += next(false);
      ++i;
    } else {
      const bool document = arrangement == 5;
      const std::string space = oneIn(2) ? "\n " : "";
      all += document ? "{" + space + "\"points\"" + space + ":" + space + "[" : "[";
      all += space;
      const std::size_t count = oneIn(5) ? 0 : 1 + below(std::min<std::size_t>(records - i, 20));
      for (std::size_t j = 0; j < count; ++j) {
        std::string item = next(true);
        // `[` and a number would be a record, not an array.
        if (!document && j == 0 && item.find_first_of("{[\"nt") != 0) item = "[1,2,3]";
        all += (j > 0 ? oneOf(kComma) : "") + item;
      }
      all += space + "]";
      if (document) all += (oneIn(2) ? ",\n\"more\": " + value() : "") + space + "}";
      i += std::max<std::size_t>(count, 1);
    }
    all += oneArrangement ? between : oneOf(kBetween);
  }
  return all;
}

std::string RandomText::csv(std::size_t records, std::size_t bad) {
  // clang-format off
  static constexpr const char* kCells[] = {
      "a", "", "\"b\"", "\"c,d\"", "\"e\nf\"", "\"g\"\"h\"", "\"\r\n\"", "i\"j", "\xC3\xA9", "\"\n\"", "\"\"\"\""};
  static constexpr const char* kBadRows[] = {
      "1,2", "1,2,3,4,5", "1,,3,n", "a,2,3,n", "1e999,2,3,n", "4713,2,3,n", "\"1\n\",2,3,n", "1,2,,\"\n\"", ",,,",
      "1,2,3,x,\"y\nz\"", "NaN,1,2,n", "\"1,2,3,x\nq\",2"};
  // clang-format on
  const std::string ending = oneIn(4) ? "\r\n" : "\n";
  std::string all = oneIn(8) ? "\xEF\xBB\xBF" : "";
  const bool header = !oneIn(6);
  if (oneIn(6)) all += ending;
  if (header) all += (oneIn(5) ? "x,\"y\",z,\"na\nme\"" : "x,y,z,name") + ending;
  for (std::size_t i = 0; i < records; ++i) {
    if (bad > 0 && oneIn(bad))
      all += oneOf(kBadRows);
    else if (oneIn(8))
      all += "\"" + std::to_string(below(100)) + "\"," + number() + "," + number() + "," + oneOf(kCells);
    else
      all += number() + "," + number() + "," + number() + "," + (header || i > 0 ? oneOf(kCells) : "1");
    if (i + 1 < records || !oneIn(4)) all += ending;
    if (oneIn(15)) all += oneIn(2) ? " \t" + ending : ending;
  }
  if (bad > 0 && oneIn(6)) all += "1,2,3,\"not closed\n4,5,6,a\n";
  return all;
}

std::string RandomText::text(std::size_t records, std::size_t bad) {
  // clang-format off
  static constexpr const char* kBad[] = {
      "1 2", "1 2 3 4 5", "a b c", "1 2 NaN", "1 2 1e999", "4713 2 3", "0 0 0 0", "1,2,3"};
  static constexpr const char* kBlank[] = {
      " ", "\t", "   "};
  // clang-format on
  const std::string ending = oneIn(4) ? "\r\n" : "\n";
  std::string all;
  for (std::size_t i = 0; i < records; ++i) {
    if (bad > 0 && i > 0 && oneIn(bad))
      all += oneOf(kBad);
    else
      all += (oneIn(5) ? "  " : "") + number() + oneOf(kBlank) + "+1.5" + oneOf(kBlank) + ".5" +
             (oneIn(6) ? " 2" : "") + (oneIn(6) ? " " : "");
    if (i + 1 < records || !oneIn(4)) all += ending;
    if (oneIn(12)) all += ending;
  }
  return all;
}

std::string RandomText::f64(std::size_t records, std::size_t bad) {
  constexpr double kOdd[] = {
      std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 4713, 1e308, -1e308, 0};
  std::string all;
  for (std::size_t i = 0; i < 3 * records; ++i) {
    double value = static_cast<double>(below(20000)) / 7 - 1000;
    if (bad > 0 && i > 0 && oneIn(3 * bad)) value = oneOf(kOdd);
    char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    all.append(bytes, sizeof value);
  }
  if (bad > 0 && oneIn(3)) all.append(1 + below(23), '\3');
  return all;
}

}  // namespace viewproj::tests
