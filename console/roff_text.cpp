// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "console/roff_text.hpp"

#include <fmt/core.h>

#include <bit>
#include <cstdint>
#include <iterator>
#include <regex>

namespace farlod {
namespace {

constexpr std::size_t longest_source_line = 80;

/// The first character of UTF-8, which is taken from `text`. Bytes that are no UTF-8 are taken one by one.
char32_t take_character(std::string_view& text) {
  const auto first = static_cast<std::uint8_t>(text.front());
  text.remove_prefix(1);
  const int length = std::countl_one(first);
  if (length < 2) return first;
  auto character = static_cast<char32_t>(first & (0x7F >> length));
  for (int n = 1; n < length && !text.empty(); ++n, text.remove_prefix(1))
    character = character << 6 | (static_cast<std::uint8_t>(text.front()) & 0x3F);
  return character;
}

std::string roff_character(char32_t c) {
  switch (c) {
    case '\\':
      return "\\(rs";
    case '"':
      return "\\(dq";
    case '`':
      return "\\(ga";
    case '^':
      return "\\(ha";
    case '~':
      return "\\(ti";
    default:
      return c < 0x80 ? std::string(1, static_cast<char>(c)) : fmt::format("\\[u{:04X}]", static_cast<std::uint32_t>(c));
  }
}

/// What stands between names. A hyphen within a word is one; before a word it is a minus sign.
std::string roff_prose(std::string_view text, bool begins_word) {
  std::string roff;
  // At the beginning of a line these two would begin a command, and each word may come to stand there
  if (begins_word && (text.starts_with('.') || text.starts_with('\''))) roff = "\\&";
  for (bool after_letter = !begins_word; !text.empty(); after_letter = true) {
    const char32_t c = take_character(text);
    roff.append(c == '-' && !after_letter ? "\\-" : roff_character(c));
  }
  return roff;
}

std::string roff_word(const std::string& word) {
  static const std::regex name("(^|[^A-Za-z0-9-])(--?[A-Za-z][A-Za-z0-9-]*|farlod-[a-z]+)");
  std::string roff;
  std::size_t end = 0;
  for (std::sregex_iterator match(word.begin(), word.end(), name); match != std::sregex_iterator(); ++match) {
    const auto begin = static_cast<std::size_t>(match->position(2));
    roff.append(roff_prose(std::string_view(word).substr(end, begin - end), end == 0));
    roff.append("\\fB").append(roff_literal(match->str(2))).append("\\fR");
    end = begin + match->str(2).size();
  }
  return roff.append(roff_prose(std::string_view(word).substr(end), end == 0));
}

bool ends_sentence(std::string_view word) {
  while (word.ends_with(')') || word.ends_with('"')) word.remove_suffix(1);
  return word.ends_with('.') || word.ends_with('!') || word.ends_with('?');
}

}  // namespace

std::string roff_literal(std::string_view text) {
  std::string roff = text.starts_with('.') ? "\\&" : "";
  while (!text.empty()) {
    const char32_t c = take_character(text);
    roff.append(c == '-' ? "\\-" : c == '\'' ? "\\(aq" : roff_character(c));
  }
  return roff;
}

std::string roff_paragraph(std::string_view text) {
  static const std::regex blanks("\\s+");
  std::string roff;
  std::size_t length = 0;
  bool sentence_ended = false;
  const std::string all(text);
  for (std::sregex_token_iterator word(all.begin(), all.end(), blanks, -1); word != std::sregex_token_iterator(); ++word) {
    if (word->length() == 0) continue;
    const std::string next = roff_word(*word);
    const bool breaks = length > 0 && (sentence_ended || length + 1 + next.size() > longest_source_line);
    roff.append(breaks ? "\n" : length > 0 ? " " : "").append(next);
    length = (breaks || length == 0 ? 0 : length + 1) + next.size();
    sentence_ended = ends_sentence(word->str());
  }
  return roff + "\n";
}

}  // namespace farlod
