// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "inputs/text_records.hpp"

#include <algorithm>
#include <utility>

namespace farlod {
namespace {

std::string trimmed(std::string_view field) {
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!field.empty() && blank(field.front())) field.remove_prefix(1);
  while (!field.empty() && blank(field.back())) field.remove_suffix(1);
  return std::string(field);
}

/// Walks through the text once, a character at a time.
class RecordSplitter {
 public:
  explicit RecordSplitter(char separator) : separator_(separator) {}

  void take(char c) {
    line_ += c == '\n' ? 1 : 0;
    if (c == '"')
      take_quote();
    else if (quoted_ || (c != separator_ && c != '\n'))
      field_ += c;
    else
      end_field(c);
    after_closing_quote_ = c == '"' && !quoted_;
  }
  std::vector<TextRecord> finish() {
    end_field('\n');
    return std::move(records_);
  }

 private:
  void take_quote() {
    // A quote right after a closing one stands for the character itself
    if (after_closing_quote_) field_ += '"';
    quoted_ = !quoted_;
  }
  void end_field(char end) {
    record_.fields.push_back(trimmed(field_));
    field_.clear();
    if (end == separator_) return;
    const bool empty = std::all_of(record_.fields.begin(), record_.fields.end(), [](const std::string& f) { return f.empty(); });
    if (!empty) records_.push_back(std::move(record_));
    record_ = {line_, {}};
  }

  char separator_;
  bool quoted_ = false, after_closing_quote_ = false;
  std::size_t line_ = 1;
  std::string field_;
  TextRecord record_{1, {}};
  std::vector<TextRecord> records_;
};

}  // namespace

std::string_view without_byte_order_mark(std::string_view text) {
  constexpr std::string_view mark = "\xEF\xBB\xBF";
  return text.starts_with(mark) ? text.substr(mark.size()) : text;
}

char separator_of(std::string_view row) {
  bool tab = false, semicolon = false, quoted = false;
  for (const char c : row) {
    if (c == '"') quoted = !quoted;
    tab = tab || (!quoted && c == '\t');
    semicolon = semicolon || (!quoted && c == ';');
  }
  return tab ? '\t' : semicolon ? ';' : ',';
}

std::vector<TextRecord> split_records(std::string_view text, char separator) {
  RecordSplitter splitter(separator);
  for (const char c : text) splitter.take(c);
  return splitter.finish();
}

}  // namespace farlod
