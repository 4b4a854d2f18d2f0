#include "picture/sheet.hpp"

#include <algorithm>
#include <cstdio>

#include "text/utf8.hpp"

namespace viewproj::cmd {
namespace {

constexpr const char* kStyles[] = {
#include <picture_styles.inc>
};

/// With one decimal, if it is not 0.
std::string number(double value) {
  char digits[400];
  std::snprintf(digits, sizeof digits, "%.1f", value);
  std::string text = digits;
  if (text.ends_with(".0")) text.resize(text.size() - 2);
  return text == "-0" ? "0" : text;
}

std::string dataOf(const std::vector<Vec2>& line, bool isClosed = false) {
  std::string data;
  for (const Vec2& p : line) data += (data.empty() ? "M" : "L") + number(p.x) + "," + number(p.y);
  return data + (isClosed ? "Z" : "");
}

/// What XML has no place for, controls and U+FFFE, becomes U+FFFD.
std::string escaped(std::string_view text) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t begin = at;
    const char32_t code = nextCharacter(text, at);
    const bool isXml =
        code >= 0x20 ? code != 0xFFFE && code != 0xFFFF && code != kNoCharacter : code == '\t' || code == '\n';
    out += !isXml        ? "\xEF\xBF\xBD"
           : code == '&' ? "&amp;"
           : code == '<' ? "&lt;"
           : code == '>' ? "&gt;"
           : code == '"' ? "&quot;"
                         : std::string(text.substr(begin, at - begin));
  }
  return out;
}

std::string attribute(std::string_view name, std::string_view value) {
  return " " + std::string(name) + "=\"" + std::string(value) + "\"";
}

std::string styled(const char* element, std::string_view style) {
  return std::string("<") + element + attribute("class", style);
}

std::string path(std::string_view style, const std::string& data) {
  return styled("path", style) + attribute("d", data) + "/>\n";
}

std::string boxOf(const Rect& box) {
  return attribute("x", number(box.left)) + attribute("y", number(box.top)) +
         attribute("width", number(box.right - box.left)) + attribute("height", number(box.bottom - box.top));
}

/// inner: elements and escaped text.
std::string textElement(std::string_view style, const Vec2& at, std::string_view anchor, const std::string& inner) {
  return styled("text", style) + (anchor == "start" ? "" : attribute("text-anchor", anchor)) +
         attribute("x", number(at.x)) + attribute("y", number(at.y)) + ">" + inner + "</text>\n";
}

}  // namespace

void Sheet::addPhoto(const std::string& url) {
  in(Layer::photo).areas = styled("image", "photo") + attribute("preserveAspectRatio", "none") + boxOf(frame) +
                           attribute("href", url) + "/>\n";
}

void Sheet::addLine(Layer layer, const std::string& style, const std::vector<Vec2>& line, bool isClosed) {
  auto& lines = in(layer).lines;
  auto known = std::find_if(lines.begin(), lines.end(), [&](const auto& each) { return each.first == style; });
  if (known == lines.end()) known = lines.insert(known, {style, ""});
  known->second += dataOf(line, isClosed);
}

void Sheet::addPieces(const Pieces& pieces, const std::string& style, double weight) {
  constexpr double kOfHidden = 0.4, kShortest = 0.05;
  for (const Piece& piece : pieces) {
    if (!(largerSide(boundsOf(piece.line)) > kShortest)) continue;
    if (hasPhoto) addLine(Layer::halo, piece.isHidden ? "halo thin hid" : "halo", piece.line);
    addLine(Layer::lines, style + (piece.isHidden ? " hid" : ""), piece.line);
    labels.addInk(piece.line, weight * (piece.isHidden ? kOfHidden : 1));
    if (piece.isHidden) explain("hidden");
  }
}

void Sheet::addThin(Layer layer, const std::string& style, const Line& line, bool isClosed) {
  if (hasPhoto) addLine(layer, "halo thin", line, isClosed);
  addLine(layer, style, line, isClosed);
}

void Sheet::addFilled(Layer layer, const std::string& style, const std::vector<Line>& outlines) {
  std::string data;
  for (const Line& outline : outlines)
    if (outline.size() > 2) data += dataOf(outline, true);
  if (!data.empty()) in(layer).areas += path(style + (hasPhoto ? " glass" : ""), data);
}

void Sheet::addText(Layer layer, const TextStyle& style, const Vec2& at, const char* anchor, const std::string& text) {
  in(layer).areas += textElement(style.name, at, anchor, escaped(text));
  if (anchor == std::string_view("start"))
    end_ = {std::max(end_.x, at.x + textWidth(text, style)), std::max(end_.y, at.y)};
}

