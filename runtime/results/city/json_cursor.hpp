// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace farlod {

/// A text that is not the JSON that a reader expects. The message says what, and at which byte.
class JsonCursorError : public std::runtime_error {
 public:
  JsonCursorError(std::size_t at, const std::string& what);
};

/// Where the members of an object, or the elements of an array, begin and end in a text.
struct JsonExtent {
  std::size_t first = 0;  ///< behind the opening bracket
  std::size_t last = 0;   ///< behind the last value; `first` where there is none
  [[nodiscard]] bool is_empty() const { return first == last; }
};

/// Reads a JSON text value by value, and knows the place of each in the text, which a tree would not tell. It is lenient where
/// nothing depends on it: the text of a value that is skipped is not checked. Nesting needs no stack. All functions throw
/// JsonCursorError; none reads beyond the text.
class JsonCursor {
 public:
  explicit JsonCursor(std::string_view text, std::size_t at = 0) : text_(text), at_(at) {}

  /// The next byte to read.
  [[nodiscard]] std::size_t at() const { return at_; }
  /// The first byte of the next value, behind white space; '\0' at the end of the text.
  [[nodiscard]] char peek();

  /// Calls `on(name)` for each member of the object that comes next. It may read the value; else the value is skipped.
  template <class OnMember>
  JsonExtent members(const OnMember& on) {
    return values('{', '}', [&] {
      const std::string name = string();
      take(':');
      (void)peek();
      read_or_skip([&] { on(name); });
    });
  }
  /// The same for an array: calls `on(index)`.
  template <class OnElement>
  JsonExtent elements(const OnElement& on) {
    std::size_t index = 0;
    return values('[', ']', [&] { read_or_skip([&] { on(index++); }); });
  }

  [[nodiscard]] std::string string();
  [[nodiscard]] double number();
  /// Empty where the number has a fraction or an exponent, or is too large.
  [[nodiscard]] std::optional<std::int64_t> whole();
  void skip();

 private:
  void take(char expected);
  [[nodiscard]] bool take_if(char expected);
  [[nodiscard]] std::string_view plain_token();
  void skip_string();
  void append_escaped(std::string& text);
  [[nodiscard]] std::uint32_t hexadecimal();

  template <class Read>
  void read_or_skip(const Read& read) {
    const std::size_t before = at_;
    read();
    if (at_ == before) skip();
  }

  template <class OnValue>
  JsonExtent values(char open, char close, const OnValue& on_value) {
    take(open);
    JsonExtent extent{at_, at_};
    if (take_if(close)) return extent;
    do {
      (void)peek();
      on_value();
      extent.last = at_;
    } while (take_if(','));
    take(close);
    return extent;
  }

  std::string_view text_;
  std::size_t at_;
};

}  // namespace farlod
