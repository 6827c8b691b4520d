// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

#include "city/source.hpp"

namespace farlod::ingest {

/// A text that is JSON, but not CityJSON.
class JsonFlaw : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A text that is not JSON.
class SyntaxFlaw : public JsonFlaw {
  using JsonFlaw::JsonFlaw;
};

/// A message of nlohmann without the number in brackets that it begins with.
[[nodiscard]] inline std::string plain(std::string_view message) {
  const std::size_t at = message.find("] ");
  return std::string(at == message.npos ? message : message.substr(at + 2));
}

/// ", but 15 SolitaryVegetationObject": the objects of a file without buildings.
[[nodiscard]] inline std::string said(const SkippedFeatures& skipped) {
  std::string text;
  for (const auto& [type, count] : skipped) text += (text.empty() ? ", but " : ", ") + std::to_string(count) + " " + type;
  return text;
}

}  // namespace farlod::ingest
