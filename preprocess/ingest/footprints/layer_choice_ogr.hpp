// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "farlod/pack.hpp"

// Private to the wrappers of GDAL: it names its classes.
class GDALDataset;
class OGRLayer;

namespace farlod::ingest {

/// The names of the layers that hold areas, but for one.
[[nodiscard]] std::string other_layers(GDALDataset& dataset, const OGRLayer* chosen);

/// The layer that the settings name; else the first one of areas with the height field that they name; else the first one of
/// areas; null where there is none. Throws InputError where one is named that is not there, or holds no areas.
[[nodiscard]] OGRLayer* choose_layer(GDALDataset& dataset, const std::string& file, const FootprintSettings& settings);

}  // namespace farlod::ingest
