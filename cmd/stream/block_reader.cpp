#include "stream/block_reader.hpp"

#include <algorithm>
#include <utility>

#include "records/record.hpp"
#include "text/csv.hpp"
#include "text/error.hpp"
#include "text/json_scan.hpp"
#include "text/utf8.hpp"

namespace viewproj::cmd {
namespace {

constexpr std::size_t npos = std::string_view::npos;
constexpr std::string_view kBom = "\xEF\xBB\xBF";

/// Counts in steps that compilers turn into vector instructions.
std::size_t countLines(std::string_view text) {
  constexpr std::size_t kStep = 128;
  std::size_t lines = 0, at = 0;
  for (; at + kStep <= text.size(); at += kStep) {
    unsigned char here = 0;
    for (std::size_t i = 0; i < kStep; ++i) here = static_cast<unsigned char>(here + (text[at + i] == '\n'));
    lines += here;
  }
  return lines + static_cast<std::size_t>(std::count(text.begin() + at, text.end(), '\n'));
}

std::string tooLong() { return "a record longer than " + std::to_string(kLongestRecord >> 20) + " MiB"; }

/// Whether text may become a byte order mark, or another one, with more bytes.
bool mayBeginBom(std::string_view text) {
  using namespace std::string_view_literals;
  const auto begins = [&](std::string_view bom) { return text.size() < bom.size() && bom.starts_with(text); };
  return begins(kBom) || begins("\xFF\xFE\0\0"sv) || begins("\0\0\xFE\xFF"sv) || begins("\xFE\xFF");
}

/// How many of the first bytes are enough to tell the format; npos if more are needed.
std::size_t countTelling(std::string_view text, std::size_t most) {
  if (mayBeginBom(text)) return npos;
  const std::string_view record = afterComments(text.substr(text.starts_with(kBom) ? kBom.size() : 0));
  if (record.empty()) return npos;
  const std::size_t first = text.size() - record.size();
  const std::size_t last = opensJson(text[first]) ? first + 2 : most;  // the second byte may show UTF-16
  const std::size_t end = std::min(text.find('\n', first), last);
  return end <= text.size() ? end : npos;
}

}  // namespace

BlockReader::BlockReader(std::unique_ptr<InputFile> file, std::size_t block)
    : name_(file->name()), file_(std::move(file)), total_(file_->remaining()), block_(block) {}

void BlockReader::readMore(TextBuffer& bytes, std::size_t most) {
  char* const to = bytes.room(most - bytes.size());
  const std::size_t got = file_->read(to, most - bytes.size());
  bytes.written(to + got);
  atEnd_ = got == 0;
}

void BlockReader::drop(std::size_t bytes) {
  const std::string rest(carried_.view().substr(bytes));
  moveOn(carried_.view().substr(0, bytes));
  carried_.clear();
  carried_ += rest;
}

std::string_view BlockReader::firstBytes() {
  constexpr std::size_t kLongEnough = 64 << 10;
  std::size_t end = countTelling(carried_.view(), kLongEnough);
  while (end == npos && !atEnd_ && carried_.size() < kLongEnough) {
    readMore();
    end = countTelling(carried_.view(), kLongEnough);
  }
  return carried_.view().substr(0, std::min(end, kLongEnough));
}

void BlockReader::setForm(Form form, char separator) {
  form_ = form;
  separator_ = separator;
  csv_ = CsvEnds(separator);
  if (form == Form::f64) return;
  while (!atEnd_ && mayBeginBom(carried_.view())) readMore();
  requireNarrow(name_, carried_.view());
  if (carried_.view().starts_with(kBom)) drop(kBom.size());
  position_ = {};
}

std::optional<BlockReader::Line> BlockReader::firstLine() {
  for (CsvEnds ends(separator_);; readMore()) {
    const std::string_view text = carried_.view();
    const std::size_t known = atEnd_ ? text.size() : ends.lastEnd(text);
    for (std::size_t begin = 0, end; begin < known; begin = end + 1) {
      end = endOfCsvRecord(text, begin, separator_);
      std::string line(text.substr(begin, end - begin));
      if (isBlank(line)) continue;
      if (line.ends_with('\r')) line.pop_back();
      drop(begin);
      firstLineEnd_ = std::min(end + 1 - begin, carried_.size());
      return Line{std::move(line), position_};
    }
    if (atEnd_) return std::nullopt;
    if (known > 0) {
      drop(known);
      ends = CsvEnds(separator_);
    }
    if (carried_.size() >= kLongestRecord) throw InputError(place(name_, position_) + ": " + tooLong());
  }
}

void BlockReader::moveOn(std::string_view text) {
  if (form_ == Form::f64) {
    position_.line += text.size() / kBinaryRecord;
    return;
  }
  const std::size_t lines = countLines(text);
  position_.line += lines;
  position_.column = lines > 0 ? text.size() - text.rfind('\n') : position_.column + text.size();
}

bool BlockReader::next(Block& block) {
  if (over_) return false;
  TextBuffer& bytes = block.bytes;
  bytes.clear();
  bytes += carried_.view();
  block.position = position_;
  block.state = state_;
  std::size_t complete = 0;
  try {
    for (std::size_t had = npos, most = std::max(block_, bytes.size());;) {
      const bool full = bytes.size() >= most;
      if (atEnd_ || (bytes.size() != had && (full || !file_->isReady()))) {
        had = bytes.size();
        complete = completeRecords(bytes.view());
        if (complete > 0 || atEnd_) break;
        if (bytes.size() >= kLongestRecord) {
          block.fault = {position_, tooLong()};
          break;
        }
        if (full) most += block_;
      }
      readMore(bytes, most);
    }
  } catch (const InputError& e) {
    // Everything before the error is written, up to the last complete record. A record that the error cut off is not.
    if (form_ == Form::json) searched_ = bytes.size();
    complete = completeRecords(bytes.view());
    block.fault = {{0, 0}, e.what()};
  }
  carried_.clear();
  carried_ += bytes.view().substr(complete);
  bytes.truncate(complete);
  moveOn(bytes.view());
  lookedAt_ -= std::min(complete, lookedAt_);
  completeEnd_ = searched_ = 0;
  csv_ = CsvEnds(separator_);
  block.last = atEnd_ && carried_.empty();
  over_ = block.fault || block.last;
  return complete > 0 || block.fault || block.state.insideArray();
}

std::size_t BlockReader::completeRecords(std::string_view text) {
  if (atEnd_) return text.size();
  switch (form_) {
    case Form::json:
      return completeJson(text);
    case Form::csv:
      return csv_.lastEnd(text);
    case Form::text: {
      const std::size_t from = std::exchange(searched_, text.size()), end = text.substr(from).rfind('\n');
      return end == npos ? 0 : from + end + 1;
    }
    case Form::f64:
      break;
  }
  return text.size() / kBinaryRecord * kBinaryRecord;
}

/// Up to the last border. If there may be arrays, or if there is no border, looks at every byte.
std::size_t BlockReader::completeJson(std::string_view text) {
  if (completeEnd_ == 0 && !state_.insideArray() && !splitter_.state().insideArray()) {
    const std::size_t border = lastBorder(text, std::max(lookedAt_, std::exchange(searched_, text.size())));
    if (border != npos && !mayOpenArray(text.substr(0, border))) {
      splitter_ = JsonSplitter(state_ = {});
      lookedAt_ = border;
      return border;
    }
  }
  for (;;) {
    const JsonPiece piece = splitter_.next(text.substr(lookedAt_), JsonSplitter::End::open);
    if (piece.event == JsonEvent::needMore) return completeEnd_;
    lookedAt_ += piece.end;
    // A piece without bytes belongs to the block of the next piece. So does the beginning of an array, because by
    // itself it may be the beginning of a record.
    if (piece.end == 0 || splitter_.state().place == JsonState::Place::first) continue;
    completeEnd_ = lookedAt_;
    state_ = splitter_.state();
  }
}

}  // namespace viewproj::cmd
