#include "src/report/html.hpp"

#include <array>

#include <fmt/format.h>

#include "common/io/base64.hpp"

namespace galet::report {

std::string escaped(std::string_view text) {
  std::string result;
  for (const char letter : text) switch (letter) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += static_cast<unsigned char>(letter) < 0x20 && letter != '\n' && letter != '\t' ? ' ' : letter;
    }
  return result;
}

namespace {

struct Symbol {
  std::string_view name, symbol;
};

/// Beginnings of names: what follows the underscore becomes the index.
constexpr std::array<Symbol, 3> indexed = {{{"sigma_", "σ"}, {"eps_", "ε"}, {"v_", "v"}}};

constexpr std::array<Symbol, 23> whole = {{{"mu_star", "μ*"},
                                           {"Phi", "Φ"},
                                           {"z_star", "z*"},
                                           {"kappa", "κ"},
                                           {"a_c", "a_{c}"},
                                           {"a_n", "a_{n}"},
                                           {"a_t", "a_{t}"},
                                           {"a_l", "a_{l}"},
                                           {"T_rot", "T_{rot}"},
                                           {"v_t", "v_{θ}"},
                                           {"sigma_rt", "σ_{rθ}"},
                                           {"sigma_tt", "σ_{θθ}"},
                                           {"shear_rate", "shear rate"},
                                           {"strain", "strain γ"},
                                           {"P_normal", "P(F_{N} / ⟨F_{N}⟩)"},
                                           {"P_tangential", "P(F_{T} / ⟨F_{T}⟩)"},
                                           {"mu_star_error", "± μ*"},
                                           {"Phi_error", "± Φ"},
                                           {"z_error", "± z"},
                                           {"deviation_error", "± deviation"},
                                           {"I_realised", "I realised"},
                                           {"kappa_realised", "κ realised"},
                                           {"dt", "Δt"}}};

std::string with_blanks(std::string_view name) {
  std::string text(name);
  for (char& letter : text)
    if (letter == '_') letter = ' ';
  return text;
}

}  // namespace

std::string plot_symbol(std::string_view name) {
  for (const Symbol& entry : whole)
    if (entry.name == name) return std::string(entry.symbol);
  for (const Symbol& entry : indexed)
    if (name.starts_with(entry.name)) return fmt::format("{}_{{{}}}", entry.symbol, name.substr(entry.name.size()));
  return with_blanks(name);
}

std::string html_symbol(std::string_view name) {
  const std::string symbol = plot_symbol(name);
  std::string text;
  for (std::size_t k = 0; k < symbol.size(); ++k) {
    if (symbol.compare(k, 2, "_{") == 0)
      text += "<sub>", ++k;
    else if (symbol[k] == '}')
      text += "</sub>";
    else
      text += escaped(symbol.substr(k, 1));
  }
  return text;
}

std::string table(const std::vector<std::string>& header, const std::vector<std::vector<std::string>>& rows,
                  std::string_view kind) {
  std::string text = fmt::format("<div class=\"wide\"><table class=\"{}\">\n<thead><tr>", kind);
  for (const std::string& cell : header) text += fmt::format("<th>{}</th>", cell);
  text += "</tr></thead>\n<tbody>\n";
  for (const std::vector<std::string>& row : rows) {
    text += "<tr>";
    for (const std::string& cell : row) text += fmt::format("<td>{}</td>", cell);
    text += "</tr>\n";
  }
  return text + "</tbody></table></div>\n";
}

