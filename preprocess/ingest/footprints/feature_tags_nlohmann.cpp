// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <nlohmann/json.hpp>

#include "ingest/footprints/feature_tags.hpp"

namespace farlod::ingest {
namespace {

using Json = nlohmann::ordered_json;

/// "a"=>"b","c"=>"d" as {"a":"b","c":"d"}. Both write a quotation mark within a text with a backslash before it.
std::string json_of_list(const std::string& text) {
  std::string json = "{";
  bool is_quoted = false;
  for (std::size_t n = 0; n < text.size(); ++n) {
    if (text[n] == '\\' && n + 1 < text.size()) {
      json += text[n++];
    } else if (text[n] == '"') {
      is_quoted = !is_quoted;
    } else if (!is_quoted && text.compare(n, 2, "=>") == 0) {
      json += ':';
      ++n;
      continue;
    }
    json += text[n];
  }
  return json + "}";
}

}  // namespace

Tags tags_in(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string::npos) return {};
  const Json tags = Json::parse(text[first] == '{' ? text : json_of_list(text), nullptr, false);
  Tags found;
  if (!tags.is_object()) return found;
  for (const auto& [key, value] : tags.items()) {
    if (value.is_string()) found.emplace_back(key, value.get<std::string>());
    if (value.is_number()) found.emplace_back(key, value.dump());
  }
  return found;
}

}  // namespace farlod::ingest
