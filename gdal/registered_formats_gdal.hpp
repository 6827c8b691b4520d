// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gdal_priv.h>

// Private to the wrappers of GDAL: it names its classes.

namespace farlod {

/// All formats of GDAL. A GDAL that an archive or a wheel brings along reads the data that came with it, unless GDAL_DATA names
/// others, and no plug-ins of the system, which are for another GDAL. Where they lie: packaging/portable/README.md.
[[nodiscard]] GDALDriverManager& registered_formats();

}  // namespace farlod
