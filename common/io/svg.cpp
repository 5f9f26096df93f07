// How the picture is made. The cell is drawn in its least tilted form. Along periodic directions everything that
// crosses the border is drawn on both sides and cut at the outline, so that the picture shows each part of the cell
// once and pictures of neighbouring cells would fit together.
#include "common/io/svg.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "common/core/error.hpp"
#include "common/geometry/boundary_surface.hpp"
#include "common/geometry/wrap.hpp"
#include "common/measure/coordination.hpp"
#include "common/measure/numbers.hpp"

namespace galet {

namespace {

// Line width of a force chain: this many mean diameters at the mean force, in proportion up to the saturation.
constexpr double width_at_mean = 0.11;
constexpr double saturation = 4;
constexpr double thinnest = 0.3, thickest_at_mean = 5;  // pixels
constexpr const char* font = "font-family=\"DejaVu Sans, Helvetica, Arial, sans-serif\"";

/// Colours of compressive forces from weak to strong: dark enough on white and on light grey from the first on, and
/// darkening all the way, so that the order survives a black and white print.
struct Colour {
  double red, green, blue;
};
constexpr std::array<Colour, 4> chain_colours = {{{236, 151, 62}, {214, 84, 36}, {160, 24, 42}, {74, 4, 34}}};
constexpr const char* traction_colour = "#2b6cb0";

/// A force on the colour scale: 0 for a vanishing one, 1 at the saturation.
std::string chain_colour(double relative_force) {
  const double place =
      std::clamp(relative_force / saturation, 0.0, 1.0) * static_cast<double>(chain_colours.size() - 1);
  const std::size_t k = std::min(static_cast<std::size_t>(place), chain_colours.size() - 2);
  const double t = place - static_cast<double>(k);
  const Colour &a = chain_colours[k], &b = chain_colours[k + 1];
  const auto mix = [t](double from, double to) { return static_cast<int>(std::lround(from + t * (to - from))); };
  return fmt::format("#{:02x}{:02x}{:02x}", mix(a.red, b.red), mix(a.green, b.green), mix(a.blue, b.blue));
}

std::string escaped(std::string_view text) {
  std::string result;
  for (char letter : text) switch (letter) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      default:
        result += static_cast<unsigned char>(letter) < 0x20 ? ' ' : letter;
    }
  return result;
}

class Picture {
 public:
  Picture(const Snapshot<2>& snapshot, const SvgOptions& options) : snapshot_(snapshot), options_(options) {
    require(snapshot.cell != nullptr && snapshot.contacts != nullptr, "a picture needs a cell and contacts");
    require(options.width >= 200, "a picture needs a width of at least 200 pixels");
    cell_ = *snapshot.cell;
    reduce_tilt();
    inverse_ = cell_.box.inverse();
    find_scales();
    lay_out();
  }

  std::string draw() {
    open();
    draw_grains();
    draw_contacts();
    text_ += "</g>\n";
    draw_boundaries();
    draw_outline();
    draw_head();
    draw_legend();
    return text_ + "</svg>\n";
  }

 private:
  template <class... Arguments>
  void add(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Arguments>(arguments)...);
  }

  double right(double x) const { return origin_x_ + (x - shown_.low.x()) * scale_; }
  double down(double y) const { return origin_y_ + (shown_.high.y() - y) * scale_; }

  /// Takes whole turns of one cell vector off the other, when both are periodic: the one that lies along x or, in a
  /// cell sheared the other way, along y stays.
  void reduce_tilt() {
    if (!cell_.periodic[0] || !cell_.periodic[1]) return;
    const bool along_x = std::abs(cell_.box(1, 0)) <= std::abs(cell_.box(0, 1));
    const int kept = along_x ? 0 : 1, tilted = 1 - kept;
    const Vec<2> base = cell_.box.col(kept);
    cell_.box.col(tilted) -= std::round(cell_.box.col(tilted).dot(base) / base.squaredNorm()) * base;
  }

