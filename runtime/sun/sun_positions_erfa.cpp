// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <erfa.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "base/expects.hpp"
#include "farlod/error.hpp"
#include "sun/sun_positions.hpp"

namespace farlod {
namespace {

constexpr double speed_of_light_au_per_day = 173.144632674, au_m = 149597870700.0;
constexpr int wgs84 = 1;

/// A Julian date in the two parts that ERFA takes.
struct JulianDate {
  double day = 0.0, part = 0.0;
};

struct Times {
  JulianDate terrestrial, universal;
};

Times times_of(std::chrono::sys_time<std::chrono::milliseconds> time_utc) {
  constexpr double epoch_1970 = 2440587.5, milliseconds_a_day = 86'400'000.0;
  if (time_utc < std::chrono::sys_days(std::chrono::year(1960) / 1 / 1))
    throw InvalidArgument("the sun's positions are known from 1960 on: give a later date");
  // UT1 is within a second of UTC, in which the sun moves by .004°: leap seconds keep it there
  Times times;
  times.universal = {epoch_1970, static_cast<double>(time_utc.time_since_epoch().count()) / milliseconds_a_day};
  JulianDate atomic;
  // Beyond the table of leap seconds, the last of them counts
  (void)eraUtctai(times.universal.day, times.universal.part, &atomic.day, &atomic.part);
  (void)eraTaitt(atomic.day, atomic.part, &times.terrestrial.day, &times.terrestrial.part);
  return times;
}

using Vector = std::array<double, 3>;

/// How the Earth's axis stands. It moves by a millionth of a radian a day, and takes longest to compute.
struct EarthAxis {
  double of_date_from_celestial[3][3];
  double equation_of_equinoxes = 0.0;

  explicit EarthAxis(const JulianDate& tt) : equation_of_equinoxes(eraEe00b(tt.day, tt.part)) {
    eraPnm00b(tt.day, tt.part, of_date_from_celestial);
  }
};

/// Where the Earth is, in au and au a day. It takes nine tenths of the time of a direction to compute.
struct EarthState {
  Vector from_sun{}, velocity_from_sun{};
  Vector velocity{};  ///< of the frame of all planets, which aberration counts
};

EarthState earth_at(const JulianDate& tt) {
  double heliocentric[2][3], barycentric[2][3];
  (void)eraEpv00(tt.day, tt.part, heliocentric, barycentric);
  EarthState earth;
  std::copy_n(heliocentric[0], 3, earth.from_sun.begin());
  std::copy_n(heliocentric[1], 3, earth.velocity_from_sun.begin());
  std::copy_n(barycentric[1], 3, earth.velocity.begin());
  return earth;
}

/// From the middle of the Earth to where the sun is seen, in au; frame of the true equator and equinox of date.
Vector seen_from_the_middle(const EarthState& earth, const EarthAxis& axis) {
  double sun[3];
  Vector from_sun = earth.from_sun;  // ERFA promises nothing of what it is given
  const double distance = eraPm(from_sun.data());
  for (std::size_t k = 0; k < 3; ++k)
    sun[k] = -earth.from_sun[k] + distance * earth.velocity[k] / speed_of_light_au_per_day;  // aberration
  Vector result{};
  EarthAxis own = axis;
  eraRxp(own.of_date_from_celestial, sun, result.data());
  return result;
}

/// The Earth within a day of TT, from its states at both ends: the cubic of Hermite for the place, whose error is the fourth
/// power of the way of a day (.017 rad) / 384, or 2·10⁻¹⁰; a line for the velocity, which is off by .017² / 8, or by .001″ of
/// aberration. The axis is that of the middle, half a day from which it is off by less than .2″.
class EarthOfDay {
 public:
  explicit EarthOfDay(std::chrono::sys_days day)
      : begin_tt_(times_of(day).terrestrial),
        end_tt_(times_of(day + std::chrono::days(1)).terrestrial),
        begin_(earth_at(begin_tt_)),
        end_(earth_at(end_tt_)),
        axis_(times_of(day + std::chrono::hours(12)).terrestrial) {}

  [[nodiscard]] const EarthAxis& axis() const { return axis_; }
  [[nodiscard]] EarthState at(const JulianDate& tt) const {
    const double length = days_between(begin_tt_, end_tt_), t = days_between(begin_tt_, tt) / length, u = 1.0 - t;
    EarthState earth;
    for (std::size_t k = 0; k < 3; ++k) {
      earth.from_sun[k] = u * u * ((1.0 + 2.0 * t) * begin_.from_sun[k] + t * length * begin_.velocity_from_sun[k]) +
                          t * t * ((1.0 + 2.0 * u) * end_.from_sun[k] - u * length * end_.velocity_from_sun[k]);
      earth.velocity[k] = u * begin_.velocity[k] + t * end_.velocity[k];
    }
    return earth;
  }

 private:
  static double days_between(const JulianDate& from, const JulianDate& to) { return (to.day - from.day) + (to.part - from.part); }

