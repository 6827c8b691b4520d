// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "console/program_description.hpp"

namespace farlod {

/// What the build does instead of running a program: writes its manual page and its completion into the folder that the command
/// line names, as PROGRAM.1, PROGRAM.bash and PROGRAM.zsh. The page has the date of the environment's SOURCE_DATE_EPOCH, or none.
/// `describe` hands over the program. Returns an exit code.
[[nodiscard]] int write_program_documents(int argc, char** argv, const std::function<void(const CommandLineVisitor&)>& describe);

}  // namespace farlod
