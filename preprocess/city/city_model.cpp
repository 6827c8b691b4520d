// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "city/city_model.hpp"

#include <algorithm>
#include <utility>

namespace farlod {

std::span<const Point3d> CityModel::points_of(const Building& b) const {
  if (b.facet_count == 0) return {};
  const Facet& first = facets_[b.first_facet];
  const Facet& last = facets_[b.first_facet + b.facet_count - 1];
  const std::uint64_t begin = ring_begin(first.first_ring);
  const std::uint64_t end = ring_begin(last.first_ring + last.ring_count);
  return std::span(points_).subspan(begin, end - begin);
}

void CityModel::begin_building(std::string id, HeightReference height_reference, std::uint32_t source, Foot foot) {
  buildings_.push_back({std::move(id), facets_.size(), 0, height_reference, foot, source, origins_.size()});
}

void CityModel::begin_facet(SurfaceKind kind, std::uint32_t surface, std::uint16_t part) {
  FARLOD_EXPECTS(!buildings_.empty());
  facets_.push_back({ring_end_.size(), 0, surface, part, kind});
  ++buildings_.back().facet_count;
}

void CityModel::add_ring(std::span<const Point3d> points) {
  FARLOD_EXPECTS(!facets_.empty());
  points_.append(points);
  ring_end_.push_back(points_.size());
  ++facets_.back().ring_count;
}

void CityModel::set_origin(std::span<const std::uint8_t> origin) {
  FARLOD_EXPECTS(!buildings_.empty() && buildings_.back().origin_bytes == 0);
  origins_.append(origin);
  buildings_.back().origin_bytes = origin.size();
}

void CityModel::drop_last_building() {
  FARLOD_EXPECTS(!buildings_.empty());
  const Building& b = buildings_.back();
  origins_.resize(b.first_origin_byte);
  if (b.facet_count > 0) {
    const std::uint64_t ring = facets_[b.first_facet].first_ring;
    points_.resize(ring_begin(ring));
    ring_end_.resize(ring);
    facets_.resize(b.first_facet);
  }
  buildings_.pop_back();
}

void CityModel::drop_facets(const std::vector<bool>& is_dropped) {
  FARLOD_EXPECTS(is_dropped.size() == facets_.size());
  if (std::find(is_dropped.begin(), is_dropped.end(), true) == is_dropped.end()) return;
  CityModel kept;
  for (const Building& b : buildings_) {
    kept.begin_building(b.id, b.height_reference, b.source, b.foot);
    kept.set_origin(origin_of(b));
    for (std::uint64_t n = b.first_facet; n < b.first_facet + b.facet_count; ++n) {
      if (is_dropped[n]) continue;
      const Facet& f = facets_[n];
      kept.begin_facet(f.kind, f.surface, f.part);
      for (std::uint32_t k = 0; k < f.ring_count; ++k) kept.add_ring(ring(f, k));
    }
    if (kept.buildings_.back().facet_count == 0) kept.drop_last_building();
  }
  *this = std::move(kept);
}

std::span<Point3d> CityModel::points_of(const Building& b) {
  const auto points = std::as_const(*this).points_of(b);
  if (points.empty()) return {};
  return std::span(points_).subspan(static_cast<std::size_t>(points.data() - points_.data()), points.size());
}

void CityModel::set_source(std::uint32_t source) {
  for (Building& b : buildings_) b.source = source;
}

void CityModel::append(CityModel&& other) {
  if (buildings_.empty()) {
    *this = std::move(other);
    return;
  }
  const std::uint64_t facet_shift = facets_.size();
  const std::uint64_t ring_shift = ring_end_.size();
  const std::uint64_t point_shift = points_.size();
  const std::uint64_t origin_shift = origins_.size();
  for (Building& b : other.buildings_) {
    b.first_facet += facet_shift;
    b.first_origin_byte += origin_shift;
    buildings_.push_back(std::move(b));
  }
  for (Facet f : other.facets_) {
    f.first_ring += ring_shift;
    facets_.push_back(f);
  }
  for (const std::uint64_t end : other.ring_end_) ring_end_.push_back(end + point_shift);
  points_.append(other.points_);
  origins_.append(other.origins_);
}

void CityModel::let_go_before(std::size_t building) const {
  const bool is_end = building >= buildings_.size();
  const std::uint64_t facet = is_end ? facets_.size() : buildings_[building].first_facet;
  const std::uint64_t ring = facet < facets_.size() ? facets_[facet].first_ring : ring_end_.size();
  const std::uint64_t point = ring_begin(ring);
  facets_.let_go(0, facet);
  ring_end_.let_go(0, ring);
  points_.let_go(0, point);
  origins_.let_go(0, is_end ? origins_.size() : buildings_[building].first_origin_byte);
}

std::optional<double> TerrainRaster::height_at(Point2d p_city) const {
  if (columns < 2 || rows < 2) return std::nullopt;
  const double u = (p_city.x - first.x) / step_m.x;
  const double v = (p_city.y - first.y) / step_m.y;
  if (!(u >= 0.0 && v >= 0.0 && u <= static_cast<double>(columns - 1) && v <= static_cast<double>(rows - 1))) return std::nullopt;
  const std::size_t column = std::min(static_cast<std::size_t>(u), columns - 2);
  const std::size_t row = std::min(static_cast<std::size_t>(v), rows - 2);
  const auto* south = &height_m[row * columns + column];
  const auto* north = south + columns;
  if (!south[0] || !south[1] || !north[0] || !north[1]) return std::nullopt;
  const double s = u - static_cast<double>(column), t = v - static_cast<double>(row);
  return (1.0 - t) * ((1.0 - s) * *south[0] + s * *south[1]) + t * ((1.0 - s) * *north[0] + s * *north[1]);
}

}  // namespace farlod
