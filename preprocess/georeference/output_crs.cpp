// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "georeference/output_crs.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "city/input_error.hpp"
#include "farlod/expects.hpp"
#include "georeference/crs_definition.hpp"

namespace farlod {
namespace {

/// How far a metre of the output CRS may be from a metre. UTM stays below 0.1 % in its zone, Lambert-93 below 0.3 %; at 1 % a
/// wall's height over its distance, and with it the sky view factor, would be wrong by as much.
constexpr double greatest_scale_error = 0.01;

std::optional<NamedCrs> find_crs(const std::string& definition) {
  const auto parsed = parse_crs_definition(definition);
  if (!parsed) return std::nullopt;
  const auto crs = Crs::find(parsed->for_proj);
  return crs ? std::optional(NamedCrs{*crs, parsed->longitude_first}) : std::nullopt;
}

/// Where a point is on the Earth, as far as anyone knows; shifts between datums do not matter here.
std::optional<Point2d> lon_lat_deg(const Crs& crs, Point2d p) {
  const auto world = Crs::find("EPSG:4326");
  FARLOD_EXPECTS(world.has_value());
  return CrsTransformation(crs, *world, p).apply(p);
}

/// Empty when the city is not where the CRS is meant for: coordinates of a local site say nothing about a map's scale.
std::optional<double> scale_error_at(const Crs& crs, Point2d p) {
  const auto place = lon_lat_deg(crs, p);
  const auto area = crs.area_of_use();
  const auto distortion = crs.distortion_at(p);
  if (!place || !distortion || (area && !area->contains(*place))) return std::nullopt;
  return std::max(std::abs(distortion->least_scale - 1.0), std::abs(distortion->greatest_scale - 1.0));
}

bool has_true_metres(const Crs& crs, Point2d p) { return scale_error_at(crs, p).value_or(0.0) <= greatest_scale_error; }

Crs utm_around(const Crs& input, Point2d typical) {
  const auto place = lon_lat_deg(input, typical);
  if (!place)
    throw InputError(input.name() + ": the city at " + std::to_string(typical.x) + ", " + std::to_string(typical.y) +
                     " has no place on the Earth: check the input's CRS, or choose the output's with --out-crs EPSG:n");
  const Crs base = input.geographic();
  return (base.is_in_degrees_from_greenwich() ? base : *Crs::find("EPSG:4326")).utm(utm_zone_of(*place));
}

Crs wished_crs(const Crs& input, Point2d typical, const std::string& wish) {
  const auto found = find_crs(wish);
  const std::string name = "--out-crs " + wish;
  if (!found) throw InputError(name + ": no such CRS is known: give EPSG:n");
  const Crs& crs = found->crs;
  if (!crs.is_projected() || crs.unit() != 1.0 || !crs.runs_east_and_north())
    throw InputError(name + " (" + crs.name() +
                     ") is not projected in metres to the east and north: give one that is, such as UTM");
  const auto p = CrsTransformation(input, crs, typical).apply(typical);
  if (!p) throw InputError(name + " (" + crs.name() + ") has no place for the city: give one that is meant for its region");
  if (!has_true_metres(crs, *p))
    throw InputError(name + " (" + crs.name() +
                     "): at the city its metres are off by more than 1 %: give a local one, such as UTM");
  return crs;
}

/// GeographicLib where the projection is UTM, PROJ for all others.
Angle convergence_at(const Crs& crs, Point2d p_projected) {
  if (const auto zone = crs.utm_zone()) return UtmProjection(*zone, crs.ellipsoid()).convergence_at(p_projected);
  const auto distortion = crs.distortion_at(p_projected);
  return distortion ? distortion->convergence : Angle();
}

}  // namespace

NamedCrs crs_of_input(const std::string& file, const std::string& definition, const std::string& fallback) {
  if (auto own = find_crs(definition)) return *own;
  const std::string named = definition.size() > 80 ? definition.substr(0, 80) + "..." : definition;
  if (fallback.empty() && definition.empty()) throw InputError(file + " does not say its CRS: give --crs EPSG:n");
  if (fallback.empty()) throw InputError(file + " names a CRS that is not known, \"" + named + "\": give --crs EPSG:n");
  if (auto given = find_crs(fallback)) return *given;
  throw InputError("--crs " + fallback + ", for " + file + ": no such CRS is known: give EPSG:n");
}

Crs choose_output_crs(const Crs& input, Point2d typical, const std::string& wish) {
  if (!wish.empty()) return wished_crs(input, typical, wish);
  if (!input.is_projected() || !input.runs_east_and_north() || !has_true_metres(input, typical))
    return utm_around(input, typical);
  return input.unit() == 1.0 ? input : input.in_metres();
}

Georeference georeference_around(Point2d centre, const Crs& output) {
  Georeference g;
  g.crs_wkt = output.wkt();
  g.epsg = output.epsg();
  g.crs_name = output.name();
  g.origin_m = {std::round(centre.x), std::round(centre.y)};
  g.convergence = convergence_at(output, g.origin_m);
  return g;
}

}  // namespace farlod
