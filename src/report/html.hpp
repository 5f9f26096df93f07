// Pieces of an HTML page that needs nothing but itself: tables, pictures inside of the text.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace galet::report {

/// Text with the letters that HTML means something by replaced.
std::string escaped(std::string_view text);

/// How a quantity is written: "sigma_xy" is σ with the index xy. For HTML, and for gnuplot's enhanced notation.
/// What has no symbol keeps its name, with blanks for its underscores.
std::string html_symbol(std::string_view name);
std::string plot_symbol(std::string_view name);

/// A table. Cells are HTML already; `kind` is a class of the page's style ("numbers": right of the first column).
std::string table(const std::vector<std::string>& header, const std::vector<std::vector<std::string>>& rows,
                  std::string_view kind = "");

/// An SVG file to stand in a page: without its XML head, titles and fixed size; every id begins with `prefix`, so that
/// pictures of one page don't take each other's parts. Empty for a text that is no SVG.
std::string inline_svg(std::string_view svg, std::string_view prefix);

/// An image element that holds the bytes of a PNG file.
std::string inline_png(std::string_view bytes, std::string_view description);

/// A whole page with the style of reports.
std::string page(std::string_view title, std::string_view body);

}  // namespace galet::report
