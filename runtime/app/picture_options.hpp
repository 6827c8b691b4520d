// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "app/svf_options.hpp"

namespace CLI {
class App;
}

namespace farlod {

/// What the options of pictures say, as text, unless SvfOptions has it so.
struct RawPictures {
  std::string projection;
};

/// Pictures besides -o, and how the sky is laid into one.
void add_picture_options(CLI::App& app, RawPictures& raw, SvfOptions& o);

/// Once the receivers and the format of -o are known. Also of the map of a verification. Throws CLI::ValidationError.
void resolve_pictures(const RawPictures& raw, SvfOptions& o);

/// Whether a picture of a raster has room for what is asked for: one quantity beside svf.
[[nodiscard]] bool fits_picture(const RawQuantities& raw);

/// The quantity that a picture shows: that which --quantity names last, else that of another option; empty
/// where nothing is named.
[[nodiscard]] std::string drawn_quantity(const RawQuantities& raw);

/// Where the band that a picture shows is among those of a raster: the first of the drawn quantity. Where nothing is named, it is
/// svf_total if that comes by itself, of a city with trees.
[[nodiscard]] std::size_t drawn_band_of(const SvfOptions& options, const std::vector<ColumnDescription>& bands);
/// When, below what sky and how high a column of a run is: "2026-06-21, clear sky, 1.5 m above the ground".
[[nodiscard]] std::string conditions_of(const SvfOptions& options, const std::string& column);

}  // namespace farlod
