// Cases in the manner of a JSON parsing suite: y_ is valid, n_ is not, i_ is up to the parser, which is nlohmann-json.
// Each as a field's value in a record alone, and in the second record of three.
#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "catch.hpp"
#include "stream/run.hpp"

using namespace viewproj;
using namespace viewproj::cmd;
using namespace viewproj::tests;

namespace {

struct Case {
  const char* name;
  std::string value;
};

std::string repeated(const std::string& text, std::size_t count) {
  std::string all;
  for (std::size_t i = 0; i < count; ++i) all += text;
  return all;
}

/// With NUL bytes, which a literal has too.
template <std::size_t N>
std::string bytes(const char (&literal)[N]) {
  return {literal, N - 1};
}

const Case kValues[] = {
    {"y_array_empty", "[]"},
    {"y_array_of_null", "[null]"},
    {"y_array_with_spaces", "[ 1 , 2 ]"},
    {"y_array_with_tabs_and_line_breaks", "[\t1\r\n,\n2 ]"},
    {"y_array_of_every_kind", "[null,1,\"1\",{},[],true,false]"},
    {"y_array_nested", "[[[[[[[[]]]]]]]]"},
    {"y_array_of_objects", "[{},{\"a\":[]}]"},
    {"y_object_empty", "{}"},
    {"y_object_empty_key", "{\"\":0}"},
    {"y_object_escaped_key", "{\"\\u0061\\n\":0}"},
    {"y_object_key_twice", "{\"a\":1,\"a\":2}"},
    {"y_object_with_nul_in_key", "{\"a\\u0000b\":1}"},
    {"y_object_with_line_breaks", "{\n\"a\"\n:\n1\n}"},
    {"y_object_nested", "{\"a\":{\"b\":{\"c\":{}}}}"},
    {"y_number_zero", "0"},
    {"y_number_minus_zero", "-0"},
    {"y_number_minus_zero_with_fraction", "-0.0"},
    {"y_number_integer", "123"},
    {"y_number_negative", "-123"},
    {"y_number_fraction", "123.456789"},
    {"y_number_exponent", "1e5"},
    {"y_number_exponent_capital", "1E5"},
    {"y_number_exponent_plus", "1e+5"},
    {"y_number_exponent_minus", "1E-5"},
    {"y_number_exponent_leading_zeros", "1e005"},
    {"y_number_zero_with_exponent", "0e1"},
    {"y_number_zero_with_exponent_plus", "0e+1"},
    {"y_number_fraction_and_exponent", "123.456e78"},
    {"y_number_of_20_digits", "12345678901234567890"},
    {"y_number_of_30_digits", "123456789012345678901234567890"},
    {"y_number_2_to_64", "18446744073709551616"},
    {"y_number_below_int64", "-9223372036854775809"},
    {"y_number_largest_double", "1.7976931348623157e308"},
    {"y_number_smallest_double", "5e-324"},
    {"y_number_underflow", "1e-999"},
    {"y_number_underflow_negative", "-1e-999"},
    {"y_number_of_many_digits", "0." + repeated("1234567890", 100)},
    {"y_number_of_many_zeros", "1" + repeated("0", 300)},
    {"y_string_empty", "\"\""},
    {"y_string_space", "\" \""},
    {"y_string_escapes", "\"\\\"\\\\\\/\\b\\f\\n\\r\\t\""},
    {"y_string_backslash_at_its_end", "\"a\\\\\""},
    {"y_string_backslash_and_quote", "\"\\\\\\\"\""},
    {"y_string_escaped_control", "\"\\u0012\""},
    {"y_string_escaped_nul", "\"\\u0000\""},
    {"y_string_escape_of_noncharacter", "\"\\uFFFF\""},
    {"y_string_surrogates", "\"\\uD834\\uDD1E\""},
    {"y_string_surrogates_lower_case", "\"\\ud83d\\ude39\\ud83d\\udc8d\""},
    {"y_string_last_surrogates", "\"\\uDBFF\\uDFFF\""},
    {"y_string_utf8_two_bytes", "\"\xC3\xA9\""},
    {"y_string_utf8_three_bytes", "\"\xE2\x82\xAC\""},
    {"y_string_utf8_four_bytes", "\"\xF0\x9D\x84\x9E\""},
    {"y_string_utf8_last", "\"\xF4\x8F\xBF\xBF\""},
    {"y_string_utf8_noncharacter", "\"\xEF\xBF\xBF\""},
    {"y_string_utf8_line_separator", "\"\xE2\x80\xA8\""},
    {"y_string_delete", "\"\x7F\""},
    {"y_string_byte_order_mark_inside", "\"\xEF\xBB\xBF\""},
    {"y_string_of_brackets", "\"]}[{\""},
    {"y_string_of_a_record", "\"}\\n{\\\"x\\\":1}\""},
    {"y_string_comment", "\"/* */\""},
    {"y_string_long", "\"" + repeated("abcdefgh", 5000) + "\""},
    {"y_string_of_backslashes", "\"" + repeated("\\\\", 2000) + "\""},
    {"y_true", "true"},
    {"y_false", "false"},
    {"y_null", "null"},
    {"y_structure_500_arrays", repeated("[", 500) + repeated("]", 500)},
    {"y_structure_deeper_than_1024", repeated("[", 1500) + repeated("]", 1500)},
    {"y_structure_100000_arrays", repeated("[", 100000) + repeated("]", 100000)},
    {"y_structure_100000_objects", repeated("{\"a\":", 100000) + "1" + repeated("}", 100000)},
    {"y_structure_space_within", repeated(" ", 3000) + "1" + repeated("\t", 3000)},
    {"n_array_comma_first", "[,1]"},
    {"n_array_comma_last", "[1,]"},
    {"n_array_comma_twice", "[1,,2]"},
    {"n_array_comma_alone", "[,]"},
    {"n_array_comma_missing", "[1 2]"},
    {"n_array_comma_missing_between_arrays", "[[1][2]]"},
    {"n_array_comma_missing_before_array", "[1[2]]"},
    {"n_array_colon", "[1:2]"},
    {"n_array_unclosed", "[1"},
    {"n_array_unclosed_behind_comma", "[1,"},
    {"n_array_closed_twice", "[1]]"},
    {"n_array_closed_by_brace", "[1}"},
    {"n_array_nested_unclosed", "[[1]"},
    {"n_array_star", "[*]"},
    {"n_array_of_dashes", "[-]"},
    {"n_array_name", "[a]"},
    {"n_array_form_feed", "[\f]"},
    {"n_array_invalid_utf8", "[\xFF]"},
    {"n_array_broken_last_item", "[1,2[[]]]"},
    {"n_object_comma_last", "{\"a\":1,}"},
    {"n_object_comma_first", "{,\"a\":1}"},
    {"n_object_comma_twice", "{\"a\":1,,\"b\":2}"},
    {"n_object_comma_missing", "{\"a\":1 \"b\":2}"},
    {"n_object_comma_for_colon", "{\"a\",1}"},
    {"n_object_colon_missing", "{\"a\" 1}"},
    {"n_object_colon_twice", "{\"a\"::1}"},
    {"n_object_value_missing", "{\"a\":}"},
    {"n_object_key_alone", "{\"a\"}"},
    {"n_object_key_number", "{1:1}"},
    {"n_object_key_null", "{null:1}"},
    {"n_object_key_without_quotes", "{a:1}"},
    {"n_object_key_in_single_quotes", "{'a':1}"},
    {"n_object_unclosed", "{\"a\":1"},
    {"n_object_closed_by_bracket", "{\"a\":1]"},
    {"n_object_bracket_for_key", "{[]:1}"},
    {"n_object_lone_continuation_in_key", "{\"\xB9\":1}"},
    {"n_number_plus", "+1"},
    {"n_number_leading_zero", "01"},
    {"n_number_leading_zeros", "00"},
    {"n_number_minus_leading_zero", "-01"},
    {"n_number_minus_alone", "-"},
    {"n_number_minus_twice", "--1"},
    {"n_number_minus_space", "- 1"},
    {"n_number_point_first", ".5"},
    {"n_number_minus_point", "-.5"},
    {"n_number_point_last", "1."},
    {"n_number_point_before_exponent", "1.e1"},
    {"n_number_point_twice", "1.2.3"},
    {"n_number_exponent_empty", "1e"},
    {"n_number_exponent_plus_alone", "1e+"},
    {"n_number_exponent_twice", "1e2e3"},
    {"n_number_exponent_of_zero_empty", "0e"},
    {"n_number_exponent_fraction", "1e1.5"},
    {"n_number_hexadecimal", "0x42"},
    {"n_number_hexadecimal_letters", "0xFF"},
    {"n_number_nan", "NaN"},
    {"n_number_infinity", "Infinity"},
    {"n_number_minus_infinity", "-Infinity"},
    {"n_number_inf", "inf"},
    {"n_number_letter_behind", "1a"},
    {"n_number_separator", "1_000"},
    {"n_number_fullwidth_digit", "\xEF\xBC\x91"},
    {"n_number_utf8_broken_behind", "1\xE5"},
    {"n_number_space_inside", "1 000"},
    {"n_number_expression", "1+2"},
    {"n_string_unclosed", "\"a"},
    {"n_string_quote_alone", "\""},
    {"n_string_single_quotes", "'a'"},
    {"n_string_without_quotes", "abc"},
    {"n_string_escape_unknown", "\"\\x00\""},
    {"n_string_escape_capital", "\"\\N\""},
    {"n_string_escape_of_byte", "\"\\\xE5\""},
    {"n_string_escape_of_emoji", "\"\\\xF0\x9F\x8C\x80\""},
    {"n_string_escape_of_control", bytes("\"\\\0\"")},
    {"n_string_escape_cut_off", "\"\\u00A\""},
    {"n_string_escape_no_digits", "\"\\u\""},
    {"n_string_escape_letters", "\"\\uqqqq\""},
    {"n_string_high_surrogate_alone", "\"\\uD800\""},
    {"n_string_high_surrogate_and_letter", "\"\\uD800a\""},
    {"n_string_high_surrogate_twice", "\"\\uD800\\uD800\""},
    {"n_string_high_surrogate_and_newline", "\"\\uD800\\n\""},
    {"n_string_high_surrogate_and_cut_escape", "\"\\uD800\\u\""},
    {"n_string_low_surrogate_alone", "\"\\uDC00\""},
    {"n_string_surrogates_exchanged", "\"\\uDD1E\\uD834\""},
    {"n_string_control_byte", "\"\x1F\""},
    {"n_string_tab", "\"\t\""},
    {"n_string_nul", bytes("\"a\0b\"")},
    {"n_string_utf8_continuation_alone", "\"\x81\""},
    {"n_string_utf8_overlong_two", "\"\xC0\xAF\""},
    {"n_string_utf8_overlong_three", "\"\xE0\x80\xAF\""},
    {"n_string_utf8_overlong_nul", "\"\xC0\x80\""},
    {"n_string_utf8_surrogate", "\"\xED\xA0\x80\""},
    {"n_string_utf8_beyond_unicode", "\"\xF4\x90\x80\x80\""},
    {"n_string_utf8_cut_off", "\"\xE0\xFF\""},
    {"n_string_utf8_lead_alone", "\"\xC3\""},
    {"n_string_utf8_four_bytes_cut_off", "\"\xF0\x9D\x84\""},
    {"n_string_latin1", "\"\xE9\""},
    {"n_string_byte_ff", "\"\xFF\""},
    {"n_string_utf16", bytes("\"\0a\0b\"")},
    {"n_true_capital", "True"},
    {"n_true_cut_off", "tru"},
    {"n_false_long", "falsee"},
    {"n_null_capitals", "NULL"},
    {"n_nul", "nul"},
    {"n_undefined", "undefined"},
    {"n_structure_nothing", ""},
    {"n_structure_comment", "/* a */ 1"},
    {"n_structure_line_comment", "// a"},
    {"n_structure_hash", "#"},
    {"n_structure_byte_order_mark", "\xEF\xBB\xBF 1"},
    {"n_structure_nul", bytes("1\0")},
    {"n_structure_form_feed", "\f1"},
    {"n_structure_no_break_space", "\xC2\xA0 1"},
    {"n_structure_word_joiner", "\xE2\x81\xA0"},
    {"n_structure_two_values", "1 2"},
    {"n_structure_semicolon", "1;"},
    {"n_structure_parentheses", "(1)"},
    {"n_structure_angle_brackets", "<null>"},
    {"n_structure_100000_unclosed", repeated("[", 100000)},
    {"n_structure_100000_unclosed_objects", repeated("{\"a\":", 100000)},
    {"n_structure_100000_closed_short", repeated("[", 100000) + repeated("]", 99999)},
    {"i_number_beyond_double", "1e999"},
    {"i_number_beyond_double_negative", "-1e999"},
    {"i_number_exponent_beyond_int", "1e99999999999999999999"},
    {"i_number_exponent_below_int", "1e-99999999999999999999"},
    {"i_number_just_beyond_double", "1.7976931348623159e308"},
    {"i_number_of_400_digits", repeated("9", 400)},
    {"i_string_2_mebibytes", "\"" + repeated("0123456789abcdef", 131072) + "\""},
};

std::string recordWith(const std::string& value) { return "{\"x\":1,\"y\":2,\"z\":3,\"v\":" + value + "}"; }

std::size_t linesIn(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

std::string shown(const std::string& text) { return text.substr(0, 300); }

constexpr const char* kFirst = "{\"position\":[1,2,3],\"sum\":6,\"twice\":[2,4,6]}\n";
constexpr const char* kThird = "{\"position\":[4,5,6],\"sum\":15,\"twice\":[8,10,12]}\n";

void checkCase(const Case& one, std::size_t block) {
  const std::string record = recordWith(one.value);
  const bool valid = nlohmann::json::accept(record);
  INFO(one.name << ", block " << block);
  if (one.name[0] != 'i') CHECK(valid == (one.name[0] == 'y'));
  const std::string three = "[1,2,3]\n" + record + "\n[4,5,6]\n";
  const StreamHow how{.from = Form::json, .jobs = 2, .block = block};
  StreamHow keepGoing = how;
  keepGoing.keepGoing = true;
  const StreamRun alone = runStream(record, how), second = runStream(three, how), all = runStream(three, keepGoing);
  INFO("alone: " << shown(alone.out + alone.err) << "\nsecond: " << shown(second.out + second.err)
                 << "\nkeep going: " << shown(all.out + all.err));
  if (valid) {
    std::string line = record;
    std::erase(line, '\n');
    std::erase(line, '\r');
    line.pop_back();
    line.erase(line.find_last_not_of(" \t") + 1);  // blanks before the brace
    line += ",\"sum\":6,\"twice\":[2,4,6]}\n";
    CHECK(alone.status == 0);
    CHECK((alone.out == line && alone.err.empty()));
    CHECK((second.status == 0 && second.out == kFirst + line + kThird && second.err.empty()));
    CHECK(all == second);
    return;
  }
  CHECK((alone.status == 1 && alone.out.empty()));
  CHECK(alone.err.starts_with("<stdin>:1:"));
  CHECK(linesIn(alone.err) == 0);
  CHECK((second.status == 1 && second.out == kFirst));
  CHECK(second.err.starts_with("<stdin>:2:"));
  CHECK(linesIn(second.err) == 0);
  CHECK(all.status == 1);
  CHECK(all.err.starts_with("viewproj: <stdin>:2:"));
  CHECK(all.out.starts_with(std::string(kFirst) + "{\"line\":2,\"error\":\""));
  CHECK(all.out.ends_with(kThird));
  CHECK(linesIn(all.out) == linesIn(all.err) + 2);
  // A bracket too many or a line break in it make it more than one.
  if (one.name != std::string("n_array_closed_twice") && one.value.find_first_of("]}") == std::string::npos)
    CHECK(linesIn(all.err) == 1);
  for (std::size_t at = 0; at < all.out.size(); at = all.out.find('\n', at) + 1)
    CHECK(nlohmann::json::accept(all.out.substr(at, all.out.find('\n', at) - at)));
}

}  // namespace

TEST_CASE("the cases of a JSON parsing suite are judged as nlohmann-json judges") {
  std::set<std::string> names;
  for (const Case& one : kValues) {
    CHECK(names.insert(one.name).second);
    checkCase(one, BlockReader::kBlock);
    if (one.value.size() < 1000) checkCase(one, 16);
  }
  CHECK(names.size() >= 150);
}

TEST_CASE("whole inputs that are no stream of records get one message with its place") {
  const Case kInputs[] = {
      {"1:1: a number", "1"},
      {"1:1: a string", "\"abc\""},
      {"1:1: null", "null\n"},
      {"1:1: a word", "abc\n[1,2,3]"},
      {"1:1: a comma", ",[1,2,3]"},
      {"1:8: a comma between records", "[1,2,3],[4,5,6]\n"},
      {"1:1: a closing bracket", "]"},
      {"1:8: a closing bracket behind a record", "[1,2,3]]"},
      {"1:2: an array that does not end", "["},
      {"1:12: an object that does not end", "{\"x\":1,\"y\":"},
      {"1:9: an array that ends behind a record", "[[1,2,3]"},
      {"1:10: an array that ends behind a comma", "[[1,2,3],"},
      {"1:10: a comma before the end", "[[1,2,3],]"},
      {"2:1: a comma missing", "[[1,2,3]\n[4,5,6]]"},
      {"1:10: a comma missing on the line", "[[1,2,3] [4,5,6]]"},
      {"1:2: an array of commas", "[,]"},
      {"1:2: an array of words", "[abc]"},
      {"1:7: an array of strings that do not end", "[\"abc]"},
      {"1:1: an array that begins with null is one record", "[null,[1,2,3]]"},
      {"1:20: a document that does not end", "{\"points\":[[1,2,3]]"},
      {"1:21: a document with a comma too many", "{\"points\":[[1,2,3]],}"},
      {"1:25: a document with an invalid end", "{\"points\":[[1,2,3]],\"a\":}"},
      {"1:1: an object closed by a bracket", "{]"},
      {"1:1: numbers without brackets", "1,2,3"},
      {"1:1: a NUL", bytes("\0")},
      {"1:1: a word joiner", "\xE2\x81\xA0[1,2,3]"},
      {"1:1: a byte order mark twice", "\xEF\xBB\xBF\xEF\xBB\xBF[1,2,3]"},
      {"1:1: half a byte order mark", "\xEF\xBB[1,2,3]"},
      {"1:1: a comment", "/* */ [1,2,3]"},
      {"1:1: a form feed", "\f[1,2,3]"},
  };
  for (const Case& input : kInputs)
    for (const std::size_t block : {BlockReader::kBlock, std::size_t{3}}) {
      const StreamRun run = runStream(input.value, {.from = Form::json, .block = block});
      INFO(input.name << "\n" << run.out << run.err);
      CHECK(run.status == 1);
      CHECK(linesIn(run.err) == 0);
      const std::string place(input.name, std::string_view(input.name).find(' '));
      // Two closings are of the same array.
      if (input.value == "{]")
        CHECK(run.err.starts_with("<stdin>:1:"));
      else
        CHECK(run.err.substr(0, run.err.find(' ')) == "<stdin>:" + place);
      if (input.value.starts_with("[[")) CHECK(nlohmann::json::accept(run.out));
    }
  for (const char* nothing : {"", "\n", " \t\r\n\n", "\xEF\xBB\xBF", "\xEF\xBB\xBF\n"}) {
    const StreamRun run = runStream(nothing, {.from = Form::json});
    CHECK((run.status == 0 && run.out.empty() && run.err.empty()));
  }
}
