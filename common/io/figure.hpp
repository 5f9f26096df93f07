// Figures through gnuplot. The data and the gnuplot script are kept beside the picture, so that a user can restyle it.
// Texts are in gnuplot's enhanced notation: "10^{-3}", "{/:Italic I}"; nothing in them is ever executed.
#pragma once

#include <string>
#include <vector>

namespace galet {

struct Series {
  std::string label;
  std::vector<double> x, y;
  std::vector<double> y_error;  ///< empty: no error bars
  bool line = false;            ///< joined by lines
  bool band = false;            ///< a line without points in a band of +- y_error: what others have found
  int look = -1;                ///< which colour and shape, from 0 on; -1: as its place among the series says
  bool open = false;            ///< open points, over the filled ones of the same look with which they are compared
};

struct Figure {
  std::string title, x_label, y_label;
  bool log_x = false, log_y = false;
  std::vector<Series> series;
};

/// Writes STEM.dat, STEM.gp and, when gnuplot is installed, STEM.svg and STEM.png. Returns the path of the SVG, or an
/// empty string when gnuplot is absent (the data and script are there all the same). Points that a logarithmic axis
/// can't show are left out of the picture and counted in the key. Throws RunError when gnuplot fails.
std::string write_figure(const std::string& stem, const Figure& figure);

}  // namespace galet
