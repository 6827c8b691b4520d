// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "console/option_list.hpp"

namespace farlod {

/// Scripts that let a shell complete the command line of a program: names of options, choices, files and folders. Where anything
/// may be written, such as a number, they offer nothing.

/// For bash, which finds it under the program's name. Needs no library of functions.
[[nodiscard]] std::string bash_completion(const std::string& program, const OptionList& options);

/// For zsh, which finds it under the program's name after an underscore. Options come with what --help says of them.
[[nodiscard]] std::string zsh_completion(const std::string& program, const OptionList& options);

}  // namespace farlod
