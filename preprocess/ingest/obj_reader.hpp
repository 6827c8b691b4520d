// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "ingest/city_writer.hpp"
#include "ingest/ingest.hpp"

namespace farlod {

/// Reads an OBJ file. Each group (`g`) is a building, or each object (`o`) where it has more than one; without either, what
/// hangs together. A name that comes again starts another building. Coplanar neighbours share a surface number. Throws InputError
/// when there are no faces.
void read_obj(const std::filesystem::path& file, const IngestSettings& settings, CityWriter& writer);

}  // namespace farlod
