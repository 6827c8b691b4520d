// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "validation/wrapped_document.hpp"

#include <algorithm>

namespace farlod {
namespace {

constexpr std::size_t longest_line = 110;

/// Number of characters of UTF-8, whose bytes 10xxxxxx continue a character.
std::size_t character_count(std::string_view text) {
  return static_cast<std::size_t>(std::ranges::count_if(text, [](char c) { return (c & 0xC0) != 0x80; }));
}

/// The part of `text` before its first `end`; both are taken from `text`.
std::string_view take_until(std::string_view& text, char end) {
  const std::size_t at = std::min(text.find(end), text.size());
  const std::string_view part = text.substr(0, at);
  text.remove_prefix(std::min(at + 1, text.size()));
  return part;
}

/// The next word, or the next words as far as a `code span` reaches.
std::string_view take_word(std::string_view& line) {
  const std::string_view from_here = line;
  std::size_t backticks = 0;
  do {
    backticks += static_cast<std::size_t>(std::ranges::count(take_until(line, ' '), '`'));
  } while (backticks % 2 != 0 && !line.empty());
  const std::size_t blank = line.empty() ? 0 : 1;
  return from_here.substr(0, from_here.size() - line.size() - blank);
}

bool is_prose(std::string_view line) { return !line.starts_with('|') && !line.starts_with('#') && !line.starts_with('!'); }

void add_wrapped(std::string_view line, std::string& document) {
  const std::string_view indentation = line.starts_with("* ") ? "  " : "";
  std::size_t length = 0;
  while (!line.empty()) {
    const std::string_view word = take_word(line);
    const std::size_t with_word = length + 1 + character_count(word);
    if (length > 0 && with_word > longest_line) {
      document.append("\n").append(indentation).append(word);
      length = indentation.size() + character_count(word);
    } else {
      document.append(length > 0 ? " " : "").append(word);
      length = length > 0 ? with_word : character_count(word);
    }
  }
}

}  // namespace

std::string wrapped_document(std::string_view markdown) {
  std::string document;
  while (!markdown.empty()) {
    const std::string_view line = take_until(markdown, '\n');
    if (is_prose(line)) {
      add_wrapped(line, document);
    } else {
      document.append(line);
    }
    document.append("\n");
  }
  return document;
}

}  // namespace farlod
