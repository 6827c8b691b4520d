// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "weather/solar_radiation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace farlod {
namespace {

using namespace std::chrono;

constexpr double printed_digits = 1e-6;  // of the published numbers

/// A row of the tests of pvlib-python 0.11 (tests/test_clearsky.py, test_ineichen_*), whose implementation of Ineichen and Perez
/// 2002 is the one that others compare with. Its extraterrestrial irradiance is 1,364 W/m² but where a row says another.
struct DocumentedSky {
  double zenith_deg, air_mass, linke_turbidity, height_m, extraterrestrial;
  double global, direct, diffuse;
};

constexpr DocumentedSky documented_skies[] = {
    {10, 1, 3, 0, 1364, 1038.159219, 942.2081860378, 110.2652929361},
    {10, 1, 3, 0, 1370, 1042.72590228, 946.35279683, 110.75033088},
    {10, 1, 3, 2000, 1364, 1134.24312405, 994.95377835, 154.40492924},
    {124.0390863, 1, 3, 0, 1364, 0, 0, 0},
    {82.85457044, 6.97935524, 3, 0, 1364, 65.49426624, 321.16092181, 25.54562017},
    {46.0467599, 1.32355476, 3, 0, 1364, 704.6968125, 888.90147035, 87.73601277},
    {10.56413562, 0.93527685, 3, 0, 1364, 1044.1230677, 953.24925854, 107.03109696},
    {34.86074109, 1.12008114, 3, 0, 1364, 853.02065704, 922.06124712, 96.42909484},
    {72.41687122, 3.01614096, 3, 0, 1364, 251.99427693, 655.44925241, 53.9901349},
    {0, 1, 2, 0, 1364, 1095.77074798, 1014.38807396, 81.38267402},
    {80, 10, 4, 0, 1364, 43.72365587, 75.80970012, 30.5594396},
};

TEST(ClearSky, IsThatWhichPvlibDocuments) {
  for (const DocumentedSky& documented : documented_skies) {
    const ClearSky sky =
        clear_sky(Angle::degrees(90.0 - documented.zenith_deg),
                  {documented.air_mass, documented.linke_turbidity, documented.height_m}, documented.extraterrestrial);
    EXPECT_NEAR(sky.global_w_m2, documented.global, printed_digits) << documented.zenith_deg;
    EXPECT_NEAR(sky.direct_normal_w_m2, documented.direct, printed_digits) << documented.zenith_deg;
    EXPECT_NEAR(sky.diffuse_w_m2, documented.diffuse, printed_digits) << documented.zenith_deg;
  }
}

TEST(AirMass, IsThatOfTheTableOfKastenAndYoung) {
  // F. Kasten and A. T. Young, Applied Optics 28 (1989) 4735, table II, from which the formula differs by half a percent at most
  EXPECT_NEAR(relative_air_mass(Angle::degrees(90)), 1.0, 0.001);
  EXPECT_NEAR(relative_air_mass(Angle::degrees(30)), 1.9939, 0.001);
  EXPECT_NEAR(relative_air_mass(Angle::degrees(10)), 5.5841, 0.005);
  EXPECT_NEAR(relative_air_mass(Angle::degrees(0)), 38.0868, 0.005 * 38.0868);
  EXPECT_EQ(relative_air_mass(Angle::degrees(-5)), relative_air_mass(Angle::degrees(0)));
}

TEST(ExtraterrestrialIrradiance, IsLargestInJanuary) {
  // What almanacs say: .98330 au at the perihelion of 2026, on 3 January, and 1.01664 au at the aphelion, on 6 July
  constexpr double relative_error = 2e-4;
  const double perihelion = 1361.0 / (0.98330 * 0.98330), aphelion = 1361.0 / (1.01664 * 1.01664);
  EXPECT_NEAR(extraterrestrial_w_m2(sys_days{year{2026} / January / 3}), perihelion, relative_error * perihelion);
  EXPECT_NEAR(extraterrestrial_w_m2(sys_days{year{2026} / July / 6}), aphelion, relative_error * aphelion);
}

TEST(StandardAtmosphere, HasThePressureOfTheTables) {
  // U.S. Standard Atmosphere 1976, table I
  EXPECT_NEAR(standard_pressure_hpa(0), 1013.25, 0.01);
  EXPECT_NEAR(standard_pressure_hpa(1000), 898.76, 0.1);
  EXPECT_NEAR(standard_pressure_hpa(3000), 701.21, 0.2);
}

TEST(DewPoint, IsTheTemperatureOfAirThatIsFull) {
  EXPECT_NEAR(dew_point_c(20, 100), 20.0, 1e-9);
  EXPECT_NEAR(dew_point_c(20, 50), 9.26, 0.05);  // psychrometric tables
  EXPECT_NEAR(dew_point_c(15, 60), 7.3, 0.05);   // what is usual
}

TEST(DiffuseShare, IsContinuousAndThatOfErbs) {
  EXPECT_EQ(diffuse_share(0.0), 1.0);
  EXPECT_NEAR(diffuse_share(0.1), 0.991, 1e-12);
  // D. G. Erbs, S. A. Klein and J. A. Duffie, Solar Energy 28 (1982) 293: the pieces meet to three digits
  EXPECT_NEAR(diffuse_share(0.22), diffuse_share(0.22 + 1e-9), 2e-3);
  EXPECT_NEAR(diffuse_share(0.8), diffuse_share(0.8 + 1e-9), 2e-3);
  EXPECT_NEAR(diffuse_share(0.5), 0.9511 - 0.0802 + 1.097 - 2.07975 + 0.771, 1e-12);
}

TEST(MeanSineOfTheSun, IsItsIntegral) {
  // At the equator at an equinox the sun goes through the zenith: the sine is the cosine of the hour angle. The mean of a day
  // from midnight to midnight is 1/π, that of the hour after sunrise (1 − cos 15°) / 15° = .1301; refraction adds to the second.
  const PlaceOnEarth equator{Angle::degrees(0), Angle::degrees(0)};
  const sys_time<milliseconds> day = sys_days{year{2026} / March / 20};
  const milliseconds noon = hours(12) + minutes(7) + seconds(30);  // by the equation of time
  double sum = 0.0;
  for (int hour = 0; hour < 24; ++hour) sum += mean_sine_of_sun(equator, day + noon + hours(hour) - minutes(690), hours(1));
  EXPECT_NEAR(sum / 24.0, 1.0 / std::numbers::pi, 1e-3);
  const double first_hour = mean_sine_of_sun(equator, day + noon - minutes(330), hours(1));
  EXPECT_NEAR(first_hour, (1.0 - std::cos(std::numbers::pi / 12)) / (std::numbers::pi / 12), 0.003);
  EXPECT_EQ(mean_sine_of_sun(equator, day, hours(1)), 0.0);
}

}  // namespace
}  // namespace farlod
