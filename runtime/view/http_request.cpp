// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "view/http_request.hpp"

#include <algorithm>
#include <charconv>

#include "contract/lower_case.hpp"

namespace farlod {
namespace {

/// What stands in front of the separator, which is taken off `text` with it; all of `text` where there is none.
std::string_view take_until(std::string_view& text, std::string_view separator) {
  const std::size_t end = text.find(separator);
  const std::string_view taken = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + separator.size());
  return taken;
}

std::string_view without_blanks(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  return first == std::string_view::npos ? "" : text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// The character of two hexadecimal digits. Nothing where they are none.
std::optional<char> character_of(std::string_view digits) {
  unsigned char value = 0;
  const char* const end = digits.data() + digits.size();
  const bool is_number = digits.size() == 2 && std::from_chars(digits.data(), end, value, 16).ptr == end;
  return is_number ? std::optional(static_cast<char>(value)) : std::nullopt;
}

/// A per cent sign that begins no character stays as it is.
std::string decoded(std::string_view text) {
  std::string plain;
  while (!text.empty()) {
    const auto character = text.front() == '%' ? character_of(text.substr(1, 2)) : std::nullopt;
    plain += character.value_or(text.front());
    text.remove_prefix(character ? 3 : 1);
  }
  return plain;
}

/// Of a query, where a plus sign is a blank.
std::string decoded_value(std::string_view text) {
  std::string blanks(text);
  std::ranges::replace(blanks, '+', ' ');
  return decoded(blanks);
}

/// The first value of a name is taken.
ViewQuery query_of(std::string_view text) {
  ViewQuery query;
  while (!text.empty()) {
    std::string_view value = take_until(text, "&");
    const std::string_view name = take_until(value, "=");
    query.emplace(decoded_value(name), decoded_value(value));
  }
  return query;
}

bool read_request_line(std::string_view line, HttpRequest& request) {
  request.method = take_until(line, " ");
  std::string_view target = take_until(line, " ");
  if (!target.starts_with('/') || (line != "HTTP/1.1" && line != "HTTP/1.0")) return false;
  request.keeps_connection = line == "HTTP/1.1";
  request.path = decoded(take_until(target, "?"));
  request.query = query_of(target);
  return true;
}

/// A second host is refused: a server in between could take the other one for what is meant.
bool read_field(std::string_view line, HttpRequest& request) {
  if (line.find(':') == std::string_view::npos) return false;
  const std::string name = lower_case(take_until(line, ":"));
  const std::string_view value = without_blanks(line);
  if (name == "host") {
    if (!request.host.empty()) return false;
    request.host = value;
  } else if (name == "connection") {
    if (lower_case(value).find("close") != std::string::npos) request.keeps_connection = false;
  } else if (name == "transfer-encoding" || (name == "content-length" && value != "0")) {
    request.has_body = true;
  }
  return true;
}

}  // namespace

std::optional<HttpRequest> http_request_of(std::string_view head) {
  HttpRequest request;
  if (!read_request_line(take_until(head, "\r\n"), request)) return std::nullopt;
  while (!head.empty())
    if (!read_field(take_until(head, "\r\n"), request)) return std::nullopt;
  return request;
}

}  // namespace farlod
