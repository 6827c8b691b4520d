// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "georeference/output_crs.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "farlod/error.hpp"
#include "georeference/input_crs.hpp"

namespace farlod::georeference {
namespace {

/// The largest scale error of the output CRS. UTM has less than 0.1 % in its zone, Lambert-93 less than 0.3 %. At 1 %, the height
/// of a wall over its distance is wrong by 1 %, and so is the sky view factor.
constexpr double greatest_scale_error = 0.01;

/// Empty when the city is not in the area of use: for the coordinates of a local site, the scale of the map has no meaning.
std::optional<double> scale_error_at(const Crs& crs, Point2d p) {
  const auto place = crs.lon_lat_deg(p);
  const auto area = crs.area_of_use();
  const auto distortion = crs.distortion_at(p);
  if (!place || !distortion || (area && !area->contains(*place))) return std::nullopt;
  return std::max(std::abs(distortion->least_scale - 1.0), std::abs(distortion->greatest_scale - 1.0));
}

bool has_true_metres(const Crs& crs, Point2d p) { return scale_error_at(crs, p).value_or(0.0) <= greatest_scale_error; }

Crs utm_around(const Crs& input, Point2d typical) {
  const auto place = input.lon_lat_deg(typical);
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

/// By GeographicLib for UTM, by PROJ for all other projections.
Angle convergence_at(const Crs& crs, Point2d p_projected) {
  if (const auto zone = crs.utm_zone()) return UtmProjection(*zone, crs.ellipsoid()).convergence_at(p_projected);
  const auto distortion = crs.distortion_at(p_projected);
  return distortion ? distortion->convergence : Angle();
}

}  // namespace

Crs choose_output_crs(const Crs& input, Point2d typical, const std::string& wish) {
  if (!wish.empty()) return wished_crs(input, typical, wish);
  if (!input.is_projected() || !input.runs_east_and_north() || !has_true_metres(input, typical))
    return utm_around(input, typical);
  return input.unit() == 1.0 ? input : input.counted_in(metre);
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

}  // namespace farlod::georeference
