#include <fmt/format.h>

#include "eval/drawing.hpp"
#include "eval/markup.hpp"

namespace saccade {
namespace {

std::string hex(const Colour& colour) {
  return fmt::format("#{:02x}{:02x}{:02x}", colour.red, colour.green, colour.blue);
}

std::string list(const std::vector<cv::Point2d>& points) {
  std::string text;
  for (const cv::Point2d& p : points)
    text += fmt::format("{}{:.2f},{:.2f}", text.empty() ? "" : " ", p.x, p.y);
  return text;
}

struct Writer {
  std::string operator()(const Line& line) const {
    const std::string dash =
        line.dash[0] > 0 ? fmt::format(" stroke-dasharray=\"{:g} {:g}\"", line.dash[0], line.dash[1]) : "";
    return fmt::format(
        "<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{:g}\"{} "
        "stroke-linejoin=\"round\"/>\n",
        list(line.points), hex(line.colour), line.width, dash);
  }
  std::string operator()(const Area& area) const {
    const std::string opacity = area.opacity < 1 ? fmt::format(" fill-opacity=\"{:g}\"", area.opacity) : "";
    return fmt::format("<polygon points=\"{}\" fill=\"{}\"{}/>\n", list(area.corners), hex(area.colour),
                       opacity);
  }
  std::string operator()(const Text& text) const {
    constexpr const char* kAnchor[] = {"start", "middle", "end"};
    const std::string turn = text.upwards ? fmt::format(" transform=\"rotate(-90 {:.2f} {:.2f})\"",
                                                        text.position.x, text.position.y)
                                          : "";
    return fmt::format(
        "<text x=\"{:.2f}\" y=\"{:.2f}\" font-size=\"{:g}\" text-anchor=\"{}\" fill=\"{}\"{}>{}"
        "</text>\n",
        text.position.x, text.position.y, text.size, kAnchor[static_cast<std::size_t>(text.anchor)],
        hex(text.colour), turn, escaped(text.text));
  }
};

}  // namespace

std::string to_svg(const Drawing& drawing) {
  std::string text = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:g}\" height=\"{1:g}\" viewBox=\"0 0 {0:g} "
      "{1:g}\" "
      "font-family=\"Helvetica, Arial, sans-serif\">\n<rect width=\"100%\" height=\"100%\" "
      "fill=\"#ffffff\"/>\n",
      drawing.width, drawing.height);
  for (const auto& shape : drawing.shapes) text += std::visit(Writer{}, shape);
  return text + "</svg>\n";
}

}  // namespace saccade
