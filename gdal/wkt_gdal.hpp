// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

// Private to the wrappers of GDAL: it names one of its classes.
class OGRSpatialReference;

namespace farlod {

/// WKT2:2019 of a reference system; empty where there is none, or where GDAL cannot write it.
[[nodiscard]] std::string wkt_of(const OGRSpatialReference* reference);

}  // namespace farlod
