// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "app/sun_of_package.hpp"

#include <fmt/core.h>

#include <chrono>
#include <cstdlib>
#include <string>
#include <utility>

#include "farlod/error.hpp"
#include "sun/sun_positions.hpp"
#ifdef FARLOD_WITH_GDAL
#include "results/gdal_files.hpp"
#endif

namespace farlod {

PlaceOnEarth place_of_package(const PackageDescription& package) {
#ifdef FARLOD_WITH_GDAL
  const Point2d middle = 0.5 * (package.outline_projected.low + package.outline_projected.high);
  const Point2d degrees = gdal_files().reprojected({&middle, 1}, package.crs_wkt, "EPSG:4326").front();
  return {Angle::degrees(degrees.x), Angle::degrees(degrees.y)};
#else
  throw InputError("The sun needs GDAL, which this farlod-svf was built without, to find out where on the Earth " +
                   package.crs_name + " lies: build it with FARLOD_WITH_GDAL.");
#endif
}

namespace {

std::string name_of(std::chrono::year_month_day day) {
  return fmt::format("{:04}-{:02}-{:02}", static_cast<int>(day.year()), static_cast<unsigned>(day.month()),
                     static_cast<unsigned>(day.day()));
}

/// Such as "UTC+09:18".
std::string clock_of(Angle longitude) {
  const auto ahead = std::chrono::round<std::chrono::minutes>(local_mean_time_ahead(longitude)).count();
  return fmt::format("UTC{}{:02}:{:02}", ahead < 0 ? "−" : "+", std::abs(ahead) / 60, std::abs(ahead) % 60);
}

std::vector<std::chrono::year_month_day> days_to_draw(const SunPeriod& period) {
  const std::chrono::year_month_day first(period.first);
  if (period.days == 1) return {first};
  using std::chrono::June, std::chrono::March, std::chrono::December;
  return {first.year() / June / 21, first.year() / March / 21, first.year() / December / 21};
}

}  // namespace

std::vector<SunPosition> sun_of_package(const PackageDescription& package, const SunPeriod& period) {
  return sun_positions(place_of_package(package), period.first, period.days, period.step);
}

SunOfSky sun_courses_of_package(const PackageDescription& package, const SunPeriod& period) {
  const PlaceOnEarth middle = place_of_package(package);
  SunOfSky sun{{}, {"Local mean time", "(" + clock_of(middle.longitude) + ")"}};
  for (const std::chrono::year_month_day day : days_to_draw(period)) {
    SunCourse course{name_of(day), {}};
    for (const SunDirection& d : sun_course(middle, day))
      course.minutes.push_back({d.azimuth.degrees(), 90.0 - d.elevation.degrees()});
    sun.courses.push_back(std::move(course));
  }
  return sun;
}

}  // namespace farlod
