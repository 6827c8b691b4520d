// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/pixel_horizon.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

#include "base/expects.hpp"
#include "horizon/kernels.hpp"

namespace farlod {
namespace {

/// Receivers are floats in their cell, and so off the centres by some micrometres.
constexpr double most_aside = 1e-3, most_pixels = 1e9;

std::vector<Point2d> directions_of(const AzimuthSampling& azimuths, const GridRotation& rotation) {
  std::vector<Point2d> directions;
  for (std::size_t k = 0; k < azimuths.size(); ++k)
    directions.push_back(rotation.city_from_grid(Point2d{double{azimuths.cosine()[k]}, double{azimuths.sine()[k]}}));
  return directions;
}

constexpr auto row_length = static_cast<std::int32_t>(packet_lanes), block_rows = static_cast<std::int32_t>(PixelBlock::rows);

/// Azimuths from one that is drawn to the next, where so many of the pixels nearby are torn: what is torn makes horizons jump,
/// and what is narrow is missed between two azimuths.
std::size_t step_of(std::size_t azimuths, double torn_share) {
  constexpr std::size_t enough = 64;
  constexpr double few = 0.02;
  std::size_t step = torn_share == 0.0 ? 4 : torn_share < few ? 2 : 1;
  while (step > 1 && (azimuths % step != 0 || azimuths / step < enough)) step /= 2;
  return step;
}

/// A window's square, a place in pixels, a column of blocks in it, and a row: packets in this order fill blocks.
std::array<std::int32_t, 6> order_of_place(std::int32_t column, std::int32_t row, const PixelOffset& offset) {
  return {row / PixelWindow::edge, column / PixelWindow::edge, offset.north, offset.east, column / row_length, row};
}

}  // namespace

PixelCity::PixelCity(const package::Manifest& m, std::span<const float> height_m, std::span<const std::uint8_t> joined,
                     const AzimuthSampling& azimuths)
    : manifest(m),
      field(*m.pixels, height_m, joined),
      directions(directions_of(azimuths, m.grid.rotation)),
      paths(directions, field) {}

PixelHorizon::PixelHorizon(const PixelCity& city, Cell cell, HorizonUse use)
    : city_(city), use_(use), corner_grid_(city.manifest.grid.corner_of(cell)), window_(city.field) {}

Point2d PixelHorizon::pixels_at(Point2d p_cell) const {
  const package::SurfacePixels& pixels = *city_.manifest.pixels;
  const Point2d p = city_.manifest.origin_m + city_.manifest.grid.rotation.city_from_grid(corner_grid_ + p_cell);
  return {(p.x - pixels.north_west_m.x) / pixels.step_m - 0.5, (p.y - pixels.north_west_m.y) / pixels.step_m + pixels.rows - 0.5};
}

std::optional<PixelHorizon::Place> PixelHorizon::place_of(const Point3f& p_cell) const {
  const Point2d p = pixels_at({double{p_cell.x}, double{p_cell.y}});
  const Point2d centre{std::round(p.x), std::round(p.y)};
  // Numbers beyond those of pixels may be none of an integer
  if (std::abs(centre.x) > most_pixels || std::abs(centre.y) > most_pixels) return std::nullopt;
  const bool is_centre = std::abs(p.x - centre.x) <= most_aside && std::abs(p.y - centre.y) <= most_aside;
  const auto part = [is_centre](double pixels) {
    return is_centre ? std::int16_t{0} : static_cast<std::int16_t>(std::lround(pixels * PixelOffset::parts));
  };
  const Place place{
      static_cast<std::int32_t>(centre.x), static_cast<std::int32_t>(centre.y), {part(p.x - centre.x), part(p.y - centre.y)}};
  return city_.field.contains(place.column, place.row) ? std::optional(place) : std::nullopt;
}

ReceiversOnPixels PixelHorizon::packets_of(std::span<const Receiver> receivers) const {
  std::vector<OnPixel> found;
  ReceiversOnPixels result;
  for (std::size_t n = 0; n < receivers.size(); ++n) {
    const std::optional<Place> place = place_of(receivers[n].p_cell);
    if (place)
      found.push_back({*place, static_cast<std::uint32_t>(n)});
    else
      result.others.push_back(static_cast<std::uint32_t>(n));
  }
  result.on_pixels = order_of(std::move(found));
  return result;
}

PacketOrder PixelHorizon::order_of(std::vector<OnPixel> receivers) {
  const auto place = [](const OnPixel& r) { return order_of_place(r.place.column, r.place.row, r.place.offset); };
  std::ranges::sort(receivers, {}, [&](const OnPixel& r) { return std::tuple(place(r), r.place.column, r.number); });
  PacketOrder order;
  std::size_t packets = 0;
  for (std::size_t n = 0; n < receivers.size(); ++n) {
    order.numbers.push_back(receivers[n].number);
    const bool is_last = n + 1 == receivers.size();
    // A pixel is one of a packet once: other receivers above it are in other packets
    if (!is_last && place(receivers[n]) == place(receivers[n + 1]) && receivers[n].place.column != receivers[n + 1].place.column)
      continue;
    order.ends.push_back(static_cast<std::uint32_t>(n + 1));
    const auto is_together = [&](std::size_t m) {
      const auto a = place(receivers[m]), b = place(receivers[m + 1]);
      return std::equal(a.begin(), a.begin() + 4, b.begin());
    };
    if (++packets < packets_in_group && !is_last && is_together(n)) continue;
    order.group_ends.push_back(static_cast<std::uint32_t>(order.ends.size()));
    packets = 0;
  }
  return order;
}

PixelHorizon::Place PixelHorizon::place_of(const ReceiverPacket& packet, std::size_t lane) const {
  const std::optional<Place> place = place_of({packet.x[lane], packet.y[lane], packet.z[lane]});
  FARLOD_EXPECTS(place.has_value());
  return *place;
}

void PixelHorizon::add_to_blocks(const ReceiverPacket& packet, float* slopes) {
  const Place first = place_of(packet, 0);
  const std::int32_t column = first.column / row_length * row_length;
  const bool goes_on =
      !blocks_.empty() && blocks_.back().column == column && first.row > last_row_ && first.row < blocks_.back().row + block_rows;
  if (!goes_on) {
    PixelBlock& block = blocks_.emplace_back();
    block.column = column;
    block.row = first.row;
    for (auto& z_m : block.z_m) std::ranges::fill(z_m, PixelBlock::no_receiver_m);
  }
  last_row_ = first.row;
  PixelBlock& block = blocks_.back();
  const auto row = static_cast<std::size_t>(first.row - block.row);
  block.slopes[row] = slopes;
  for (std::size_t l = 0; l < packet.count; ++l) block.z_m[row][place_of(packet, l).column - column] = packet.z[l];
}

void PixelHorizon::draw(std::span<const ReceiverPacket> packets, std::span<PacketHorizon> horizons) {
  const std::size_t azimuths = city_.paths.paths().size();
  const Place first = place_of(packets.front(), 0);
  window_.look_at(first.column / PixelWindow::edge * PixelWindow::edge, first.row / PixelWindow::edge * PixelWindow::edge);
  blocks_.clear();
  drawn_.resize(packets.size() * azimuths);
  for (std::size_t n = 0; n < packets.size(); ++n) {
    const bool is_full = packets[n].count == packet_lanes;
    add_to_blocks(packets[n], is_full ? horizons[n].drawn_slopes() : drawn_[n * azimuths].data());
  }
  for (PixelBlock& block : blocks_) {
    block.window_x = window_.x_of(block.column);
    block.window_y = window_.y_of(block.row);
  }
  const std::size_t step = use_ == HorizonUse::sum ? step_of(azimuths, window_.torn_share()) : 1;
  pixel_kernels().march(window_.view(), city_.field.view(), paths_from(first.offset).paths(), blocks_, step);
  for (std::size_t n = 0; n < packets.size(); ++n)
    if (packets[n].count < packet_lanes)
      copy_drawn(packets[n], std::span(drawn_).subspan(n * azimuths, azimuths), horizons[n].drawn_slopes());
}

const PixelPaths& PixelHorizon::paths_from(const PixelOffset& offset) {
  if (offset == PixelOffset{}) return city_.paths;
  if (!paths_ || offset != offset_) paths_.emplace(city_.directions, city_.field, offset);
  offset_ = offset;
  return *paths_;
}

/// From the pixels of a row to the receivers above some of them.
void PixelHorizon::copy_drawn(const ReceiverPacket& packet, std::span<const PacketHorizon::Row> drawn, float* slopes) const {
  std::array<std::size_t, packet_lanes> pixel_of_lane{};
  for (std::size_t l = 0; l < packet_lanes; ++l)
    pixel_of_lane[l] = static_cast<std::size_t>(place_of(packet, l).column % row_length);
  for (std::size_t k = 0; k < drawn.size(); ++k)
    for (std::size_t l = 0; l < packet_lanes; ++l) slopes[k * packet_lanes + l] = drawn[k][pixel_of_lane[l]];
}

}  // namespace farlod
