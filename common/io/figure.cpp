// The script holds names and labels between single quotes, where gnuplot expands nothing; gnuplot is started without
// a shell, in the folder of the files, which are called "./name": no name can be taken for an option or a pipe.
#include "common/io/figure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "common/core/error.hpp"
#include "common/io/files.hpp"
#include "common/io/program.hpp"

namespace galet {

namespace {

/// Colours that differ for every kind of sight (Okabe and Ito), each with a shape; black and grey have those of the
/// first.
constexpr std::array colours = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000", "#888888"};
constexpr std::array shapes = {7, 5, 9, 13, 11, 15, 7, 5};
constexpr std::array open_shapes = {6, 4, 8, 12, 10, 14, 6, 4};

/// A text between single quotes for gnuplot. Control characters would end the line of the script.
std::string quote(const std::string& text) {
  std::string result = "'";
  for (char letter : text) {
    if (letter == '\'') result += '\'';
    result += static_cast<unsigned char>(letter) < 0x20 ? ' ' : letter;
  }
  return result + "'";
}

bool drawable(const Figure& figure, const Series& series, std::size_t k) {
  const double x = series.x[k], y = series.y[k];
  return std::isfinite(x) && std::isfinite(y) && (!figure.log_x || x > 0) && (!figure.log_y || y > 0);
}

/// Points that have a value but lie where a logarithmic axis shows nothing.
std::size_t hidden_count(const Figure& figure, const Series& series) {
  std::size_t count = 0;
  for (std::size_t k = 0; k < series.x.size(); ++k)
    count += std::isfinite(series.x[k]) && std::isfinite(series.y[k]) && !drawable(figure, series, k) ? 1 : 0;
  return count;
}

std::size_t drawable_count(const Figure& figure, const Series& series) {
  std::size_t count = 0;
  for (std::size_t k = 0; k < series.x.size(); ++k) count += drawable(figure, series, k) ? 1 : 0;
  return count;
}

/// One block per series, set apart by two empty lines (gnuplot's "index"). All points are there, also those that a
/// logarithmic axis can't show.
std::string data_text(const Figure& figure) {
  const auto line = [](std::string text) {
    std::replace_if(
        text.begin(), text.end(), [](unsigned char letter) { return letter < 0x20; }, ' ');
    return text;
  };
  std::string text = fmt::format("# {}\n", line(figure.title));
  for (const Series& series : figure.series) {
    const bool errors = !series.y_error.empty();
    text += fmt::format("# {}\n# {}   {}{}\n", line(series.label), line(figure.x_label), line(figure.y_label),
                        errors ? "   error" : "");
    if (series.x.empty()) text += "# no points\nnan nan nan\n";  // keeps the numbering of the blocks
    for (std::size_t k = 0; k < series.x.size(); ++k) {
      text += fmt::format("{} {}", series.x[k], series.y[k]);
      text += errors ? fmt::format(" {}\n", series.y_error[k]) : "\n";
    }
    text += "\n\n";
  }
  return text;
}

struct Range {
  double low = HUGE_VAL, high = 0;
};

/// What a logarithmic axis shows: all points that it can show and the upper ends of their error bars with a little
/// room, and at least two powers of ten, as only these carry a number. (A lower end at or below 0 runs off the axis.)
Range log_range(const Figure& figure, bool of_x) {
  Range range;
  for (const Series& series : figure.series)
    for (std::size_t k = 0; k < series.x.size(); ++k) {
      if (!drawable(figure, series, k)) continue;
      const double value = of_x ? series.x[k] : series.y[k];
      const double error = of_x || series.y_error.empty() || !std::isfinite(series.y_error[k]) ? 0 : series.y_error[k];
      range.low = std::min(range.low, value - error > 0 ? value - error : value);
      range.high = std::max(range.high, value + error);
    }
  if (range.high == 0) return {1, 10};
  range.low /= 1.25, range.high *= 1.25;
  if (std::floor(std::log10(range.high)) - std::ceil(std::log10(range.low)) < 1) {
    range.low = std::pow(10, std::floor(std::log10(range.low)));
    range.high = std::pow(10, std::ceil(std::log10(range.high)));
  }
  return range;
}

/// Numbers that need a power of ten are too wide for the usual marks along x: at most five of them, at round values.
std::string sparse_marks(const Figure& figure, char axis) {
  if (axis != 'x') return "";
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (const Series& series : figure.series)
    for (std::size_t k = 0; k < series.x.size(); ++k)
      if (drawable(figure, series, k)) low = std::min(low, series.x[k]), high = std::max(high, series.x[k]);
  const double largest = std::max(std::abs(low), std::abs(high));
  if (!(high > low) || (largest >= 1e-3 && largest < 1e6)) return "";
  const double step = (high - low) / 4, power = std::pow(10, std::floor(std::log10(step)));
  const double round = step <= 2 * power ? 2 : step <= 5 * power ? 5 : 10;
  return fmt::format("set xtics {}\n", round * power);
}

std::string axis_text(const Figure& figure, char axis) {
  const bool of_x = axis == 'x', logarithmic = of_x ? figure.log_x : figure.log_y;
  std::string text = fmt::format("set {}label {}\n", axis, quote(of_x ? figure.x_label : figure.y_label));
  if (!logarithmic) return text + sparse_marks(figure, axis);
  const Range range = log_range(figure, of_x);
  return text + fmt::format("set logscale {0}\nset format {0} '10^{{%L}}'\nset m{0}tics 10\nset {0}range [{1}:{2}]\n",
                            axis, range.low, range.high);
}

/// Rows that the key will take below the plot, from the lengths of its labels.
std::size_t key_rows(const Figure& figure) {
  std::size_t longest = 0;
  for (const Series& series : figure.series) longest = std::max(longest, series.label.size());
  const std::size_t columns = std::max<std::size_t>(1, 700 / (9 * longest + 60));
  return (figure.series.size() + columns - 1) / columns;
}

/// One "plot" clause.
std::string clause(const Figure& figure, std::size_t index, const std::string& data) {
  const Series& series = figure.series[index];
  const bool errors = !series.y_error.empty();
  std::string style = series.line ? (errors ? "yerrorlines" : "linespoints") : (errors ? "yerrorbars" : "points");
  std::string title = series.label;
  const std::size_t hidden = hidden_count(figure, series);
  if (hidden > 0) title += fmt::format(" ({} off the axes)", hidden);
  const std::size_t look = (series.look < 0 ? index : static_cast<std::size_t>(series.look)) % colours.size();
  if (series.band)
    return fmt::format(
        "{0} index {1} using 1:($2-$3):($2+$3) with filledcurves fillcolor rgb '{2}' fillstyle transparent solid 0.2 "
        "noborder {3}, \\\n     {0} index {1} using 1:2 with lines linecolor rgb '{2}' linewidth 1.5 notitle",
        quote(data), index, colours[look], title.empty() ? "notitle" : "title " + quote(title));
  return fmt::format("{} index {} using {} with {} linecolor rgb '{}' pointtype {} pointsize 0.7 linewidth 1.5 {}",
                     quote(data), index, errors ? "1:2:3" : "1:2", style, colours[look],
                     (series.open ? open_shapes : shapes)[look], title.empty() ? "notitle" : "title " + quote(title));
}

std::string script_text(const Figure& figure, const std::string& name) {
  std::string text =
      fmt::format("# gnuplot script; run it in its own folder: gnuplot {}\nset encoding utf8\nset title {}\n",
                  quote(name + ".gp"), quote(figure.title));
  text += axis_text(figure, 'x') + axis_text(figure, 'y');
  const auto room = [](bool logarithmic) { return logarithmic ? "0, 0" : "graph 0.03, graph 0.03"; };
  // Room beside the points themselves: without "noextend" ranges first grow to the next mark, and the room adds to
  // that.
  text += "set autoscale noextend\n";
  text += fmt::format("set offsets {}, {}\n", room(figure.log_x), room(figure.log_y));
  text += "set grid xtics ytics linecolor rgb '#d8d8d8' linewidth 0.7 linetype 1\nset border linewidth 1.2\n";
  text += "set errorbars 0.8\n";
  text += "set key outside below center horizontal Left reverse samplen 2.5 height 0.8 spacing 1.1\n";

  std::string clauses;
  for (std::size_t k = 0; k < figure.series.size(); ++k) {
    if (drawable_count(figure, figure.series[k]) == 0) continue;
    clauses += (clauses.empty() ? "plot " : ", \\\n     ") + clause(figure, k, "./" + name + ".dat");
  }
  if (clauses.empty())
    clauses = "set label 'no points to show' at graph 0.5, graph 0.5 center\nplot [1:10] [1:10] NaN notitle";

  const std::size_t height = 540 + 22 * key_rows(figure);
  text += fmt::format("set terminal svg size 800,{} font 'DejaVu Sans,15' background rgb 'white' enhanced\n", height);
  text += fmt::format("set output {}\n{}\n", quote("./" + name + ".svg"), clauses);
  text += "if (strstrt(GPVAL_TERMINALS, 'pngcairo') > 0) {\n";
  text += fmt::format(
      "  set terminal pngcairo size 1600,{} font 'DejaVu Sans,15' fontscale 2 linewidth 2 pointscale 2 enhanced\n",
      2 * height);
  text += "} else {\n  set terminal png size 800,600 enhanced\n}\n";
  return text + fmt::format("set output {}\nreplot\nset output\n", quote("./" + name + ".png"));
}

/// Runs gnuplot on a script in `folder`. False when there is no gnuplot; throws RunError with what it printed when
/// it fails.
bool run_gnuplot(const std::string& folder, const std::string& script) {
  const ProgramEnd end = run_program({"gnuplot", "-d", "./" + script}, folder);  // -d: a user's own settings stay out
  if (end.found && end.code != 0)
    throw RunError(fmt::format("gnuplot failed on '{}/{}': {}", folder, script, end.messages));
  return end.found;
}

}  // namespace

std::string write_figure(const std::string& stem, const Figure& figure) {
  for (const Series& series : figure.series) {
    require(series.x.size() == series.y.size(), "a series needs as many x as y");
    require(series.y_error.empty() || series.y_error.size() == series.y.size(), "a series needs an error for each y");
  }
  const std::filesystem::path path(stem);
  const std::string name = path.filename().string();
  require(!name.empty() && name != "." && name != "..", "the stem of a figure needs a file name");
  require(std::none_of(name.begin(), name.end(), [](unsigned char letter) { return letter < 0x20; }),
          "the stem of a figure must not hold control characters");
  write_file(stem + ".dat", data_text(figure));
  write_file(stem + ".gp", script_text(figure, name));
  const std::string folder = path.has_parent_path() ? path.parent_path().string() : ".";
  return run_gnuplot(folder, name + ".gp") ? stem + ".svg" : "";
}

}  // namespace galet
