// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "farlod/error.hpp"

namespace farlod::acceptance {

/// What follows the name of a program in a command that cannot be followed, and what the user must be told.
struct RefusedCommand {
  std::string name, arguments;
  int exit_code;
  std::vector<std::string> said;
};
inline void PrintTo(const RefusedCommand& refused, std::ostream* out) { *out << refused.arguments; }

inline RefusedCommand wrong_usage(const std::string& name, const std::string& arguments, const std::vector<std::string>& said) {
  return {name, arguments, exit_usage, said};
}
inline RefusedCommand unusable(const std::string& name, const std::string& arguments, const std::vector<std::string>& said) {
  return {name, arguments, exit_unusable_input, said};
}

inline std::string name_of_refused(const testing::TestParamInfo<RefusedCommand>& info) { return info.param.name; }

}  // namespace farlod::acceptance
