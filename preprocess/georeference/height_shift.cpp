// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "georeference/height_shift.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>
#include <vector>

#include "base/expects.hpp"
#include "georeference/resolved_source.hpp"

namespace farlod::georeference {
namespace {

/// Shifts at every n-th node of a terrain, and beyond its last ones; linear between them.
class ShiftNet {
 public:
  template <class ShiftAt>
  ShiftNet(const TerrainRaster& terrain, const ShiftAt& shift_at) {
    constexpr double most_m = 100.0;
    const auto every = [](double step_m) { return std::max<std::size_t>(static_cast<std::size_t>(most_m / step_m), 1); };
    columns_apart_ = every(terrain.step_m.x);
    rows_apart_ = every(terrain.step_m.y);
    columns_ = terrain.columns / columns_apart_ + 2;
    const std::size_t rows = terrain.rows / rows_apart_ + 2;
    for (std::size_t row = 0; row < rows; ++row)
      for (std::size_t column = 0; column < columns_; ++column)
        shift_m_.push_back(shift_at(terrain.node(column * columns_apart_, row * rows_apart_)));
  }

  [[nodiscard]] double at(std::size_t column, std::size_t row) const {
    const std::size_t c = column / columns_apart_, r = row / rows_apart_;
    const double s = static_cast<double>(column % columns_apart_) / static_cast<double>(columns_apart_),
                 t = static_cast<double>(row % rows_apart_) / static_cast<double>(rows_apart_);
    const double* const south = shift_m_.data() + r * columns_ + c;
    const double* const north = south + columns_;
    return (1.0 - t) * ((1.0 - s) * south[0] + s * south[1]) + t * ((1.0 - s) * north[0] + s * north[1]);
  }

 private:
  std::size_t columns_apart_ = 1, rows_apart_ = 1, columns_ = 0;
  std::vector<double> shift_m_;
};

}  // namespace

std::optional<HeightShift> height_shift_for(const std::string& source, const Crs& own, const std::string& heights_of_model,
                                            Point2d typical, Report& report) {
  if (heights_of_model.empty() || !own.heights_name()) return std::nullopt;
  const auto model = Crs::find(heights_of_model);
  FARLOD_EXPECTS(model.has_value() && model->heights_name().has_value());
  HeightShift shift(own, *model, typical);
  if (!shift.is_needed()) return std::nullopt;
  if (shift.is_known()) return shift;
  Problem problem{ProblemCode::another_datum, source, "the whole file",
                  shift.reason() + ": they are taken as they are; --terrain-offset shifts a terrain",
                  Point3d{typical.x, typical.y, 0.0}};
  ProblemLocator(own, FileAxes{}, typical).locate(problem);
  report.add(std::move(problem));
  return std::nullopt;
}

std::string note_of_shift(const std::string& source, const Crs& own, const std::string& heights_of_model, double shift_m) {
  const auto model = Crs::find(heights_of_model);
  FARLOD_EXPECTS(model.has_value() && model->heights_name().has_value());
  std::ostringstream text;
  text.precision(2);
  text << source << ": its heights were brought from " << *own.heights_name() << " to " << *model->heights_name() << ": "
       << std::showpos << std::fixed << shift_m << " m";
  return std::move(text).str();
}

std::optional<std::string> note_of_height_unit(const std::string& source, const Crs& own, const std::string& way_to_metres) {
  constexpr double like_the_same = 1e-9;
  const double unit_m = own.height_unit_m();
  if (own.says_height_unit() || unit_m == 1.0) return std::nullopt;
  const auto is = [unit_m](const LengthUnit& unit) { return std::abs(unit_m / unit.metres - 1.0) < like_the_same; };
  std::ostringstream text;
  text.precision(9);
  text << source << ": its heights are taken for ";
  if (is(us_survey_foot))
    text << "US survey feet";
  else if (is(foot))
    text << "feet";
  else
    text << "units of " << unit_m << " m";
  text << ", the unit of " << own.name() << ", since nothing tells their own; where they are metres, " << way_to_metres;
  return std::move(text).str();
}

void shift_heights(ResolvedSource& resolved, std::vector<std::string>& notes, std::string& heights_of_model, Report& report) {
  const std::string& name = resolved.source.source;
  const auto shift = height_shift_for(name, resolved.crs, heights_of_model, resolved.typical, report);
  if (heights_of_model.empty() && resolved.crs.heights_name()) heights_of_model = resolved.crs.whole_wkt();
  if (!shift) return;
  const double typical_m = shift->at(resolved.typical).value_or(0.0);
  const auto move = [&](std::span<Point3d> points) {
    for (Point3d& p : points) p.z += shift->at(horizontal(p)).value_or(typical_m);
  };
  CityModel& city = resolved.source.city;
  city.for_each_building([&](std::size_t, const Building& b) {
    if (b.height_reference != HeightReference::on_ground) move(city.points_of(b));
  });
  move(resolved.source.relief_points);
  notes.push_back(note_of_shift(name, resolved.crs, heights_of_model, typical_m));
}

void shift_heights(TerrainRaster& terrain, const std::string& source, const Crs& own, const Georeference& georeference,
                   Report& report) {
  if (!own.heights_name() || georeference.heights_wkt.empty()) return;
  const auto output = Crs::find(georeference.crs_wkt);
  FARLOD_EXPECTS(output.has_value());
  const Point2d middle = terrain.node(terrain.columns / 2, terrain.rows / 2) + georeference.origin_m;
  const CrsTransformation to_own(*output, own, middle);
  const auto typical = to_own.apply(middle);
  if (!typical) return;
  const auto shift = height_shift_for(source, own, georeference.heights_wkt, *typical, report);
  if (!shift) return;
  const double typical_m = shift->at(*typical).value_or(0.0);
  const ShiftNet net(terrain, [&](Point2d p_city) {
    const auto p_own = to_own.apply(p_city + georeference.origin_m);
    return (p_own ? shift->at(*p_own) : std::nullopt).value_or(typical_m);
  });
  for (std::size_t row = 0; row < terrain.rows; ++row)
    for (std::size_t column = 0; column < terrain.columns; ++column)
      if (auto& height_m = terrain.height_m[row * terrain.columns + column]) *height_m += static_cast<float>(net.at(column, row));
  terrain.notes.push_back(note_of_shift(source, own, georeference.heights_wkt, typical_m));
}

}  // namespace farlod::georeference
