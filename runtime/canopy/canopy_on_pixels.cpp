// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "canopy/canopy_on_pixels.hpp"

#include <algorithm>
#include <array>
#include <tuple>

#include "base/expects.hpp"

namespace farlod {
namespace {

/// Edge of the squares of pixels whose receivers are a group: a group has no more rows than are marched at once.
constexpr std::int32_t square_edge = canopy_square;
static_assert(square_edge == packet_lanes && square_edge == most_canopy_rows && packets_in_group == packet_lanes);

constexpr std::uint32_t all_pixels = (1U << packet_lanes) - 1;

constexpr std::int32_t square_of(std::int32_t pixel) {
  return pixel >= 0 ? pixel / square_edge : -((square_edge - 1 - pixel) / square_edge);
}

/// Appends the packets of some receivers, which these numbers name, to an order: as one group, or in the groups that they have.
void append(const PacketOrder& some, std::span<const std::uint32_t> numbers, bool is_one_group, PacketOrder& all) {
  const auto first = static_cast<std::uint32_t>(all.numbers.size()), packets = static_cast<std::uint32_t>(all.ends.size());
  for (const std::uint32_t n : some.numbers) all.numbers.push_back(numbers[n]);
  for (const std::uint32_t end : some.ends) all.ends.push_back(first + end);
  if (is_one_group) return all.group_ends.push_back(static_cast<std::uint32_t>(all.ends.size()));
  for (const std::uint32_t end : some.group_ends) all.group_ends.push_back(packets + end);
}

void append_packets(std::span<const Receiver> receivers, std::span<const std::uint32_t> numbers, const std::stop_token& stop,
                    PacketOrder& all) {
  std::vector<Receiver> some;
  for (const std::uint32_t n : numbers) some.push_back(receivers[n]);
  const PacketOrder order = packet_order(some, stop);
  append(order, numbers, order.ends.size() <= packets_in_group, all);
}

/// Whether a receiver of a packet has a gap below an overhang, by lanes.
std::uint32_t lanes_with_gaps(const SkyProfile& profile) {
  std::uint32_t bits = 0;
  for (const PacketHorizon::Row& share : profile.gap_share)
    for (std::size_t l = 0; l < packet_lanes; ++l) bits |= share[l] > 0.0F ? 1U << l : 0U;
  return bits;
}

struct InSquare {
  std::int32_t row, column;
  std::uint32_t number;
};

}  // namespace

PacketOrder order_on_pixels(const CanopyLattice& lattice, const Grid& grid, Cell cell, std::span<const Receiver> receivers,
                            const std::stop_token& stop) {
  std::vector<InSquare> found;
  std::vector<std::uint32_t> others;
  for (std::uint32_t n = 0; n < receivers.size(); ++n) {
    const std::optional<CanopyLattice::Place> place = lattice.centre_at(grid, cell, receivers[n].p_cell);
    if (place)
      found.push_back({square_of(place->row), square_of(place->column), n});
    else
      others.push_back(n);
  }
  std::ranges::stable_sort(found, {}, [](const InSquare& r) { return std::tuple(r.row, r.column); });
  PacketOrder order;
  std::vector<std::uint32_t> of_square;
  for (std::size_t n = 0; n < found.size(); ++n) {
    of_square.push_back(found[n].number);
    if (n + 1 < found.size() && found[n].row == found[n + 1].row && found[n].column == found[n + 1].column) continue;
    append_packets(receivers, of_square, stop, order);
    of_square.clear();
  }
  if (!others.empty()) append_packets(receivers, others, stop, order);
  return order;
}

void CanopyOnPixels::find_on_pixels(std::span<const SkyProfile> profiles, std::span<const ReceiverPacket> packets) {
  found_.clear();
  for (std::uint32_t n = 0; n < packets.size(); ++n) {
    const std::uint32_t with_gaps = lanes_with_gaps(profiles[n]);
    for (std::uint32_t l = 0; l < packets[n].count; ++l) {
      if (has_bit(with_gaps, l) || !packets[n].looks_straight_up(l)) continue;
      const Point3f p{packets[n].x[l], packets[n].y[l], packets[n].z[l]};
      const std::optional<CanopyLattice::Place> place = city_.lattice.centre_at(city_.manifest.grid, cell_, p);
      const std::optional<CanopyLattice::Place> pixel = place ? city_.field.in_field(*place) : std::nullopt;
      if (pixel) found_.push_back({*pixel, n, l});
    }
  }
  std::ranges::sort(found_, {}, [](const OnPixel& r) { return std::tuple(r.place.row, r.place.column, r.packet, r.lane); });
}

std::size_t CanopyOnPixels::add_row(std::size_t first, std::span<const SkyProfile> profiles,
                                    std::span<const ReceiverPacket> packets, const Answers& answers) {
  // Rows begin at multiples of their length
  const CanopyLattice::Place place{square_of(found_[first].place.column) * square_edge, found_[first].place.row};
  if (rows_.size() <= marched_.size()) rows_.resize(marched_.size() + 1);
  Row& row = rows_[marched_.size()];
  CanopyRow& marched = marched_.emplace_back();
  marched.column = place.column;
  marched.row = place.row;
  std::ranges::fill(marched.z_m, CanopyRow::no_receiver_m);
  // A pixel is one of a row once
  row.receivers = {};
  for (std::size_t end = first; end < found_.size(); ++end) {
    const OnPixel& r = found_[end];
    const bool is_of_row = r.place.row == place.row && r.place.column < place.column + square_edge;
    if (!is_of_row || (end > first && r.place.column == found_[end - 1].place.column)) break;
    marched.z_m[r.place.column - place.column] = packets[r.packet].z[r.lane];
    row.receivers = std::span(found_).subspan(first, end + 1 - first);
  }
  make_ready(row, marched, profiles, answers);
  return first + row.receivers.size();
}

void CanopyOnPixels::make_ready(Row& row, CanopyRow& marched, std::span<const SkyProfile> profiles,
                                const Answers& answers) const {
  const std::size_t azimuths = city_.paths.paths().size();
  row.sky_from.resize(azimuths);
  row.sky.resize(profiles.front().sky.empty() ? 0 : azimuths);
  row.behind.resize(answers.behind_of_azimuths.empty() ? 0 : azimuths);
  row.hidden.resize(answers.hidden_of_azimuths.empty() ? 0 : azimuths);
  // Azimuth by azimuth: what neighbors have lies in the same lines of the processor's cache
  const auto copy = [&](SkyProfile::Rows SkyProfile::*of_profile, SkyProfile::Rows& rows) {
    struct Lane {
      const PacketHorizon::Row* from;
      std::size_t lane, pixel;
    };
    std::array<Lane, packet_lanes> lanes;
    std::size_t count = 0;
    for (const OnPixel& r : row.receivers)
      lanes[count++] = {(profiles[r.packet].*of_profile).data(), r.lane,
                        static_cast<std::size_t>(r.place.column - marched.column)};
    for (std::size_t k = 0; k < rows.size(); ++k)
      for (std::size_t n = 0; n < count; ++n) rows[k][lanes[n].pixel] = lanes[n].from[k][lanes[n].lane];
  };
  copy(&SkyProfile::sky_from, row.sky_from);
  copy(&SkyProfile::sky, row.sky);
}

void CanopyOnPixels::march_rows(const Answers& answers) {
  const auto first_of = [](std::vector<PacketHorizon::Row>& rows) { return rows.empty() ? nullptr : rows.front().data(); };
  keepers_.clear();
  keepers_.reserve(marched_.size());
  for (std::size_t n = 0; n < marched_.size(); ++n) {
    rows_[n].dimmed.clear();
    keepers_.push_back({rows_[n].dimmed, 1.0F, all_pixels});
    marched_[n].dimmed = answers.dimmed.empty() ? DimmedTaker() : keepers_[n].taker();
    marched_[n].sky_from = first_of(rows_[n].sky_from);
    marched_[n].sky = first_of(rows_[n].sky);
    marched_[n].behind = first_of(rows_[n].behind);
    marched_[n].hidden = first_of(rows_[n].hidden);
    marched_[n].sum_behind = rows_[n].sum_behind.data();
    marched_[n].sum_hidden = rows_[n].sum_hidden.data();
  }
  room_.resize(2 * (city_.paths.most_crossings() + 2));
  kernels_.march(city_.field.view(), city_.paths.paths(), marched_, room_.front().data());
  for (std::size_t n = 0; n < marched_.size(); ++n) store(rows_[n], marched_[n].column, answers);
  marched_.clear();
}

void CanopyOnPixels::store(const Row& row, std::int32_t first_column, const Answers& answers) const {
  const std::size_t azimuths = city_.paths.paths().size();
  std::array<const OnPixel*, packet_lanes> above{};
  for (const OnPixel& receiver : row.receivers) {
    const auto& [place, packet, lane] = receiver;
    const auto pixel = static_cast<std::size_t>(place.column - first_column);
    above[pixel] = &receiver;
    answers.behind[packet][lane] = row.sum_behind[pixel];
    if (city_.field.knows_solids()) answers.hidden[packet][lane] = row.sum_hidden[pixel];
    for (std::size_t k = 0; k < row.behind.size(); ++k)
      answers.behind_of_azimuths[packet * azimuths + k][lane] = row.behind[k][pixel];
    for (std::size_t k = 0; k < row.hidden.size(); ++k)
      answers.hidden_of_azimuths[packet * azimuths + k][lane] = row.hidden[k][pixel];
  }
  for (DimmedSlopes slopes : row.dimmed)
    if (const OnPixel* const receiver = above[slopes.lane]) {
      slopes.lane = receiver->lane;
      answers.dimmed[receiver->packet].push_back(slopes);
    }
}

void CanopyOnPixels::evaluate(std::span<const SkyProfile> profiles, std::span<const ReceiverPacket> packets,
                              const Answers& answers, std::span<std::uint32_t> answered) {
  FARLOD_EXPECTS(profiles.size() == packets.size() && answered.size() == packets.size());
  find_on_pixels(profiles, packets);
  std::ranges::fill(answered, 0U);
  for (DimmedSky& dimmed : answers.dimmed) dimmed.clear();
  for (const OnPixel& r : found_) answered[r.packet] |= 1U << r.lane;
  for (std::size_t n = 0; n < found_.size();) {
    n = add_row(n, profiles, packets, answers);
    if (marched_.size() == most_canopy_rows || n == found_.size()) march_rows(answers);
  }
}

}  // namespace farlod
