// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
class ParseError;
class Validator;
}  // namespace CLI

namespace farlod {

/// Checks that an option is one of these words. The complaint names the nearest of them.
[[nodiscard]] CLI::Validator one_of_words(const std::vector<std::string>& words);

/// What a user is told whose command line CLI11 refuses: one sentence with the option, what is wrong with it, and what to give.
/// CLI11 speaks of types and counts, in other words in each version, and of what comes first in its own order: a misspelt option
/// is told before what is missing for it, and an option that was taken for the value of another before that value.
[[nodiscard]] std::string wrong_usage_text(const CLI::App& app, const CLI::ParseError& error);

/// Throws CLI::ValidationError where an option that was to have a value took the next option for it.
void require_no_option_as_value(const CLI::App& app);

}  // namespace farlod
