#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

// One self-contained HTML page: styles, pictures and charts are embedded, nothing is fetched.
namespace halfsilver::bench {

// `body` is HTML, the title is text.
std::string page(const std::string& title, const std::string& body);

// A part of a page with its own title and body, both as in page(). Links to it use `id`.
std::string article(const std::string& id, const std::string& title, const std::string& body);
std::string heading(const std::string& text);
std::string paragraph(const std::string& text);
std::string bullets(const std::vector<std::string>& texts);
// `picture`: the bytes of a PNG.
std::string thumbnail(std::string_view picture, const std::string& caption);
// Pictures, each with a caption, side by side. Those without bytes are left out.
struct Figure {
  std::string png;
  std::string caption;
};
std::string gallery(const std::vector<Figure>& figures);
// The <svg> element of an SVG file.
std::string inlineSvg(std::string_view file);
// A chart with the text below it, or a sentence that it is missing.
std::string chartFigure(const std::optional<std::string>& svg, const std::string& explanation);

}  // namespace halfsilver::bench
