// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "view/one_page.hpp"

#include <algorithm>

#include "base/expects.hpp"
#include "view/bundle_files.hpp"
#include "view/gzip.hpp"

namespace farlod {
namespace {

/// What the server says in a header. Nothing may be loaded but what lies in the page.
constexpr std::string_view policy =
    "  <meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; script-src 'unsafe-inline'; style-src "
    "'unsafe-inline'; img-src blob: data:; connect-src blob: data:; worker-src blob:; base-uri 'none'; form-action 'none'\">\n";

std::string_view bytes_of(std::string_view name) {
  const auto files = bundle_files();
  const auto found = std::ranges::find(files, name, &BundleFile::name);
  FARLOD_EXPECTS(found != files.end());
  return found->bytes;
}

/// Between tags. The text must not end the element: viewer/build.mjs sees to it.
std::string element(std::string_view begin, std::string_view text, std::string_view end) {
  FARLOD_EXPECTS(text.find(end) == std::string_view::npos);
  return std::string(begin).append("\n").append(text).append(end).append("\n");
}

/// index.html up to the place of the files, and from there on.
struct PageText {
  std::string before, after;
};

PageText page_text() {
  PageText text;
  std::string_view rest = bytes_of("index.html");
  while (!rest.empty()) {
    const std::string_view line = rest.substr(0, std::min(rest.find('\n'), rest.size() - 1) + 1);
    rest.remove_prefix(line.size());
    const auto has = [&](std::string_view words) { return line.find(words) != std::string_view::npos; };
    if (has("rel=\"stylesheet\"")) {
      text.before.append(policy).append(element("<style>", bytes_of("viewer.css"), "</style>"));
    } else if (has("src=\"viewer.js\"")) {
      text.before += element("<script type=\"text/plain\" id=\"licences\">", bytes_of("licences.txt"), "</script>");
      text.after = element("<script type=\"module\">", bytes_of("viewer.js"), "</script>");
    } else if (!has("rel=\"preload\"")) {
      (text.after.empty() ? text.before : text.after) += line;
    }
  }
  FARLOD_EXPECTS(text.before.find("<style>") != std::string::npos && !text.after.empty());
  return text;
}

std::string in_base64(std::string_view bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t n = 0; n < bytes.size(); n += 3) {
    const auto byte = [&](std::size_t k) { return n + k < bytes.size() ? static_cast<unsigned char>(bytes[n + k]) : 0U; };
    const unsigned int three = byte(0) << 16U | byte(1) << 8U | byte(2);
    for (const unsigned int shift : {18U, 12U, 6U, 0U}) text.push_back(digits[three >> shift & 63U]);
  }
  std::fill_n(text.rbegin(), (3 - bytes.size() % 3) % 3, '=');
  return text;
}

}  // namespace

OnePage::OnePage(std::ostream& stream) : stream_(stream) {
  PageText text = page_text();
  write(text.before);
  rest_ = std::move(text.after);
}

void OnePage::add(const std::string& name, std::string_view bytes) {
  write("<script type=\"text/plain\" data-file=\"" + name + "\">" + in_base64(gzipped(bytes)) + "</script>\n");
}

void OnePage::finish() { write(rest_); }

void OnePage::write(std::string_view text) {
  stream_.write(text.data(), static_cast<std::streamsize>(text.size()));
  bytes_ += text.size();
}

}  // namespace farlod
