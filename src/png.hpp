// Bitmap copies of SVG pictures, through rsvg-convert.
#pragma once

#include <string>

namespace galet {

/// Writes PICTURE.png beside PICTURE.svg. Returns its path, or an empty string when rsvg-convert is not installed or
/// fails: the SVG is there all the same.
std::string convert_to_png(const std::string& svg_path);

}  // namespace galet
