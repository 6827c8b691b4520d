// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/citygml/citygml_skipped.hpp"

#include <string>

#include "ingest/citygml/citygml_vocabulary.hpp"

namespace farlod::ingest {
namespace {

constexpr std::size_t longest_name = 200;

/// The first characters. The cut is not inside a UTF-8 character, which could not be written as JSON.
std::string beginning_of(std::string_view text) {
  if (text.size() <= longest_name) return std::string(text);
  std::size_t end = longest_name;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;
  return std::string(text.substr(0, end)) + "...";
}

}  // namespace

void SkippedCount::add(const XmlElement& element) {
  std::string name = beginning_of(element.name);
  if (vocabulary_of(element.space) == Vocabulary::foreign && !element.space.empty())
    name += " (" + beginning_of(element.space) + ")";
  const bool is_told_apart = counts_.size() < most_names || counts_.contains(name);
  ++counts_[is_told_apart ? name : other_names];
}

bool SkippedCount::append(const SkippedCount& next) {
  for (const auto& [name, count] : next.counts_) counts_[name] += count;
  return counts_.size() <= most_names && !counts_.contains(other_names);
}

}  // namespace farlod::ingest
