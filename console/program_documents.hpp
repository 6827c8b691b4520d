// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include "console/option_list.hpp"
#include "console/run_options.hpp"

namespace farlod {

/// Scripts that let a shell complete the command line of a program: names of options, choices, files and folders. Where anything
/// may be written, such as a number, they offer nothing.

/// For bash, which finds it under the program's name. Needs no library of functions.
[[nodiscard]] std::string bash_completion(const std::string& program, const OptionList& options);

/// For zsh, which finds it under the program's name after an underscore. Options come with what --help says of them.
[[nodiscard]] std::string zsh_completion(const std::string& program, const OptionList& options);

/// What the build does instead of running a program: writes its completions into the folder that the command line names, as
/// PROGRAM.bash and PROGRAM.zsh. `describe` hands over the program. Returns an exit code.
[[nodiscard]] int write_program_documents(int argc, char** argv, const std::function<void(const CommandLineVisitor&)>& describe);

}  // namespace farlod
