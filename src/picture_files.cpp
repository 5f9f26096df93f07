#include "src/picture_files.hpp"

#include "common/io/files.hpp"
#include "src/png.hpp"

namespace galet {

void add_figure(std::vector<std::string>& files, const std::string& stem, const Figure& figure) {
  if (figure.series.empty()) return;
  const std::string picture = write_figure(stem, figure);
  files.push_back(picture.empty() ? stem + ".dat" : picture);
}

void add_picture(std::vector<std::string>& files, const std::string& stem, const std::string& svg) {
  if (svg.empty()) return;
  write_file(stem + ".svg", svg);
  files.push_back(stem + ".svg");
  const std::string png = convert_to_png(stem + ".svg");
  if (!png.empty()) files.push_back(png);
}

}  // namespace galet
