// A photo under a picture.
#include "picture/picture.hpp"
#include "text/error.hpp"
#include "text/file.hpp"
#include "text/number.hpp"

namespace viewproj::cmd {
namespace {

struct Image {
  const char* type;
  std::size_t width, height;
};

std::size_t numberAt(const std::string& bytes, std::size_t at, std::size_t count) {
  std::size_t value = 0;
  for (std::size_t i = at; i < at + count; ++i) value = value << 8 | static_cast<unsigned char>(bytes[i]);
  return value;
}

/// The size is in the first chunk (PNG specification, 11.2.1).
std::optional<Image> readPng(const std::string& bytes) {
  constexpr std::size_t kWidth = 16, kHeight = 20, kEnd = 24;
  if (!bytes.starts_with("\x89PNG\r\n\x1A\n") || bytes.size() < kEnd) return std::nullopt;
  return Image{"image/png", numberAt(bytes, kWidth, 4), numberAt(bytes, kHeight, 4)};
}

/// The size is in the segment that starts a frame: C0 to CF but for DHT, JPG and DAC (ITU T.81, table B.1).
std::optional<Image> readJpeg(const std::string& bytes) {
  if (!bytes.starts_with("\xFF\xD8\xFF")) return std::nullopt;
  for (std::size_t at = 2; at + 9 <= bytes.size();) {
    const std::size_t marker = numberAt(bytes, at, 2);
    if (marker < 0xFF00) return std::nullopt;
    if (marker == 0xFFFF) {  // filled
      ++at;
      continue;
    }
    const bool isFrame =
        marker >= 0xFFC0 && marker <= 0xFFCF && marker != 0xFFC4 && marker != 0xFFC8 && marker != 0xFFCC;
    if (isFrame) return Image{"image/jpeg", numberAt(bytes, at + 7, 2), numberAt(bytes, at + 5, 2)};
    at += 2 + numberAt(bytes, at + 2, 2);
  }
  return std::nullopt;
}

std::string base64(const std::string& bytes) {
  constexpr const char* kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t at = 0; at < bytes.size(); at += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - at);
    const std::size_t value = numberAt(bytes, at, count) << 8 * (3 - count);
    for (std::size_t i = 0; i < 4; ++i) out += i <= count ? kLetters[value >> (18 - 6 * i) & 63] : '=';
  }
  return out;
}

}  // namespace

Photo readPhoto(const std::string& file) {
  constexpr std::size_t kMostBytes = 64 << 20;
  const std::string bytes = readWholeFile(file, kMostBytes);
  std::optional<Image> image = readPng(bytes);
  if (!image) image = readJpeg(bytes);
  if (!image) throw InputError(shownName(file) + ": expected a JPEG or PNG file");
  return {shownName(file), std::string("data:") + image->type + ";base64," + base64(bytes),
          static_cast<double>(image->width), static_cast<double>(image->height)};
}

void requireSize(const Photo& photo, const Viewport& viewport) {
  const auto size = [](double width, double height) { return formatNumber(width) + " x " + formatNumber(height); };
  if (photo.width != viewport.width || photo.height != viewport.height)
    throw InputError(photo.name + ": has " + size(photo.width, photo.height) + " pixels, the camera " +
                     size(viewport.width, viewport.height));
}

}  // namespace viewproj::cmd
