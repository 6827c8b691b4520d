// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <charconv>
#include <limits>
#include <string>
#include <string_view>

namespace farlod::ingest {

/// Reads the numbers of a text that comes in pieces. A piece may end within a number. Stores one word, never the whole text.
class NumberScanner {
 public:
  /// Calls `sink` with each complete number, and with NaN for each word that is not a number.
  template <class Sink>
  void take(std::string_view piece, Sink&& sink) {
    const char *p = piece.data(), *const end = p + piece.size();
    if (!begun_word_.empty()) p = complete_word(p, end, sink);
    while (p != end) {
      if (is_separator(*p)) {
        ++p;
        continue;
      }
      double value = 0.0;
      const auto [stop, error] = std::from_chars(p, end, value);
      if (error == std::errc() && stop != end && is_separator(*stop)) {
        sink(value);
        p = stop;
      } else {
        p = complete_word(p, end, sink);
      }
    }
  }

  /// Ends the text, and with it the last word.
  template <class Sink>
  void end(Sink&& sink) {
    if (begun_word_.empty()) return;
    sink(number_from(begun_word_));
    begun_word_.clear();
  }

 private:
  /// A longer word is not a number and is not kept as a whole.
  static constexpr std::size_t longest_word = 1024;

  static bool is_separator(char c) { return c == ' ' || c == '\n' || c == '\t' || c == '\r' || c == ','; }

  /// Continues the last word of the piece before, and calls `sink` if the word ends within this piece.
  template <class Sink>
  const char* complete_word(const char* p, const char* end, Sink&& sink) {
    for (; p != end && !is_separator(*p); ++p)
      if (begun_word_.size() <= longest_word) begun_word_.push_back(*p);
    if (p != end) this->end(sink);
    return p;
  }

  static double number_from(std::string_view word) {
    if (word.starts_with('+')) word.remove_prefix(1);
    double value = 0.0;
    const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    const bool is_number = error == std::errc() && stop == word.data() + word.size() && word.size() <= longest_word;
    return is_number ? value : std::numeric_limits<double>::quiet_NaN();
  }

  std::string begun_word_;
};

}  // namespace farlod::ingest
