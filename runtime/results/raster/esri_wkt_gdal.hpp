// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace farlod {

/// The same CRS in the words of a .prj file (WKT 1 as ESRI speaks it): neither ESRI's programs nor GDAL 3.6 know WKT 2 there.
/// What cannot be said in them comes back as it is.
[[nodiscard]] std::string esri_wkt_of(const std::string& wkt);

}  // namespace farlod