void Sheet::addSymbol(const std::string& elements, const Vec2& at) {
  in(Layer::texts).areas +=
      "<g transform=\"translate(" + number(at.x) + "," + number(at.y) + ")\">" + elements + "</g>\n";
}

void Sheet::addDot(const Vec2& at, double radius, bool isHollow) {
  constexpr double kSmall = 3;
  const std::string style = std::string(isHollow ? "dot hollow" : "dot") + (radius < kSmall ? " small" : "");
  in(Layer::marks).areas += styled("circle", style) + attribute("cx", number(at.x)) + attribute("cy", number(at.y)) +
                            attribute("r", number(radius)) + "/>\n";
  labels.addMark(around(at, radius, radius));
}

void Sheet::addCross(const Vec2& at, double size, bool isUpright) {
  const Vec2 first = isUpright ? Vec2{size, 0} : Vec2{size, size},
             second = isUpright ? Vec2{0, size} : Vec2{size, -size};
  for (const Vec2& arm : {first, second}) addLine(Layer::marks, "cross", {sum(at, -1, arm), sum(at, 1, arm)});
  labels.addMark(around(at, size, size));
}

void Sheet::addArrow(const Vec2& from, const Vec2& to, const std::string& style) {
  constexpr double kHead = 8, kHalfWidth = 0.42, kInk = 2;
  const double head = std::min(kHead, 0.6 * distance(from, to));
  const Vec2 way = wayFrom(from, to), side{-way.y, way.x}, neck = sum(to, -head, way);
  if (hasPhoto) addLine(Layer::halo, "halo", {from, to});
  addLine(Layer::marks, style, {from, neck});
  addLine(Layer::marks, style + " head", {to, sum(neck, kHalfWidth * head, side), sum(neck, -kHalfWidth * head, side)},
          true);
  labels.addInk({from, to}, kInk);
}

void Sheet::explain(const std::string& symbol, const std::string& text) {
  std::string& known = symbols_[symbol];
  if (known.find(text) == std::string::npos) known += (known.empty() ? "" : "; ") + text;
}

void Sheet::addName(const Label& label) {
  constexpr double kFromMark = 5, kBaseline = 0.36;
  const Spot& spot = *label.chosen;
  if (spot.mark && distance(*spot.mark, spot.leaderEnd()) > kFromMark)
    addLine(Layer::texts, "lead",
            {sum(*spot.mark, kFromMark, wayFrom(*spot.mark, spot.leaderEnd())), spot.leaderEnd()});
  std::string inner = escaped(label.text);
  if (!label.note.empty()) inner += "<tspan class=\"note\" dx=\"5\">" + escaped(label.note) + "</tspan>";
  in(Layer::texts).areas +=
      textElement(std::string(label.style.name) + (label.isFaint ? " faint" : ""),
                  {middleOf(spot.box).x, spot.box.bottom - kBaseline * label.style.size}, "middle", inner);
}

std::size_t Sheet::addNames() {
  std::size_t missing = 0;
  for (const Label& label : labels.place()) label.chosen ? addName(label) : void(++missing);
  return missing;
}

std::string Sheet::svg(const std::string& title) {
  constexpr double kMargin = 22, kTitleLine = 24;
  addText(Layer::texts, kTitle, {frame.left, kTitleLine}, "start", title);
  const Vec2 size{std::max(end_.x, frame.right) + kMargin, end_.y + kMargin};
  std::string out = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + number(size.x) + " " + number(size.y) +
                    "\" font-family=\"Helvetica, Arial, DejaVu Sans, sans-serif\"" +
                    (hasPhoto ? attribute("class", "over") : "") + ">\n<title>" + escaped(title) + "</title>\n" +
                    kStyles[0] + "<clipPath id=\"frame\"><rect" + boxOf(frame) + "/></clipPath>\n" +
                    styled("rect", "page") + boxOf({0, 0, size.x, size.y}) + "/>\n" + styled("rect", "sky") +
                    boxOf(frame) + "/>\n<g clip-path=\"url(#frame)\">\n";
  for (std::size_t i = 0; i < kLayers; ++i) {
    if (i == static_cast<std::size_t>(Layer::texts)) out += "</g>\n" + styled("rect", "frame") + boxOf(frame) + "/>\n";
    out += layers_[i].areas;
    for (const auto& [style, data] : layers_[i].lines) out += path(style, data);
  }
  return out + "</svg>\n";
}

}  // namespace viewproj::cmd
