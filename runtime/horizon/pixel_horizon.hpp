// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/grid.hpp"
#include "horizon/azimuth_sampling.hpp"
#include "horizon/packet_horizon.hpp"
#include "horizon/pixel_field.hpp"
#include "horizon/receiver_packet.hpp"
#include "package/manifest.hpp"
#include "receivers/receiver.hpp"

namespace farlod {

/// A city that is a raster, and the ways of rays over its pixels at the azimuths of a sampling. All threads share it.
struct PixelCity {
  PixelCity(const package::Manifest& m, std::span<const float> height_m, std::span<const std::uint8_t> joined,
            const AzimuthSampling& azimuths);
  const package::Manifest& manifest;
  PixelField field;
  std::vector<Point2d> directions;  ///< in the frame of the pixels, which run to the east and to the north
  PixelPaths paths;                 ///< from the centres of pixels
};

/// The receivers of a cell that stand above pixels, and the others.
struct ReceiversOnPixels {
  PacketOrder on_pixels;  ///< packets are above sixteen pixels in a row, or above some of them, and stand alike in these
  std::vector<std::uint32_t> others;
};

/// What horizons are for: where their sky is summed up, those between two that are nearly alike need not be drawn.
enum class HorizonUse : std::uint8_t { sum, each_azimuth };

/// Horizons of receivers of one cell above a raster's pixels: rays march over all pixels, as far as the raster reaches. Those who
/// stand alike in their pixels march together, such as at the centres. docs/concepts.md, "A march over pixels".
class PixelHorizon {
 public:
  /// The city must outlive it.
  PixelHorizon(const PixelCity& city, Cell cell, HorizonUse use);

  [[nodiscard]] ReceiversOnPixels packets_of(std::span<const Receiver> receivers) const;
  /// Draws the horizons of packets that packets_of() made; of one group.
  void draw(std::span<const ReceiverPacket> packets, std::span<PacketHorizon> horizons);

 private:
  struct Place {
    std::int32_t column, row;
    PixelOffset offset;
  };
  struct OnPixel {
    Place place;
    std::uint32_t number;
  };
  [[nodiscard]] Point2d pixels_at(Point2d p_cell) const;
  [[nodiscard]] std::optional<Place> place_of(const Point3f& p_cell) const;
  [[nodiscard]] static PacketOrder order_of(std::vector<OnPixel> receivers);
  [[nodiscard]] Place place_of(const ReceiverPacket& packet, std::size_t lane) const;
  /// A packet is a row of a block, whose slopes are drawn there.
  void add_to_blocks(const ReceiverPacket& packet, float* slopes);
  void copy_drawn(const ReceiverPacket& packet, std::span<const PacketHorizon::Row> drawn, float* slopes) const;
  [[nodiscard]] const PixelPaths& paths_from(const PixelOffset& offset);

  const PixelCity& city_;
  HorizonUse use_;
  Point2d corner_grid_;
  PixelWindow window_;
  PixelOffset offset_;
  std::optional<PixelPaths> paths_;  ///< from there, once it is no centre
  // Working memory
  std::vector<PixelBlock> blocks_;
  std::int32_t last_row_ = 0;              ///< of the last block
  std::vector<PacketHorizon::Row> drawn_;  ///< [packet][azimuth]
};

}  // namespace farlod
