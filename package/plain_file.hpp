// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace farlod {

/// Throws PackageDamaged where a name within the folder of a package is anything but a file, or a folder on the way to it is
/// anything but a folder: a link, which may lead out of the package; a pipe or a device, which a reader could wait for without an
/// end. The folder itself may be a link; `shown` is what messages call it. A file that is missing is for its reader to tell.
void require_plain_file(const std::filesystem::path& folder, const std::filesystem::path& name,
                        const std::filesystem::path& shown);

}  // namespace farlod
