#include "commands/stream_options.hpp"

#include <algorithm>
#include <cctype>

#include "output/output_file.hpp"
#include "records/points.hpp"
#include "text/csv.hpp"
#include "text/error.hpp"
#include "text/names.hpp"
#include "text/system.hpp"
#include "text/utf8.hpp"

namespace viewproj::cmd {
namespace {

/// What may stand between fields and be none of a number, a name or a quote.
bool isPunctuation(char c) { return std::string_view("!#$%&()*/:;<=>?@[\\]^`{|}~,").find(c) != std::string_view::npos; }

char readDelimiter(const std::string& option, const std::string& text) {
  for (const SeparatorName& one : kSeparators)
    if (text == one.name || text == std::string(1, one.separator)) return one.separator;
  if (text == "\\t") return '\t';
  if (text.size() == 1 && isPunctuation(text[0])) return text[0];
  std::vector<std::string_view> names;
  for (const SeparatorName& one : kSeparators) names.push_back(one.name);
  names.emplace_back("a character as ;");
  throw UsageError(option + " " + visible(text) + ": expected " + alternatives(names));
}

std::string readPrefix(const std::string& option, const std::string& text) {
  const bool isPlain = std::all_of(text.begin(), text.end(), [](unsigned char c) {
    return c >= 0x80 || std::isalnum(c) || c == '_' || c == '-' || c == '.' || c == ':';
  });
  if (!isPlain) throw UsageError(option + " " + text + ": expected letters, digits or any of _ - . :");
  return text;
}

constexpr std::size_t kMostJobs = 1024;

}  // namespace

void StreamOptions::addReading(CLI::App& app, const std::string& what, const char* keepGoing) {
  app_ = &app;
  addValue(app, "FILE", "", file_, readFileName, "The " + what + "; absent or - for standard input");
  const OptionGroup group(app, kStreamGroup);
  addChoice(app, "--from", "FORM", from_, namesOf(inputForms()), "Format of FILE", "by its name and first bytes");
  addValue(app, "--width", "N", width_, wholeNumber(1, kMostFields),
           "Numbers of f32 or f64 (3; of 4: --columns 1,2,3)");
  addValue(
      app, "--columns", "COLUMNS", columns_, readText,
      "Columns of CSV, fields of JSON (a.x: inside of a) or numbers of a line that hold the coordinates: in order, "
      "as in E,N,U or 2,3,4, or by role, as in x=E,y=N,z=U (default: by their names)");
  addValue(app, "--delimiter", "CHAR", delimiter_, readDelimiter,
           "Separator of CSV, in and out: comma, semicolon, tab or a character (default: by the header)");
  addFlag(app, "--keep-going", keepGoing_, keepGoing);
}

void StreamOptions::addInput(CLI::App& app, const std::string& what) {
  addReading(app, what, "Leave out each invalid record with a message and continue; status 1");
}

void StreamOptions::add(CLI::App& app, const std::string& what) {
  addReading(app, what,
             "Write an error record for each bad record and go on (check, draw, fit, measure: leave it out); status 1");
  const OptionGroup group(app, kStreamGroup);
  addForm(app, to_, outputForms(), "Output format", "as the input");
  addDigits(app, digits_, "all that tell the number from others; in tables 9");
  addValue(app, "--prefix", "P", prefix_, readPrefix, "Put this in front of the results' names");
  addValue(app, "--jobs", "N", jobs_, wholeNumber(1, kMostJobs), "Threads (default: one a processor)");
  addFlag(app, "--no-header", noHeader_, "Write CSV without a header line");
}

void StreamOptions::addPoints(CLI::App& app) {
  addValues(app, "--point", kPointForm, points_, readPointArgument, "A point, in place of FILE");
}

StreamSetup StreamOptions::setup(const ChoosableColumns& choosable) const {
  StreamSetup setup;
  setup.file = inputFile(*app_).value_or("-");
  setup.from = from_;
  setup.width = width_;
  setup.to = to_;
  setup.keepGoing = keepGoing_;
  setup.note = note;
  setup.jobs = std::min(static_cast<unsigned>(jobs_.value_or(kMostJobs)), countProcessors());  // more are slower
  setup.digits = static_cast<int>(digits_.value_or(0));
  setup.delimiter = delimiter_;
  setup.header = !noHeader_;
  setup.prefix = prefix_.value_or("");
  for (const PointArgument& point : points_) setup.given.push_back({point.text, point.json()});
  if (columns_) {
    setup.columns = chooseColumns(*columns_, choosable);
    setup.csvDefaults = setup.numberNames = setup.columns.columnNames();
    return setup;
  }
  for (const auto& rows : {choosable.rows.first(1), choosable.others})
    for (const Coordinate* row : rows)
      for (const CoordinatePart& part : row->parts) setup.csvDefaults.emplace_back(part.name);
  return setup;
}

void StreamOptions::settleOnEarth(StreamSetup& setup, bool worldIsEcef) const {
  for (const PointArgument& point : points_) point.requireFit(worldIsEcef);
  if (!worldIsEcef) return;
  const ColumnChoice& columns = setup.columns;
  if (columns.given() && !columns.hasRoles)
    throw UsageError("--columns " + columns.text + ": " + bareTriple("lat=..,lon=..,height=.. or x=..,y=..,z=.."));
  if (!columns.given()) setup.numberNames = setup.csvDefaults;
}

bool StreamOptions::reads(const StreamSetup& setup) const {
  const bool areTyped = !setup.given.empty(), readsFile = inputFile(*app_).has_value();
  if (areTyped && file_)
    throw UsageError("give either " + setup.given.front().option + " or the file " + *file_ +
                     (isGiven(*app_, "--camera") ? "" : "; -c FILE gives the camera"));
  const bool writes = hasOption(*app_, "--no-header");  // then the output may be CSV
  if (!readsFile)
    for (const char* const name : {"--from", "--width", "--columns", "--delimiter"})
      if (isGiven(*app_, name) && !(writes && std::string_view(name) == "--delimiter"))
        throw UsageError(std::string(name) + " is for FILE, and none is read");
  return areTyped || readsFile;
}

}  // namespace viewproj::cmd