  JulianDate begin_tt_, end_tt_;
  EarthState begin_, end_;
  EarthAxis axis_;
};

/// The place, in the same frame and unit, where the Earth has turned by `sidereal`.
Vector place_in_space(const PlaceOnEarth& place, double sidereal) {
  Vector p{};
  const int status = eraGd2gc(wgs84, place.longitude.radians(), place.latitude.radians(), place.height_m, p.data());
  FARLOD_EXPECTS(status == 0);
  const double cosine = std::cos(sidereal), sine = std::sin(sidereal);
  return {(cosine * p[0] - sine * p[1]) / au_m, (sine * p[0] + cosine * p[1]) / au_m, p[2] / au_m};
}

/// T. Sæmundsson, Sky and Telescope 72 (1986) 70; pressure and temperature as in I. Reda and A. Andreas, NREL/TP-560-34302.
double refraction_deg(double elevation_deg, const Atmosphere& air) {
  constexpr double lowest_deg = -1.0;  // below, the sun is not seen, and the formula has a pole
  if (elevation_deg < lowest_deg) return 0.0;
  const double at = elevation_deg + 10.3 / (elevation_deg + 5.11);
  return air.pressure_hpa / 1010.0 * 283.0 / (273.0 + air.temperature_c) * 1.02 / (60.0 * tan(Angle::degrees(at)));
}

SunDirection direction_at(const PlaceOnEarth& place, const Times& times, const EarthState& earth, const EarthAxis& axis,
                          const Atmosphere& atmosphere) {
  const double sidereal = eraGmst00(times.universal.day, times.universal.part, times.terrestrial.day, times.terrestrial.part) +
                          axis.equation_of_equinoxes;
  Vector sun = seen_from_the_middle(earth, axis);
  const Vector observer = place_in_space(place, sidereal);
  for (std::size_t k = 0; k < 3; ++k) sun[k] -= observer[k];
  double right_ascension = 0.0, declination = 0.0, azimuth = 0.0, elevation = 0.0;
  eraC2s(sun.data(), &right_ascension, &declination);
  eraHd2ae(sidereal + place.longitude.radians() - right_ascension, declination, place.latitude.radians(), &azimuth, &elevation);
  const Angle geometric = Angle::radians(elevation);
  return {Angle::radians(azimuth), geometric + Angle::degrees(refraction_deg(geometric.degrees(), atmosphere))};
}

SunDirection direction_at(const PlaceOnEarth& place, const Times& times, const EarthAxis& axis, const Atmosphere& atmosphere) {
  return direction_at(place, times, earth_at(times.terrestrial), axis, atmosphere);
}

}  // namespace

SunDirection sun_direction(const PlaceOnEarth& place, std::chrono::sys_time<std::chrono::milliseconds> time_utc,
                           const Atmosphere& atmosphere) {
  const Times times = times_of(time_utc);
  return direction_at(place, times, EarthAxis(times.terrestrial), atmosphere);
}

std::vector<SunDirection> sun_directions(const PlaceOnEarth& place,
                                         std::span<const std::chrono::sys_time<std::chrono::milliseconds>> times_utc,
                                         const Atmosphere& atmosphere) {
  std::vector<SunDirection> directions;
  directions.reserve(times_utc.size());
  std::optional<EarthOfDay> earth;
  std::chrono::sys_days day_of_earth;
  for (const auto& time : times_utc) {
    const auto day = std::chrono::floor<std::chrono::days>(time);
    if (!earth || day != day_of_earth) earth.emplace(day);
    day_of_earth = day;
    const Times times = times_of(time);
    directions.push_back(direction_at(place, times, earth->at(times.terrestrial), earth->axis(), atmosphere));
  }
  return directions;
}

std::chrono::milliseconds local_mean_time_ahead(Angle longitude) {
  return std::chrono::milliseconds(static_cast<std::int64_t>(longitude.degrees() / 360.0 * 86'400'000.0));
}

std::vector<SunDirection> sun_course(const PlaceOnEarth& place, std::chrono::sys_days day) {
  const auto midnight = day - local_mean_time_ahead(place.longitude);
  const EarthAxis axis(times_of(midnight).terrestrial);
  std::vector<SunDirection> course;
  for (std::chrono::minutes m(0); m <= std::chrono::days(1); ++m)
    course.push_back(direction_at(place, times_of(midnight + m), axis, {}));
  return course;
}

std::vector<SunPosition> sun_positions(const PlaceOnEarth& place, std::chrono::sys_days first, std::size_t days,
                                       std::chrono::minutes step) {
  using std::chrono::milliseconds;
  FARLOD_EXPECTS(step.count() > 0);
  const std::chrono::sys_time<milliseconds> begin = first - local_mean_time_ahead(place.longitude),
                                            end = begin + std::chrono::days(static_cast<std::int64_t>(days));
  std::vector<SunPosition> positions;
  EarthAxis axis(times_of(begin).terrestrial);
  auto axis_until = begin + std::chrono::days(1);
  for (auto from = begin; from < end; from += step) {
    if (from >= axis_until) {
      axis = EarthAxis(times_of(from).terrestrial);
      axis_until = from + std::chrono::days(1);
    }
    const milliseconds length = std::min<milliseconds>(step, end - from);
    const SunDirection sun = direction_at(place, times_of(from + length / 2), axis, {});
    if (sun.elevation.radians() > 0.0)
      positions.push_back({sun.azimuth, sun.elevation, static_cast<double>(length.count()) / 3'600'000.0});
  }
  return positions;
}

}  // namespace farlod
