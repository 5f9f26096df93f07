// Pictures beside tables: each function adds the paths of what it wrote to `files`.
#pragma once

#include <string>
#include <vector>

#include "common/io/figure.hpp"

namespace galet {

/// STEM.svg (and STEM.png when gnuplot is there), or its data STEM.dat without gnuplot. Nothing without series.
void add_figure(std::vector<std::string>& files, const std::string& stem, const Figure& figure);

/// STEM.svg and, when rsvg-convert is there, STEM.png. Nothing for an empty text.
void add_picture(std::vector<std::string>& files, const std::string& stem, const std::string& svg);

}  // namespace galet
