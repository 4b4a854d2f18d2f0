// Sources: numpy.lib.format; PKWARE, APPNOTE.TXT (4.3, 4.4).
#include "text/npy.hpp"

#include <zlib.h>

#include <bit>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "text/error.hpp"
#include "text/npy_header.hpp"
#include "text/number.hpp"
#include "text/utf8.hpp"

namespace viewproj::cmd {
namespace {

using nlohmann::json;

constexpr std::size_t kMostNumbers = 1 << 20, kMostBytes = 64 << 20;

/// An unsigned integer of these bytes, the lowest one first.
std::uint64_t littleEndian(std::string_view bytes, std::size_t at, std::size_t size) {
  std::uint64_t number = 0;
  for (std::size_t i = size; i-- > 0;) number = number << 8 | static_cast<unsigned char>(bytes[at + i]);
  return number;
}

/// One of the kinds of numbers: a letter and a size.
json numberOf(char kind, std::string_view bytes, bool isBigEndian) {
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i)
    bits |= std::uint64_t{static_cast<unsigned char>(bytes[isBigEndian ? bytes.size() - 1 - i : i])} << (8 * i);
  const std::size_t size = 8 * bytes.size();
  if (kind == 'f')
    return size == 64 ? std::bit_cast<double>(bits) : double{std::bit_cast<float>(static_cast<std::uint32_t>(bits))};
  if (kind == 'b') return bits != 0;
  if (kind == 'u') return bits;
  return static_cast<std::int64_t>(bits << (64 - size)) >> (64 - size);
}

class Array {
 public:
  Array(const std::string& name, std::string_view bytes) : name_(name), bytes_(bytes) { readHeader(); }

  bool isNumbers() const {
    const std::size_t size = size_;
    return kind_ == 'f'                     ? size == 4 || size == 8
           : (kind_ == 'i' || kind_ == 'u') ? std::has_single_bit(size) && size <= 8
                                            : kind_ == 'b' && size == 1;
  }
  bool isSmall() const { return count_ <= kMostNumbers; }
  char kind() const { return kind_; }

  json values() const {
    if (count_ == 0) return json::array();
    if (bytes_.size() - data_ < count_ * size_) fail("ends inside its numbers");
    return valuesOf(0, 0, 1);
  }

 private:
  [[noreturn]] void fail(const std::string& message) const { throw InputError(name_ + ": " + message); }

  void readHeader() {
    const std::size_t size = npyHeaderSize(name_, bytes_);
    if (size == 0 || size > bytes_.size()) fail("ends inside its header");
    const NpyHeader header = readNpyHeader(name_, bytes_);
    data_ = header.size;
    isByColumns_ = header.isFortranOrder;
    if (header.type.size() < 3 || header.type.starts_with('[')) return;  // a record: no numbers
    isBigEndian_ = header.type[0] == '>';
    kind_ = header.type[1];
    for (std::size_t i = 2; i < header.type.size() && isDigit(header.type[i]) && size_ < 1000; ++i)
      size_ = 10 * size_ + static_cast<std::size_t>(header.type[i] - '0');
    shape_ = header.shape;
    if (shape_.size() > 8) fail("has more than 8 dimensions");
    count_ = 1;
    for (std::size_t& extent : shape_) {
      extent = std::min(extent, kMostBytes);
      count_ = std::min(count_ * extent, kMostBytes);
    }
  }

  /// index: of the first number below here; step: between the numbers of this dimension, of an array by columns.
  json valuesOf(std::size_t dimension, std::size_t index, std::size_t step) const {
    if (dimension == shape_.size()) return numberOf(kind_, bytes_.substr(data_ + index * size_, size_), isBigEndian_);
    std::size_t inner = 1;
    for (std::size_t d = dimension + 1; d < shape_.size(); ++d) inner *= shape_[d];
    json list = json::array();
    for (std::size_t i = 0; i < shape_[dimension]; ++i)
      list.push_back(isByColumns_ ? valuesOf(dimension + 1, index + i * step, step * shape_[dimension])
                                  : valuesOf(dimension + 1, index + i * inner, 1));
    return list;
  }

