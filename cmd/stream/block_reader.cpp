#include "stream/block_reader.hpp"

#include <algorithm>
#include <utility>

#include "text/csv.hpp"
#include "text/json_scan.hpp"
#include "text/utf8.hpp"

namespace viewproj::cmd {
namespace {

constexpr std::size_t npos = std::string_view::npos;

/// While a record is not known to end: the size up to which it is looked at whenever the input pauses, and how long it
/// must pause for more, in milliseconds. So the work is linear in what arrives, or in the time that it takes.
constexpr std::size_t kSmall = 256 << 10;
constexpr int kPause = 20;

std::string tooLong() { return "a record longer than " + std::to_string(kLongestRecord >> 20) + " MiB"; }

/// How many of the first bytes are enough to tell the format; npos if more are needed.
std::size_t countTelling(std::string_view text, std::size_t most) {
  if (mayBeginByteOrderMark(text) || (text.size() < kNpyMagic.size() && kNpyMagic.starts_with(text))) return npos;
  const std::string_view record = afterComments(withoutByteOrderMark(text));
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

void BlockReader::passByteOrderMark() {
  while (!atEnd_ && mayBeginByteOrderMark(carried_.view())) readMore();
  requireNarrow(name_, carried_.view());
  drop(carried_.size() - withoutByteOrderMark(carried_.view()).size());
  position_ = {};
}

NpyHeader BlockReader::passNpyHeader() {
  std::size_t size = npyHeaderSize(name_, carried_.view());
  for (; !atEnd_ && (size == 0 || carried_.size() < size); size = npyHeaderSize(name_, carried_.view())) readMore();
  if (size == 0 || carried_.size() < size) throw InputError(name_ + ": ends inside its .npy header");
  NpyHeader header = readNpyHeader(name_, carried_.view());
  drop(size);
  position_ = {};
  return header;
}

std::optional<BlockReader::Line> BlockReader::firstLine(char separator) {
  for (CsvRecord record;; readMore()) {
    while (carried_.size() > 0) {
      record.split(carried_.view(), separator, 0);
      if (record.end == carried_.size() && !atEnd_) break;
      if (!record.fault.empty()) record.end = std::min(carried_.view().find('\n'), record.end);
      std::string line(carried_.view().substr(0, record.end));
      if (!isBlank(line)) {
        if (line.ends_with('\r')) line.pop_back();
        firstLineEnd_ = std::min(record.end + 1, carried_.size());
        return Line{std::move(line), position_};
      }
      drop(std::min(record.end + 1, carried_.size()));
    }
    if (atEnd_) return std::nullopt;
    if (carried_.size() >= kLongestRecord) throw InputError(place(name_, position_) + ": " + tooLong());
  }
}

void BlockReader::moveOn(std::string_view text) {
  if (ends_.record > 0) {
    position_.line += text.size() / ends_.record;
    return;
  }
  std::size_t lines = 0;  // faster than a count of every byte, for lines are long
  for (std::size_t at = text.find('\n'); at != npos; at = text.find('\n', at + 1)) ++lines;
  position_.line += lines;
  position_.column = lines > 0 ? text.size() - text.rfind('\n') : position_.column + text.size();
}

bool BlockReader::next(Block& block) {
  if (over_) return false;
  TextBuffer& bytes = block.bytes;
  bytes.clear();
  bytes += carried_.view();
  carried_.clear();
  block.position = position_;
  block.state = stateBeyond_ = state_;
  block.bad.reset();
  lookedAt_ = completeEnd_ = 0;
  std::size_t complete = 0;
  try {
    for (std::size_t had = npos, most = std::max(block_, bytes.size());;) {
      const bool isFull = bytes.size() >= most;
      if (atEnd_ || (bytes.size() != had && (isFull || !file_->isReady(bytes.size() < kSmall ? 0 : kPause)))) {
        had = bytes.size();
        complete = completeRecords(bytes.view());
        if (complete > 0 || atEnd_) break;
        if (bytes.size() >= kLongestRecord) {
          block.bad = {position_, tooLong()};
          break;
        }
        if (isFull) most *= 2;
      }
      readMore(bytes, most);
    }
  } catch (const InputError& e) {
    // Everything before the error is written, up to the last complete record. A record that the error cut off is not.
    complete = ends_.form == Form::json ? completeJson(bytes.view()) : completeRecords(bytes.view());
    block.fault = {{0, 0}, e.what()};
  }
  if (recordsLeft_) countRecords(block, complete);
  if (block.bad) {
    passLongRecord(block);
  } else {
    carried_ += bytes.view().substr(complete);
    bytes.truncate(complete);
    moveOn(bytes.view());
  }
  block.last = atEnd_ && carried_.empty();
  over_ = block.fault || block.last;
  return complete > 0 || block.fault || block.bad || block.state.insideArray();
}

void BlockReader::countRecords(Block& block, std::size_t& complete) {
  const std::size_t most = *recordsLeft_ * ends_.record;
  if (complete > most) {
    complete = most;
    block.fault = {{0, 0}, name_ + ": has more bytes than the rows that its header tells"};
  }
  *recordsLeft_ -= complete / ends_.record;
  if (atEnd_ && !block.fault && *recordsLeft_ > 0)
    block.fault = {{0, 0}, name_ + ": ends " + std::to_string(*recordsLeft_) + " rows before its header tells"};
}

/// Leaves what is before the record. Drops the record without keeping more of it than a block.
void BlockReader::passLongRecord(Block& block) try {
  TextBuffer& bytes = block.bytes;
  const bool isJson = ends_.form == Form::json;
  const std::size_t begin = isJson ? lookedAt_ : 0;
  TextBuffer rest;
  rest += bytes.view().substr(begin);
  bytes.truncate(begin);
  moveOn(bytes.view());
  block.bad->position = position_;
  const char bracket = rest.view()[0];
  BracketScan scan = stateBeyond_.scan;
  scan.firstLine = 0;
  if (scan.at == 0) scan.at = rest.size();  // no record, but text without an end
  for (std::size_t kept = 0;;) {
    const std::size_t passed = isJson ? scan.at : rest.size();
    const std::string left(rest.view().substr(passed));
    moveOn(rest.view().substr(kept, passed - kept));
    stateBeyond_.moveOver(rest.view().substr(kept, passed - kept));
    rest.clear();
    rest += bracket;
    rest += left;
    kept = 1;
    scan.line -= scan.at - 1;
    scan.at = 1;
    readMore(rest, block_ + 1 + rest.size());
    const std::string_view text = rest.view();
    std::size_t end = npos;
    if (!isJson || scan.closing.empty())
      end = text.find('\n', 1) == npos ? npos : text.find('\n', 1) + 1;
    else if (scanBrackets(text, stateBeyond_, atEnd_, scan))
      end = scan.closing.empty() ? scan.at : scan.firstLine > 0 ? scan.firstLine : text.size();
    if (end == npos && !atEnd_) continue;
    end = std::min(end, text.size());
    moveOn(text.substr(1, end - 1));
    state_ = stateBeyond_;
    state_.moveOver(text.substr(1, end - 1));
    state_.scan = {};
    if (state_.insideArray()) state_.place = JsonState::Place::bad;
    carried_ += text.substr(end);
    return;
  }
} catch (const InputError& e) {
  block.fault = {{0, 0}, e.what()};
}

std::size_t BlockReader::completeRecords(std::string_view text) {
  if (atEnd_) return text.size();
  switch (ends_.form) {
    case Form::json:
      // Most records are on lines of their own, and need no look at every byte.
      if (!stateBeyond_.insideArray() && lookedAt_ == 0) {
        const std::size_t border = lastBorder(text, 0);
        if (border != npos && !mayOpenArray(text.substr(0, border))) {
          state_ = {};
          return border;
        }
      }
      return completeJson(text);
    case Form::csv:
      return completeCsv(text);
    case Form::text: {
      const std::size_t end = text.rfind('\n');
      return end == npos ? 0 : end + 1;
    }
    default:
      return text.size() / ends_.record * ends_.record;
  }
}

std::size_t BlockReader::completeJson(std::string_view text) {
  for (;;) {
    const JsonPiece piece = nextPiece(text.substr(lookedAt_), stateBeyond_, JsonEnd::open);
    if (piece.event == JsonEvent::needMore) return completeEnd_;
    lookedAt_ += piece.end;
    // A piece without bytes belongs to the block of the next piece. So does the beginning of an array, because by
    // itself it may be the beginning of a record.
    if (piece.end == 0 || stateBeyond_.place == JsonState::Place::first) continue;
    completeEnd_ = lookedAt_;
    state_ = stateBeyond_;
  }
}

std::size_t BlockReader::completeCsv(std::string_view text) const {
  if (text.find('"') == npos) return text.rfind('\n') + 1;
  CsvRecord record;
  std::size_t complete = 0;
  for (std::size_t line; (line = text.find('\n', complete)) != npos;) {
    std::size_t end = line;
    if (text.substr(complete, line - complete).find('"') != npos) {
      record.split(text.substr(complete), ends_.separator, kMostFields);
      // What follows may close a quote that is open.
      const bool reachesEnd = complete + record.end == text.size();
      if (reachesEnd && text.size() < kLongestRecord) return complete;
      const bool isWhole = record.fault.empty() && record.fields.size() == ends_.columns;
      if (isWhole && !reachesEnd) end = complete + record.end;
    }
    complete = std::min(end + 1, text.size());
  }
  return complete;
}

}  // namespace viewproj::cmd
