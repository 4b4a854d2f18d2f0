#include "stream/block_reader.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

#include "records/record.hpp"
#include "text/csv.hpp"
#include "text/error.hpp"
#include "text/utf8.hpp"

namespace viewproj::cmd {
namespace {

constexpr std::size_t npos = std::string_view::npos;
constexpr std::string_view kBom = "\xEF\xBB\xBF";

std::size_t afterLastLine(std::string_view text) {
  const std::size_t end = text.rfind('\n');
  return end == npos ? 0 : end + 1;
}

/// In steps that compilers make vector instructions of.
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

bool mayBeginBom(std::string_view text) { return text.size() < kBom.size() && kBom.starts_with(text); }

}  // namespace

void ByteBuffer::reserve(std::size_t capacity) {
  if (capacity <= capacity_) return;
  std::unique_ptr<char[]> data(new char[capacity]);
  if (size_ > 0) std::memcpy(data.get(), data_.get(), size_);
  data_ = std::move(data);
  capacity_ = capacity;
}

void ByteBuffer::assign(std::string_view bytes) {
  reserve(bytes.size());
  if (!bytes.empty()) std::memmove(data_.get(), bytes.data(), bytes.size());
  size_ = bytes.size();
}

BlockReader::BlockReader(std::unique_ptr<InputFile> file, std::size_t block) : file_(std::move(file)), block_(block) {
  name_ = file_->name();
  total_ = file_->remaining();
}

BlockReader::BlockReader(const std::string& bytes) : atEnd_(true) { carried_.assign(bytes); }

void BlockReader::readMore(ByteBuffer& bytes, std::size_t most) {
  bytes.reserve(most);
  const std::size_t got = file_->read(bytes.data() + bytes.size(), most - bytes.size());
  bytes.resize(bytes.size() + got);
  atEnd_ = got == 0;
}

std::string_view BlockReader::firstBytes() {
  constexpr std::size_t kLongEnough = 64 << 10;
  /// How many tell the form; npos: more are needed.
  const auto enough = [](std::string_view text) {
    if (mayBeginBom(text)) return npos;
    const std::size_t bom = text.starts_with(kBom) ? kBom.size() : 0;
    const std::string_view record = afterComments(text.substr(bom));
    if (record.empty()) return npos;
    const std::size_t first = text.size() - record.size();
    const bool bracket = text[first] == '{' || text[first] == '[';
    const std::size_t most = bracket ? first + 2 : kLongEnough;  // the second may tell UTF-16
    const std::size_t end = std::min(text.find('\n', first), most);
    return end <= text.size() ? end : npos;
  };
  std::size_t end = npos;
  while ((end = enough(carried_.view())) == npos && !atEnd_ && carried_.size() < kLongEnough)
    readMore(carried_, carried_.size() + block_);
  return carried_.view().substr(0, std::min(end, kLongEnough));
}

void BlockReader::requireUtf8() {
  const auto mayBeWide = [&] {
    const std::string_view text = carried_.view();
    return text.size() < 2 || text[0] == 0 || text[1] == 0 || text[0] == '\xFF' || text[0] == '\xFE';
  };
  while (!atEnd_ && carried_.size() < 4 && mayBeWide()) readMore(carried_, carried_.size() + block_);
  requireNarrow(name_, carried_.view());
}

void BlockReader::setForm(Form form, const CsvFormat& format) {
  form_ = form;
  format_ = format;
  csv_ = CsvEnds(format_);
  if (form == Form::f64) return;
  while (!atEnd_ && mayBeginBom(carried_.view())) readMore(carried_, carried_.size() + block_);
  if (carried_.view().starts_with(kBom)) carried_.assign(carried_.view().substr(kBom.size()));
}

void BlockReader::readToLineBreak() {
  std::size_t had = carried_.size();
  do {
    had = carried_.size();
    readMore(carried_, had < carried_.capacity() ? carried_.capacity() : std::max(2 * had, block_));
  } while (!atEnd_ && carried_.size() < kLongestRecord && carried_.view().substr(had).find('\n') == npos);
}

std::optional<BlockReader::Line> BlockReader::firstLine(bool take) {
  std::size_t begin = 0;
  const auto drop = [&] {
    const std::string_view text = carried_.view();
    moveOn(text.substr(0, begin));
    carried_.assign(text.substr(begin));
    begin = 0;
  };
  for (CsvEnds ends(format_);;) {
    std::size_t end = ends.nextEnd(carried_.view().substr(begin));
    if (end == npos && !atEnd_) {
      drop();
      if (carried_.size() >= kLongestRecord) throw InputError(place(name_, position_) + ": " + tooLong());
      readToLineBreak();
      continue;
    }
    const std::string_view text = carried_.view().substr(begin);
    if (text.empty()) break;
    end = std::min(end, text.size());
    const std::string_view line = text.substr(0, end);
    if (isBlank(line)) {
      begin += std::min(end + 1, text.size());
      ends = CsvEnds(format_);
      continue;
    }
    drop();
    Line found{std::string(carried_.view().substr(0, end)), position_};
    if (found.text.ends_with('\r')) found.text.pop_back();
    if (take) {
      begin = std::min(end + 1, carried_.size());
      drop();
    }
    return found;
  }
  return std::nullopt;
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
  block.records = {};
  block.inArray = false;
  block.opening.clear();
  block.closing.clear();
  block.bad.clear();
  block.fault.reset();
  if (over_) return false;
  ByteBuffer& bytes = block.bytes;
  std::size_t whole = 0, from = 0;
  if (given_ > 0) {
    // What is much is not moved for each block.
    std::swap(bytes, carried_);
    from = std::exchange(given_, 0);
    whole = wholeRecords(block, bytes.view().substr(from));
    if (whole > 0 || !block.bad.empty()) {
      keepRest(block, from, whole);
      return true;
    }
    bytes.assign(bytes.view().substr(std::exchange(from, 0)));
  } else {
    bytes.assign(carried_.view());
  }
  carried_.resize(0);
  std::size_t most = std::max(block_, bytes.size());
  try {
    for (std::size_t lookedAt = npos;;) {
      const bool full = bytes.size() == most;
      if (atEnd_ || (bytes.size() != lookedAt && (full || !file_->isReady()))) {
        const std::string_view fresh = bytes.view().substr(lookedAt == npos ? 0 : lookedAt);
        lookedAt = bytes.size();
        whole = mayEndRecord(fresh) ? wholeRecords(block, bytes.view()) : 0;
        if (whole > 0 || atEnd_ || block.fault || !block.bad.empty()) break;
        // Of JSON the splitter knows; but not of white space where a record may begin a document.
        if (bytes.size() >= (form_ == Form::json ? 2 : 1) * kLongestRecord) {
          block.fault = {position_, tooLong()};
          break;
        }
        if (full) most *= 2;
      }
      readMore(bytes, most);
    }
  } catch (const InputError& e) {
    // What was read before goes out; a record that the error cut off does not.
    failed_ = true;
    whole = wholeRecords(block, bytes.view());
    block.fault = {{0, 0}, e.what()};
  }
  keepRest(block, from, whole);
  return whole > 0 || block.fault || !block.bad.empty();  // as where the input ends in an array
}

void BlockReader::keepRest(Block& block, std::size_t from, std::size_t whole) {
  ByteBuffer& bytes = block.bytes;
  const std::string_view text = bytes.view().substr(from);
  const std::size_t begin = block.records.data() ? static_cast<std::size_t>(block.records.data() - text.data()) : 0;
  const std::size_t size = block.records.data() ? block.records.size() : whole;
  moveOn(text.substr(0, begin));
  block.position = position_;
  moveOn(text.substr(begin, whole - begin));
  block.inputBytes = whole;
  const std::size_t rest = text.size() - whole;
  if (rest > block_) {
    std::swap(bytes, carried_);
    given_ = from + whole;
    bytes.assign(text.substr(0, whole));
  } else {
    carried_.assign(text.substr(whole));
    if (from > 0) bytes.assign(text.substr(0, whole));
    bytes.resize(whole);
  }
  block.records = bytes.view().substr(begin, size);
  lookedAt_ = 0;
  csv_ = CsvEnds(format_);
  block.last = atEnd_ && rest == 0;
  over_ = block.fault || block.last;
}

bool BlockReader::mayEndRecord(std::string_view fresh) const {
  return atEnd_ || form_ == Form::json || form_ == Form::f64 || fresh.find('\n') != npos;
}

std::size_t BlockReader::wholeRecords(Block& block, std::string_view text) {
  switch (form_) {
    case Form::json:
      return wholeJson(block, text);
    case Form::csv:
      return atEnd_ ? text.size() : csv_.lastEnd(text);
    case Form::text:
      return atEnd_ ? text.size() : afterLastLine(text);
    case Form::f64:
      break;
  }
  return atEnd_ ? text.size() : text.size() / kBinaryRecord * kBinaryRecord;
}

std::size_t BlockReader::wholeJson(Block& block, std::string_view text) {
  if (state_.place != JsonState::Place::top) return wholeArrayRecords(block, text);
  block.state = state_;
  const bool muchIsLeft = isMuch(text);
  if (atEnd_ && !muchIsLeft) return text.size();
  // What ends at a border is whole, be it right or wrong: whoever works on the block will see.
  std::size_t whole = 0;
  const std::size_t border = muchIsLeft ? npos : lastBorder(text, std::exchange(lookedAt_, text.size()));
  if (border != npos && !mayOpenArray(text.substr(0, border))) {
    state_ = {};
    state_.column = border - findLastLineBreak(text.substr(0, border)) - 1;
    splitter_ = JsonSplitter(state_);
    whole = border;
  }
  splitter_.explain(false);  // whoever works on the block will
  const auto end = atEnd_ ? JsonSplitter::End::ofInput : JsonSplitter::End::open;
  for (;;) {
    if (isFull(whole, text)) return whole;
    JsonPiece piece = splitter_.next(text.substr(whole), end);
    if (piece.event == JsonEvent::needMore) return whole;
    if (piece.event == JsonEvent::end) return text.size();
    if (piece.event == JsonEvent::beginArray) {
      const JsonSplitter afterOpening = splitter_;
      const std::size_t array = wholeArray(splitter_, text.substr(whole + piece.end));
      if (array == 0 && whole > 0) {
        splitter_ = JsonSplitter(state_);
        return whole;
      }
      if (array == 0) {
        splitter_ = afterOpening;
        state_ = splitter_.state();
        block.opening = piece.text;
        block.records = text.substr(piece.end, 0);
        return piece.end + wholeArrayRecords(block, text.substr(piece.end));
      }
      piece.end += array;
    }
    whole += piece.end;
    state_ = splitter_.state();
  }
}

/// Where the array ends whose opening bracket the splitter has passed; 0 if that cannot be said, or is far.
std::size_t BlockReader::wholeArray(JsonSplitter& splitter, std::string_view text) const {
  const auto atEnd = atEnd_ ? JsonSplitter::End::ofInput : JsonSplitter::End::open;
  for (std::size_t end = 0;;) {
    const JsonPiece piece = splitter.next(text.substr(end), atEnd);
    if (piece.event == JsonEvent::needMore) return 0;
    end += piece.end;
    if (piece.event == JsonEvent::endArray) return end;
    if (isFull(end, text)) return 0;
  }
}

std::size_t BlockReader::wholeArrayRecords(Block& block, std::string_view text) {
  block.inArray = true;
  splitter_.explain(true);
  char* const own = block.bytes.data() + (text.data() - block.bytes.data());
  std::size_t whole = 0;
  for (;;) {
    if (isFull(whole, text)) {
      state_ = splitter_.state();
      return whole;
    }
    const bool inDocument = splitter_.state().inDocument;
    const JsonPiece piece =
        splitter_.next(text.substr(whole), atEnd_ ? JsonSplitter::End::ofInput : JsonSplitter::End::open);
    const bool ends = piece.event == JsonEvent::endArray;
    if (!piece.message.empty())
      block.bad.push_back({ends ? whole + piece.at : static_cast<std::size_t>(piece.text.data() - text.data()),
                           whole + piece.at, piece.message});
    const std::size_t begin = whole;
    whole += piece.end;
    if (ends) {
      block.closing = !piece.message.empty() ? (inDocument ? "]}" : "]") : std::string(piece.text);
      block.records = text.substr(0, piece.message.empty() ? whole - piece.text.size() : whole);
    } else {
      block.records = text.substr(0, whole);
    }
    if (piece.event == JsonEvent::bad || piece.event == JsonEvent::passed || ends)
      for (std::size_t at = begin; at < whole; ++at)
        if (!isLineBreak(own[at])) own[at] = ' ';
    if (piece.event == JsonEvent::needMore || ends) {
      state_ = splitter_.state();
      return whole;
    }
  }
}

}  // namespace viewproj::cmd