  const std::string& name_;
  std::string_view bytes_;
  std::size_t data_ = 0, size_ = 0, count_ = 0;
  char kind_ = ' ';
  bool isBigEndian_ = false, isByColumns_ = false;
  std::vector<std::size_t> shape_;
};

std::string inflated(const std::string& name, std::string_view packed, std::size_t size) {
  std::string bytes(size, '\0');
  z_stream stream{};
  if (inflateInit2(&stream, -MAX_WBITS) != Z_OK) throw std::bad_alloc();
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  stream.avail_in = static_cast<uInt>(packed.size());
  stream.next_out = reinterpret_cast<Bytef*>(bytes.data());
  stream.avail_out = static_cast<uInt>(bytes.size());
  const int status = inflate(&stream, Z_FINISH);
  inflateEnd(&stream);
  if (status != Z_STREAM_END || stream.avail_out != 0)
    throw InputError(name + ": has a member that is not compressed as zip does");
  return bytes;
}

json readZip(const std::string& name, std::string_view zip) {
  const auto fail = [&](const char* message) { throw InputError(name + ": " + message); };
  constexpr std::size_t kEnd = 22, kEntry = 46, kLocal = 30;
  const std::size_t end = zip.rfind("PK\5\6");
  if (end == std::string_view::npos || zip.size() - end < kEnd) fail("is a zip that is cut off");
  const std::size_t entries = littleEndian(zip, end + 10, 2);
  std::size_t at = littleEndian(zip, end + 16, 4), total = 0;
  json members = json::object();
  for (std::size_t i = 0; i < entries; ++i) {
    if (at > zip.size() || zip.size() - at < kEntry || zip.substr(at, 4) != "PK\1\2")
      fail("is a zip with a broken list of files");
    const std::size_t method = littleEndian(zip, at + 10, 2), packed = littleEndian(zip, at + 20, 4);
    const std::size_t size = littleEndian(zip, at + 24, 4), local = littleEndian(zip, at + 42, 4);
    const std::size_t nameSize = littleEndian(zip, at + 28, 2);
    std::string_view member = zip.substr(at + kEntry, nameSize);
    at += kEntry + nameSize + littleEndian(zip, at + 30, 2) + littleEndian(zip, at + 32, 2);
    if (!member.ends_with(".npy")) continue;
    member.remove_suffix(4);
    if (local > zip.size() || zip.size() - local < kLocal) fail("is a zip with a broken list of files");
    const std::size_t data = local + kLocal + littleEndian(zip, local + 26, 2) + littleEndian(zip, local + 28, 2);
    if (data > zip.size() || zip.size() - data < packed) fail("is a zip that is cut off");
    total += size;
    if (total > kMostBytes) fail("holds more than 64 MiB, the most that is read");
    if (method != 0 && method != 8) fail("is compressed in another way than zip's usual one");
    const std::string place = name + ": " + visible(member);
    const std::string bytes =
        method == 0 ? std::string(zip.substr(data, packed)) : inflated(place, zip.substr(data, packed), size);
    const Array array(place, bytes);
    members[visible(member)] = array.isNumbers() && array.isSmall() ? array.values() : json();
  }
  if (members.empty()) fail("is a zip without arrays of numpy; unpack it first");
  return members;
}

}  // namespace

bool isNumpy(std::string_view bytes) { return bytes.starts_with(kNpyMagic) || bytes.starts_with("PK\3\4"); }

json readNumpy(const std::string& name, std::string_view bytes) {
  if (!bytes.starts_with(kNpyMagic)) return readZip(name, bytes);
  const Array array(name, bytes);
  if (array.kind() == 'O')
    throw InputError(name + ": holds Python objects, which are not read; save np.array(x, float)");
  if (!array.isNumbers()) throw InputError(name + ": holds no numbers");
  if (!array.isSmall()) throw InputError(name + ": holds more than a million numbers; keep the camera's");
  return array.values();
}

}  // namespace viewproj::cmd
