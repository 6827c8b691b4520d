// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace farlod {

/// What a module shows, as `farlod_module`. A module is a library of ours that a program loads when it is asked for something
/// that needs it, since most of the time of a short run is that of the dynamic linker (docs/decisions/0029-modules.md).
struct ModuleEntry {
  const char* version;    ///< of Far-LoD: tables of two versions differ
  const void* functions;  ///< the table of functions, of the type that the loader of the module knows
};

/// Loads `lib/farlod/NAME.so`, beside the folder of the program, and returns its table of functions. It stays until the program
/// ends. Throws InputError, which says what `library` is needed for, and what is missing.
[[nodiscard]] const void* functions_of_module(const char* name, const char* library);

}  // namespace farlod
