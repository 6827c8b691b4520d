// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include "console/run_options.hpp"

namespace farlod {
namespace {

using Json = nlohmann::ordered_json;

/// What somebody wrote by hand may be a number, or true.
std::string text_of(const Json& value) { return value.is_string() ? value.get<std::string>() : value.dump(); }

}  // namespace

std::string settings_json(std::span<const GivenOption> options) {
  Json settings = Json::object();
  for (const GivenOption& option : options)
    settings[option.name] = option.values.size() == 1 ? Json(option.values.front()) : Json(option.values);
  return settings.dump(-1, ' ', false, Json::error_handler_t::replace);  // the name of a file may be no UTF-8
}

std::optional<std::vector<GivenOption>> settings_of_summary(const std::string& json) {
  const Json summary = Json::parse(json, nullptr, false);
  if (!summary.is_object() || !summary.contains("settings") || !summary.at("settings").is_object()) return std::nullopt;
  std::vector<GivenOption> options;
  for (const auto& [name, value] : summary.at("settings").items()) {
    GivenOption& option = options.emplace_back(GivenOption{name, {}});
    if (!value.is_array()) option.values.push_back(text_of(value));
    for (const Json& one : value.is_array() ? value : Json::array()) option.values.push_back(text_of(one));
  }
  return options;
}

}  // namespace farlod
