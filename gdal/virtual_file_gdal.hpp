// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace farlod {

/// What a file is that a virtual format names.
enum class SourceKind { unknown, data, names_others };

/// Throws InputError for a name that leads GDAL to the network: an address, or a virtual file system other than those of archives
/// on this computer. `shown` is the file that has the name.
void require_local_name(const std::string& name, const std::string& shown);

/// Checks a VRT, of rasters or of features, before GDAL opens it: each file that it names must be on this computer, must hold its
/// data or be such a VRT itself, and nothing in it may be code or a query. Throws InputError, which names what is not so.
void require_local_sources(const std::filesystem::path& file, const std::function<SourceKind(const std::string&)>& kind_of);

}  // namespace farlod
