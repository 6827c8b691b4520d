// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "farlod/pack.hpp"

namespace farlod {

/// Throws OutputError when a package may not get this name: there is one already and it shall not be replaced, or a folder that
/// holds anything that is not part of a package, or that cannot change its name. Touches nothing.
void require_room(const std::filesystem::path& folder, Overwrite overwrite);

/// The same, whether or not there is a package already.
void require_replaceable(const std::filesystem::path& folder);

/// Gives a finished package its name. What has the name already changes places with it, in one step where the file system can;
/// `aside` is where it is meanwhile where it cannot. Throws OutputError.
void put_in_place(const std::filesystem::path& finished, const std::filesystem::path& package,
                  const std::filesystem::path& aside);

void move_package(const std::filesystem::path& from, const std::filesystem::path& to);

/// Removes a package that had the name `package`, if there is one. While a process reads it, it is kept beside that name, as
/// NAME.farlod.replaced-1; this is told. Returns an empty text otherwise.
[[nodiscard]] std::string dispose_of_package(const std::filesystem::path& old, const std::filesystem::path& package);

/// Removes those that were kept, and that nobody reads any more.
void remove_replaced_packages(const std::filesystem::path& package);

}  // namespace farlod
