// Figures through gnuplot. The data and the gnuplot script are kept beside the picture, so that a user can restyle it.
#pragma once

#include <string>
#include <vector>

namespace galet {

struct Series {
  std::string label;
  std::vector<double> x, y;
  std::vector<double> y_error;  ///< empty: no error bars
  bool line = false;            ///< joined by lines
};

struct Figure {
  std::string title, x_label, y_label;
  bool log_x = false, log_y = false;
  std::vector<Series> series;
};

/// Writes STEM.dat, STEM.gp and, when gnuplot is installed, STEM.svg and STEM.png. Returns the picture's path, or an
/// empty string when gnuplot is absent (the data and script are there all the same).
std::string write_figure(const std::string& stem, const Figure& figure);

}  // namespace galet
