// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/city/json_cursor.hpp"

#include <algorithm>
#include <charconv>

namespace farlod {
namespace {

constexpr std::string_view white_space = " \t\r\n", ends_of_tokens = " \t\r\n,]}";

void append_utf8(std::string& text, std::uint32_t code) {
  const auto continuation = [&](int shift) { text += static_cast<char>(0x80 | ((code >> shift) & 0x3f)); };
  if (code < 0x80) {
    text += static_cast<char>(code);
  } else if (code < 0x800) {
    text += static_cast<char>(0xc0 | (code >> 6));
    continuation(0);
  } else if (code < 0x10000) {
    text += static_cast<char>(0xe0 | (code >> 12));
    continuation(6);
    continuation(0);
  } else {
    text += static_cast<char>(0xf0 | (code >> 18));
    continuation(12);
    continuation(6);
    continuation(0);
  }
}

}  // namespace

JsonCursorError::JsonCursorError(std::size_t at, const std::string& what)
    : std::runtime_error(what + " at byte " + std::to_string(at)) {}

char JsonCursor::peek() {
  at_ = std::min(text_.find_first_not_of(white_space, at_), text_.size());
  return at_ < text_.size() ? text_[at_] : '\0';
}

void JsonCursor::take(char expected) {
  if (peek() != expected) throw JsonCursorError(at_, std::string("there is no \"") + expected + "\"");
  ++at_;
}

bool JsonCursor::take_if(char expected) {
  if (peek() != expected) return false;
  ++at_;
  return true;
}

std::string JsonCursor::string() {
  take('"');
  std::string text;
  for (;;) {
    const std::size_t end = text_.find_first_of("\"\\", at_);
    if (end == text_.npos) throw JsonCursorError(at_, "a string has no end");
    text += text_.substr(at_, end - at_);
    at_ = end + 1;
    if (text_[end] == '"') return text;
    append_escaped(text);
  }
}

void JsonCursor::append_escaped(std::string& text) {
  constexpr std::string_view letters = "\"\\/bfnrt", meanings = "\"\\/\b\f\n\r\t";
  const char letter = at_ < text_.size() ? text_[at_++] : '\0';
  if (const std::size_t k = letters.find(letter); k != letters.npos) {
    text += meanings[k];
    return;
  }
  if (letter != 'u') throw JsonCursorError(at_, "a string has an unknown escape");
  std::uint32_t code = hexadecimal();
  // Characters beyond 16 bits are written as two halves
  if (code >= 0xd800 && code < 0xdc00 && text_.substr(at_, 2) == "\\u") {
    at_ += 2;
    code = 0x10000 + ((code - 0xd800) << 10) + ((hexadecimal() - 0xdc00) & 0x3ff);
  }
  append_utf8(text, code);
}

std::uint32_t JsonCursor::hexadecimal() {
  constexpr std::size_t digits = 4;
  const std::string_view token = text_.substr(at_, digits);
  std::uint32_t code = 0;
  const auto end = std::from_chars(token.data(), token.data() + token.size(), code, 16).ptr;
  if (token.size() != digits || end != token.data() + digits) throw JsonCursorError(at_, "a string has an unknown escape");
  at_ += digits;
  return code;
}

std::string_view JsonCursor::plain_token() {
  (void)peek();
  const std::size_t end = std::min(text_.find_first_of(ends_of_tokens, at_), text_.size());
  const std::string_view token = text_.substr(at_, end - at_);
  if (token.empty()) throw JsonCursorError(at_, "there is no value");
  at_ = end;
  return token;
}

double JsonCursor::number() {
  const std::size_t begin = at_;
  const std::string_view token = plain_token();
  double value = 0.0;
  if (std::from_chars(token.data(), token.data() + token.size(), value).ptr != token.data() + token.size())
    throw JsonCursorError(begin, "there is no number");
  return value;
}

std::optional<std::int64_t> JsonCursor::whole() {
  const std::string_view token = plain_token();
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(token.data(), token.data() + token.size(), value);
  return error == std::errc() && end == token.data() + token.size() ? std::optional(value) : std::nullopt;
}

void JsonCursor::skip_string() {
  for (++at_;; at_ += 2) {
    at_ = text_.find_first_of("\"\\", at_);
    if (at_ == text_.npos) throw JsonCursorError(text_.size(), "a string has no end");
    if (text_[at_] == '"') break;
  }
  ++at_;
}

void JsonCursor::skip() {
  std::size_t depth = 0;
  do {
    const char c = peek();
    if (c == '"') {
      skip_string();
    } else if (c == '{' || c == '[') {
      ++depth;
      ++at_;
    } else if (depth > 0 && (c == '}' || c == ']')) {
      --depth;
      ++at_;
    } else if (depth > 0 && (c == ',' || c == ':')) {
      ++at_;
    } else {
      (void)plain_token();
    }
  } while (depth > 0);
}

}  // namespace farlod