  void find_scales() {
    const int grains = snapshot_.grains();
    diameter_ = 0;
    for (double radius : snapshot_.radius) diameter_ += 2 * radius / grains;
    if (grains == 0) diameter_ = 1;
    const ContactColumns<2>& contacts = *snapshot_.contacts;
    normal_force_.resize(contacts.size());
    double sum = 0;
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      normal_force_[c] = contacts.normal[c].dot(contacts.force[c]);
      if (normal_force_[c] < 0) has_traction_ = true;
      sum += std::abs(normal_force_[c]);
    }
    mean_force_ = contacts.size() == 0 ? 0 : sum / static_cast<double>(contacts.size());
  }

  /// The part of space to show, and where it goes on the page.
  void lay_out() {
    shown_ = sample_extent<2>(cell_, snapshot_.position, snapshot_.radius);
    if (!snapshot_.planes.empty()) {
      shown_.low -= Vec<2>::Constant(0.8 * diameter_);  // room for the hatching
      shown_.high += Vec<2>::Constant(0.8 * diameter_);
    }
    const double margin = 24;
    scale_ = (options_.width - 2 * margin) / (shown_.high.x() - shown_.low.x());
    const double tallest = 1.5 * options_.width;
    scale_ = std::min(scale_, tallest / (shown_.high.y() - shown_.low.y()));
    origin_x_ = (options_.width - scale_ * (shown_.high.x() - shown_.low.x())) / 2;
    origin_y_ = 66;
    legend_y_ = origin_y_ + scale_ * (shown_.high.y() - shown_.low.y()) + 30;
    height_ = legend_y_ + 70;
  }

  std::string points(const std::vector<Vec<2>>& corners) const {
    std::string list;
    for (const Vec<2>& x : corners) list += fmt::format("{:.2f},{:.2f} ", right(x.x()), down(x.y()));
    list.pop_back();
    return list;
  }

  /// The cell, drawn longer by `more` cell vectors on both sides along directions that are not periodic.
  std::vector<Vec<2>> cell_corners(double more) const {
    const double a = cell_.periodic[0] ? 0 : more, b = cell_.periodic[1] ? 0 : more;
    return {cell_.box * Vec<2>(-a, -b), cell_.box * Vec<2>(1 + a, -b), cell_.box * Vec<2>(1 + a, 1 + b),
            cell_.box * Vec<2>(-a, 1 + b)};
  }

  void open() {
    add("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} "
        "{1:.0f}\">\n",
        options_.width, height_);
    add("<title>{}</title>\n", escaped(options_.title.empty() ? "Force chains" : options_.title));
    add("<defs><clipPath id=\"cell\"><polygon points=\"{}\"/></clipPath><clipPath id=\"view\"><polygon "
        "points=\"{}\"/></clipPath></defs>\n",
        points(cell_corners(10)),
        points({shown_.low, {shown_.high.x(), shown_.low.y()}, shown_.high, {shown_.low.x(), shown_.high.y()}}));
    add("<rect width=\"{:.0f}\" height=\"{:.0f}\" fill=\"white\"/>\n<g clip-path=\"url(#cell)\">\n", options_.width,
        height_);
  }

  /// Calls draw(shift) for each whole-cell shift with which a box in fractional coordinates meets the cell.
  template <class Draw>
  void each_image(const Vec<2>& least, const Vec<2>& largest, const Draw& draw) const {
    const auto first = [&](int a) { return cell_.periodic[a] ? static_cast<int>(std::ceil(-largest[a])) : 0; };
    const auto last = [&](int a) { return cell_.periodic[a] ? static_cast<int>(std::floor(1 - least[a])) : 0; };
    for (int p = first(0); p <= last(0); ++p)
      for (int q = first(1); q <= last(1); ++q) draw(Vec<2>(cell_.box * Vec<2>(p, q)));
  }

  void draw_grains() {
    const bool friction = !snapshot_.spin.empty();
    const std::vector<char> loose = rattlers<2>(snapshot_, friction);
    const Vec<2> width = face_distances<2>(cell_.box);
    for (const bool rattling : {false, true}) {
      add("<g fill=\"{}\" stroke=\"{}\" stroke-width=\"{:.2f}\">\n", rattling ? "#f9f9f9" : "#e4e4e4",
          rattling ? "#cfcfcf" : "#adadad", std::clamp(0.03 * diameter_ * scale_, 0.25, 1.2));
      for (int i = 0; i < snapshot_.grains(); ++i) {
        if ((loose[i] != 0) != rattling) continue;
        const Vec<2> s = wrapped_fraction<2>(cell_, inverse_, snapshot_.position[i]);
        const Vec<2> extent = snapshot_.radius[i] * width.cwiseInverse();
        each_image(s - extent, s + extent, [&](const Vec<2>& shift) {
          const Vec<2> x = cell_.box * s + shift;
          add("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{:.2f}\"/>\n", right(x.x()), down(x.y()),
              snapshot_.radius[i] * scale_);
        });
      }
      text_ += "</g>\n";
    }
  }

  double chain_width(double relative_force) const {
    const double at_mean = std::min(width_at_mean * diameter_ * scale_, thickest_at_mean);
    return std::max(thinnest, at_mean * std::min(relative_force, saturation));
  }
  double relative(std::size_t contact) const {
    return mean_force_ > 0 ? std::abs(normal_force_[contact]) / mean_force_ : 0;
  }

  /// Strong forces are drawn last, over weak ones.
  void draw_contacts() {
    const ContactColumns<2>& contacts = *snapshot_.contacts;
    std::vector<std::size_t> order(contacts.size());
    for (std::size_t c = 0; c < order.size(); ++c) order[c] = c;
    std::stable_sort(order.begin(), order.end(), [this](std::size_t a, std::size_t b) {
      return std::abs(normal_force_[a]) < std::abs(normal_force_[b]);
    });
    text_ += "<g stroke-linecap=\"round\">\n";
    for (std::size_t c : order) {
      if (normal_force_[c] == 0) continue;
      const Vec<2> from = wrapped_fraction<2>(cell_, inverse_, snapshot_.position[contacts.i[c]]);
      const Vec<2> to = from + inverse_ * contacts.branch[c];
      each_image(from.cwiseMin(to), from.cwiseMax(to), [&](const Vec<2>& shift) {
        const Vec<2> a = cell_.box * from + shift, b = cell_.box * to + shift;
        add("<path d=\"M{:.2f} {:.2f}L{:.2f} {:.2f}\" stroke=\"{}\" stroke-width=\"{:.2f}\"/>\n", right(a.x()),
            down(a.y()), right(b.x()), down(b.y()),
            normal_force_[c] < 0 ? std::string(traction_colour) : chain_colour(relative(c)), chain_width(relative(c)));
      });
    }
    text_ += "</g>\n";
  }

  void draw_outline() {
    add("<polygon points=\"{}\" fill=\"none\" stroke=\"#222222\" stroke-width=\"1.3\" stroke-linejoin=\"round\"{}/>\n",
        points(cell_corners(0)), cell_.any_periodic() ? "" : " stroke-dasharray=\"2 4\"");
  }

  /// A line with oblique strokes on the side where no grain may be.
  void draw_boundaries() {
    for (const Plane<2>& boundary : snapshot_.planes)
      for (const std::vector<Vec<2>>& line : boundary_faces<2>(boundary, shown_)) {
        text_ += "<g clip-path=\"url(#view)\" stroke=\"#333333\"><path stroke-width=\"1.8\" fill=\"none\" d=\"";
        for (std::size_t k = 0; k < line.size(); ++k)
          add("{}{:.2f} {:.2f}", k == 0 ? 'M' : 'L', right(line[k].x()), down(line[k].y()));
        text_ += "\"/>\n<path stroke-width=\"0.8\" fill=\"none\" d=\"";
        draw_hatching(boundary, line);
        text_ += "\"/></g>\n";
      }
  }

  /// Strokes at equal distances along the line.
  void draw_hatching(const Plane<2>& boundary, const std::vector<Vec<2>>& line) {
    const double pitch = 0.5 * diameter_;
    double place = pitch / 2;  // of the next stroke, from the corner where the side begins
    for (std::size_t k = 0; k + 1 < line.size(); ++k) {
      const double length = (line[k + 1] - line[k]).norm();
      for (; place < length; place += pitch) {
        const Vec<2> top = line[k] + place / length * (line[k + 1] - line[k]);
        if (!shown_.contains(top, 1e-6 * diameter_)) continue;  // a plane that only its shadow is left of
        const Vec<2> normal = tangent_plane<2>(boundary, top).normal, along(normal.y(), -normal.x());
        const Vec<2> bottom = top - 0.45 * diameter_ * (normal + along);
        add("M{:.2f} {:.2f}L{:.2f} {:.2f}", right(top.x()), down(top.y()), right(bottom.x()), down(bottom.y()));
      }
      place -= length;
    }
  }

  void draw_text(double x, double y, double size, const char* anchor, const char* colour, std::string_view content) {
    add("<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"{}\" text-anchor=\"{}\" fill=\"{}\" {}>{}</text>\n", x, y, size,
        anchor, colour, font, escaped(content));
  }

  void draw_head() {
    const Coordination network = coordination<2>(snapshot_, !snapshot_.spin.empty());
    draw_text(24, 30, 18, "start", "#111111", options_.title.empty() ? "Force chains" : options_.title);
    std::string facts = fmt::format("{} grains · Φ = {:.3f} · z = {:.2f} · t = {:.4g}", snapshot_.grains(),
                                    solid_fraction<2>(snapshot_), network.z, snapshot_.time);
    if (!snapshot_.engine.empty()) facts = fmt::format("{} · {}", snapshot_.engine, facts);
    draw_text(24, 51, 13, "start", "#555555", facts);
  }

  /// A round number of diameters, 5 d when the picture allows it, at most a quarter of its width.
  double bar_length() const {
    double length = 1;
    for (double candidate : {2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0}) {
      const double pixels = candidate * diameter_ * scale_;
      if (pixels <= 0.25 * options_.width && (candidate <= 5 || length * diameter_ * scale_ < 40)) length = candidate;
    }
    return length;
  }

  void draw_legend() {
    const double length = bar_length(), pixels = length * diameter_ * scale_, y = legend_y_;
    add("<path d=\"M24 {0:.1f}v8M24 {1:.1f}h{2:.1f}M{3:.1f} {0:.1f}v8\" stroke=\"#222222\" stroke-width=\"1.6\" "
        "fill=\"none\"/>\n",
        y, y + 4, pixels, 24 + pixels);
    draw_text(24 + pixels / 2, y + 27, 13, "middle", "#222222", fmt::format("{:g} d", length));

    draw_text(options_.width - 24, y + 49, 12, "end", "#555555",
              fmt::format("mean normal force ⟨F⟩ = {:.3g}; pale grains: rattlers", mean_force_));
    if (mean_force_ == 0) return;
    const double step = 78;
    double x = options_.width - 24 - 4 * step;
    if (has_traction_) draw_sample(x - step, y, 1, traction_colour, "traction");
    for (const auto& [force, label] : {std::pair{0.5, "⟨F⟩/2"}, {1.0, "⟨F⟩"}, {2.0, "2⟨F⟩"}, {saturation, "≥ 4⟨F⟩"}}) {
      draw_sample(x, y, force, chain_colour(force), label);
      x += step;
    }
  }

  /// One line of the legend, as wide as chains of that force are.
  void draw_sample(double x, double y, double force, const std::string& colour, const char* label) {
    add("<path d=\"M{:.1f} {:.1f}h52\" stroke=\"{}\" stroke-width=\"{:.2f}\"/>\n", x + 13, y + 4, colour,
        chain_width(force));
    draw_text(x + 39, y + 27, 13, "middle", "#222222", label);
  }

  const Snapshot<2>& snapshot_;
  const SvgOptions& options_;
  Cell<2> cell_;  ///< in its least tilted form
  Mat<2> inverse_;
  double diameter_ = 1;
  double mean_force_ = 0;  ///< mean of |F_N| over the contacts
  bool has_traction_ = false;
  std::vector<double> normal_force_;
  Extent<2> shown_;
  double scale_ = 1;  ///< pixels per unit of length
  double origin_x_ = 0, origin_y_ = 0, legend_y_ = 0, height_ = 0;
  std::string text_;
};

}  // namespace

std::string force_chain_svg(const Snapshot<2>& snapshot, const SvgOptions& options) {
  return Picture(snapshot, options).draw();
}

}  // namespace galet
