#pragma once

#include <string>
#include <string_view>
#include <vector>

// One self-contained page: styles, pictures and charts are in it, nothing is fetched.
namespace halfsilver::bench {

// `body` is HTML, the title is text.
std::string page(const std::string& title, const std::string& body);

// A part of a page with a title and a body of its own, both as in page(). `id` is where links to it lead.
std::string article(const std::string& id, const std::string& title, const std::string& body);
std::string heading(const std::string& text);
std::string paragraph(const std::string& text);
std::string bullets(const std::vector<std::string>& texts);
// `picture` is the bytes of a PNG.
std::string thumbnail(std::string_view picture, const std::string& caption);
// The <svg> element of an SVG file.
std::string inlineSvg(std::string_view file);

}  // namespace halfsilver::bench
