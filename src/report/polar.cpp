#include "src/report/polar.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace galet::report {

namespace {

constexpr double size = 460, centre = size / 2, outer = 175;

struct Scale {
  double largest = 1;
  double x(double length, double angle) const { return centre + outer * length / largest * std::cos(angle); }
  double y(double length, double angle) const { return centre - outer * length / largest * std::sin(angle); }
};

std::string wedge(const Scale& scale, double length, double from, double to) {
  const double radius = outer * length / scale.largest;
  return fmt::format("<path d=\"M{0:.1f} {0:.1f}L{1:.1f} {2:.1f}A{3:.1f} {3:.1f} 0 0 0 {4:.1f} {5:.1f}Z\"/>\n", centre,
                     scale.x(length, from), scale.y(length, from), radius, scale.x(length, to), scale.y(length, to));
}

std::string grid(const Scale& scale) {
  std::string text;
  for (const double level : {0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0}) {
    if (level > scale.largest || (scale.largest > 3 && std::fmod(level, 1.0) != 0)) continue;
    text += fmt::format("<circle cx=\"{0}\" cy=\"{0}\" r=\"{1:.1f}\" fill=\"none\" stroke=\"{2}\"{3}/>\n", centre,
                        outer * level / scale.largest, level == 1 ? "#333333" : "#cccccc",
                        level == 1 ? " stroke-dasharray=\"5 4\" stroke-width=\"1.4\"" : "");
    text += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"12\" fill=\"#555555\">{:g}</text>\n",
                        scale.x(level, -0.25) + 3, scale.y(level, -0.25) + 4, level);
  }
  return text;
}

}  // namespace

std::string polar_svg(const NumberTable& directions) {
  const auto angle = directions.find("angle"), density = directions.find("density"),
             force = directions.find("F_normal");
  if (!angle || !density || !force || directions.rows() == 0) return "";
  Scale scale;
  for (int row = 0; row < directions.rows(); ++row)
    for (const int column : {*density, *force})
      if (std::isfinite(directions.at(row, column)))
        scale.largest = std::max(scale.largest, directions.at(row, column));
  scale.largest *= 1.05;
  std::string text = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {0}\" font-family=\"DejaVu Sans, sans-serif\">\n",
      size);
  text += "<g fill=\"#9ecae1\" stroke=\"#0072b2\" stroke-width=\"0.8\">\n";
  const double half = std::numbers::pi / directions.rows() / 2;
  for (const double turn : {0.0, std::numbers::pi})
    for (int row = 0; row < directions.rows(); ++row) {
      const double middle = directions.at(row, *angle) * std::numbers::pi / 180 + turn;
      if (directions.at(row, *density) > 0)
        text += wedge(scale, directions.at(row, *density), middle - half, middle + half);
    }
  text += "</g>\n" + grid(scale) + "<path fill=\"none\" stroke=\"#d55e00\" stroke-width=\"2\" d=\"";
  bool drawing = false;
  for (int k = 0; k <= 2 * directions.rows(); ++k) {
    const int row = k % directions.rows();
    const double length = directions.at(row, *force);
    const double at = directions.at(row, *angle) * std::numbers::pi / 180 + (k / directions.rows()) * std::numbers::pi;
    if (std::isfinite(length) && length >= 0)
      text += fmt::format("{}{:.1f} {:.1f}", drawing ? "L" : "M", scale.x(length, at), scale.y(length, at));
    drawing = std::isfinite(length) && length >= 0;
  }
  text += "\"/>\n<g font-size=\"14\" fill=\"#222222\" text-anchor=\"middle\">\n";
  for (int k = 0; k < 8; ++k) {
    const double at = k * std::numbers::pi / 4;
    text += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\">{}°</text>\n", centre + (outer + 26) * std::cos(at),
                        centre - (outer + 20) * std::sin(at) + 5, 45 * k);
  }
  return text + "</g>\n</svg>\n";
}

}  // namespace galet::report
