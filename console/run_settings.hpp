// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace farlod {

/// An option as it was given, by its long name without dashes, or an argument by its own. That of a flag is "true".
struct GivenOption {
  std::string name;
  std::vector<std::string> values;
};

/// A JSON object with a member for each option: a text, or a list of texts where there are several.
[[nodiscard]] std::string settings_json(std::span<const GivenOption> options);

/// The options in a summary, which has that object as its member `settings`. Empty where the text is no JSON object with that
/// member.
[[nodiscard]] std::optional<std::vector<GivenOption>> settings_of_summary(const std::string& json);

}  // namespace farlod
