#include "bench/report/page.h"

#include "bench/report/table.h"

namespace halfsilver::bench {
namespace {

constexpr const char* kStyle = R"(
body { font: 16px/1.5 system-ui, sans-serif; color: #222; background: #fff; max-width: 76rem; margin: 2rem auto; padding: 0 1rem; }
h1 { line-height: 1.2; } h2 { margin-top: 2.2rem; }
article { border-top: 2px solid #888; margin-top: 3rem; } article h1 { font-size: 1.6rem; }
nav li { margin: 0.3rem 0; }
p, li { max-width: 46rem; }
.table { overflow-x: auto; }
table { border-collapse: collapse; font-size: 0.8rem; }
th, td { padding: 0.25rem 0.45rem; border-bottom: 1px solid #ddd; text-align: left; vertical-align: bottom; }
th { border-bottom: 2px solid #888; }
td.number { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
tbody tr:hover { background: #f4f6f8; }
.scenes { display: flex; flex-wrap: wrap; gap: 1rem; }
figure { margin: 0; } figure img { display: block; max-width: 100%; width: 20rem; }
figcaption { font-size: 0.85rem; color: #555; max-width: 20rem; }
svg { max-width: 100%; height: auto; }
code { background: #f2f2f2; padding: 0.1rem 0.3rem; }
)";

std::string base64(std::string_view bytes) {
  constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](std::size_t at) {
      return at < bytes.size() ? static_cast<unsigned>(static_cast<unsigned char>(bytes[at])) : 0u;
    };
    const unsigned group = byte(i) << 16 | byte(i + 1) << 8 | byte(i + 2);
    for (unsigned digit = 0; digit < 4; ++digit)
      text += i + digit <= bytes.size() ? digits[group >> (18 - 6 * digit) & 63] : '=';
  }
  return text;
}

}  // namespace

std::string page(const std::string& title, const std::string& body) {
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
         escapeHtml(title) + "</title>\n<style>" + kStyle + "</style>\n</head>\n<body>\n<h1>" + escapeHtml(title) +
         "</h1>\n" + body + "</body>\n</html>\n";
}

std::string article(const std::string& id, const std::string& title, const std::string& body) {
  return "<article id=\"" + escapeHtml(id) + "\">\n<h1>" + escapeHtml(title) + "</h1>\n" + body + "</article>\n";
}

std::string heading(const std::string& text) { return "<h2>" + escapeHtml(text) + "</h2>\n"; }
std::string paragraph(const std::string& text) { return "<p>" + escapeHtml(text) + "</p>\n"; }

std::string bullets(const std::vector<std::string>& texts) {
  std::string html = "<ul>\n";
  for (const std::string& text : texts) html.append("<li>").append(escapeHtml(text)).append("</li>\n");
  return html + "</ul>\n";
}

std::string thumbnail(std::string_view picture, const std::string& caption) {
  return "<figure><img alt=\"" + escapeHtml(caption) + "\" src=\"data:image/png;base64," + base64(picture) +
         "\"><figcaption>" + escapeHtml(caption) + "</figcaption></figure>\n";
}

std::string gallery(const std::vector<Figure>& figures) {
  std::string html = "<div class=\"scenes\">\n";
  for (const Figure& figure : figures)
    if (!figure.png.empty()) html += thumbnail(figure.png, figure.caption);
  return html + "</div>\n";
}

std::string inlineSvg(std::string_view file) {
  const std::size_t start = file.find("<svg");
  return start == file.npos ? "" : std::string(file.substr(start));
}

std::string chartFigure(const std::optional<std::string>& svg, const std::string& explanation) {
  if (!svg) return paragraph("gnuplot was not installed when this page was made, so there is no chart.");
  return inlineSvg(*svg) + paragraph(explanation);
}

}  // namespace halfsilver::bench
