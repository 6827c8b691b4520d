// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "view/http_request.hpp"

#include <algorithm>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/parser.hpp>
#include <charconv>

namespace farlod {
namespace {

namespace http = boost::beast::http;

/// Empty where the field is missing.
std::string_view value_of(const http::request_header<>& header, http::field field) {
  const auto value = header[field];
  return {value.data(), value.size()};
}

/// What stands in front of the separator, which is taken off `text` with it; all of `text` where there is none.
std::string_view take_until(std::string_view& text, std::string_view separator) {
  const std::size_t end = text.find(separator);
  const std::string_view taken = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + separator.size());
  return taken;
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

/// A value of a query, where a plus sign is a blank.
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

/// The head of a message, if that is all of the text. Beast refuses what RFC 9112 does.
std::optional<http::request_header<>> header_of(std::string_view head) {
  const std::string text = std::string(head) + "\r\n\r\n";
  http::request_parser<http::empty_body> parser;
  boost::system::error_code error;
  const std::size_t length = parser.put(boost::asio::buffer(text), error);
  if (error || !parser.is_header_done() || length != text.size()) return std::nullopt;
  return parser.release().base();
}

bool announces_body(const http::request_header<>& header) {
  const std::string_view length = value_of(header, http::field::content_length);
  return header.count(http::field::transfer_encoding) > 0 || (!length.empty() && length != "0");
}

}  // namespace

std::optional<HttpRequest> http_request_of(std::string_view head) {
  const auto header = header_of(head);
  // A second host is refused: a server in between could take the other one for what is meant
  if (!header || !header->target().starts_with('/') || header->count(http::field::host) > 1) return std::nullopt;
  std::string_view target(header->target().data(), header->target().size());
  const std::string path = decoded(take_until(target, "?"));
  return HttpRequest{.method = std::string(header->method_string()),
                     .path = path,
                     .query = query_of(target),
                     .host = std::string(value_of(*header, http::field::host)),
                     .has_body = announces_body(*header),
                     .keeps_connection = http::message<true, http::empty_body>(*header).keep_alive()};
}

}  // namespace farlod
