// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>

namespace farlod {

/// An input as a whole cannot be read or used (exit code 3). The message names the file, says what is wrong with it,
/// and what the user can do. A single bad building is never this: it is a Problem in the report.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace farlod
