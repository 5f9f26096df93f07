#include "src/png.hpp"

#include <filesystem>

#include "common/io/program.hpp"

namespace galet {

std::string convert_to_png(const std::string& svg_path) {
  const std::string png = std::filesystem::path(svg_path).replace_extension(".png").string();
  // "--": a path that begins with a dash is no option.
  return run_program({"rsvg-convert", "--output", png, "--", svg_path}).well() ? png : std::string();
}

}  // namespace galet
