// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace CLI {
class Validator;
}

namespace farlod {

/// Checks that an option is a number from `low` to `high`. CLI11's own Range accepts NaN, which is neither below
/// nor above, and says something else in each version.
[[nodiscard]] CLI::Validator between(double low, double high);

}  // namespace farlod