namespace {

/// Takes <name ...>...</name> out, wherever it is.
void remove_element(std::string& text, const std::string& name) {
  for (std::size_t from = text.find("<" + name + ">"); from != std::string::npos; from = text.find("<" + name + ">")) {
    const std::string end = "</" + name + ">";
    const std::size_t to = text.find(end, from);
    if (to == std::string::npos) return;
    text.erase(from, to + end.size() - from);
  }
}

void insert_after(std::string& text, std::string_view mark, std::string_view prefix) {
  for (std::size_t at = text.find(mark); at != std::string::npos; at = text.find(mark, at + mark.size()))
    text.insert(at + mark.size(), prefix);
}

/// The value of an attribute of the first tag, taken out of it.
void remove_attribute(std::string& text, const std::string& name) {
  const std::size_t end = text.find('>'), at = text.find(" " + name + "=\"");
  if (at == std::string::npos || at > end) return;
  const std::size_t close = text.find('"', at + name.size() + 3);
  if (close < end) text.erase(at, close + 1 - at);
}

}  // namespace

std::string inline_svg(std::string_view svg, std::string_view prefix) {
  const std::size_t begin = svg.find("<svg");
  if (begin == std::string_view::npos) return "";
  std::string text(svg.substr(begin));
  remove_element(text, "title");
  remove_element(text, "desc");
  remove_attribute(text, "width");
  remove_attribute(text, "height");
  for (const char* mark : {" id=\"", " id='", "url(#", "href=\"#", "href='#"}) insert_after(text, mark, prefix);
  return text;
}

std::string inline_png(std::string_view bytes, std::string_view description) {
  return fmt::format("<img alt=\"{}\" src=\"data:image/png;base64,{}\">\n", escaped(description), base64(bytes));
}

std::string page(std::string_view title, std::string_view body) {
  constexpr std::string_view style = R"(
:root { color-scheme: light; }
body { font: 15px/1.5 "DejaVu Sans", "Segoe UI", Helvetica, Arial, sans-serif; color: #1c1c1c; background: #fff;
       max-width: 1180px; margin: 0 auto; padding: 24px 28px 60px; }
h1 { font-size: 26px; line-height: 1.25; margin: 0 0 4px; }
h2 { font-size: 20px; margin: 40px 0 10px; padding-bottom: 4px; border-bottom: 2px solid #0072b2; }
h3 { font-size: 16px; margin: 24px 0 8px; }
p.facts { color: #555; margin: 0 0 14px; }
nav a { margin-right: 16px; color: #0072b2; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; font-size: 13.5px; margin: 6px 0 14px; }
th { text-align: left; border-bottom: 1.5px solid #888; padding: 3px 14px 3px 0; vertical-align: bottom; }
td { border-bottom: 1px solid #e2e2e2; padding: 3px 14px 3px 0; vertical-align: top; }
table.numbers th:not(:first-child), table.numbers td:not(:first-child) { text-align: right;
       font-variant-numeric: tabular-nums; }
table.numbers td { white-space: nowrap; }
table.said td:nth-child(2), table.said th:nth-child(2) { text-align: right; white-space: nowrap;
       font-variant-numeric: tabular-nums; }
td.from { color: #555; }
.figures { display: grid; grid-template-columns: repeat(auto-fill, minmax(440px, 1fr)); gap: 18px; }
figure { margin: 0; }
figure svg, figure img { display: block; width: 100%; height: auto; }
figcaption { color: #555; font-size: 13px; }
.picture { max-width: 900px; }
.warning { background: #fff4e0; border-left: 5px solid #e69f00; padding: 8px 14px; margin: 8px 0; }
.failure { background: #fde8e4; border-left: 5px solid #d55e00; padding: 8px 14px; margin: 8px 0; }
.good { background: #e9f6f0; border-left: 5px solid #009e73; padding: 8px 14px; margin: 8px 0; }
pre { background: #f6f6f6; padding: 12px 14px; overflow-x: auto; font: 13px/1.45 "DejaVu Sans Mono", monospace; }
@media print { figure, table { break-inside: avoid; } body { max-width: none; } }
)";
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{}</title>\n<style>{}</style>\n"
      "</head>\n<body>\n{}</body>\n</html>\n",
      escaped(title), style, body);
}

}  // namespace galet::report
