// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/picture/value_scale.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/lower_case.hpp"

namespace farlod {
namespace {

/// Divisions may miss a whole number by it.
constexpr double division_error = 1e-9;

struct BandTitle {
  const char *band, *title;
};

/// Other bands are called by their names alone.
constexpr std::array<BandTitle, 17> titles{{{"svf", "Sky view factor"},
                                            {"svf_solid", "Solid angle share of the sky"},
                                            {"svf_total", "Sky view factor with trees"},
                                            {"sunlit_h", "Sunshine, were the sky clear"},
                                            {"sunlit_total_h", "Sunshine with trees, were the sky clear"},
                                            {"irradiation", "Irradiation"},
                                            {"irradiance", "Mean irradiance"},
                                            {"illuminance", "Mean illuminance"},
                                            {"shade", "Share of the hours of sun in shade"},
                                            {"sky_component", "Sky component"},
                                            {"hidden_near", "Sky hidden by what is near"},
                                            {"hidden_far", "Sky hidden by what is far alone"},
                                            {"share_sky", "Share of the view that is sky"},
                                            {"share_vegetation", "Share of the view that is trees"},
                                            {"share_building", "Share of the view that is solid"},
                                            {"view_building", "Share of the view that the building fills"},
                                            {"sees_building", "Where anything of the building is seen"}}};

struct UnitSigns {
  const char *unit, *sign, *words;  ///< `unit` in the words of UDUNITS
};

constexpr std::array<UnitSigns, 6> units{{{"h", "h", "Hours"},
                                          {"degree", "°", "Degrees"},
                                          {"m", "m", "Metres"},
                                          {"kW h m-2", "kWh/m²", "In kWh/m²"},
                                          {"W m-2", "W/m²", "In W/m²"},
                                          {"lx", "lx", "In lx"}}};

/// A name that says no more than the title is left out: "Irradiation", "Sky component".
std::string title_of(const std::string& band) {
  const auto* const found = std::ranges::find(titles, band, &BandTitle::band);
  if (found == titles.end()) return band;
  const std::string title = found->title;
  std::string words = band;
  std::ranges::replace(words, '_', ' ');
  return lower_case(title) == words ? title : title + " (" + band + ")";
}

double two_digits_of(double value) {
  const double digit = std::pow(10.0, std::floor(std::log10(value)) - 1.0);
  return std::ceil(value / digit - division_error) * digit;
}

}  // namespace

double tick_step(double length, int most_steps) {
  const double least = length / most_steps * (1.0 - division_error);
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  for (const double digit : {1.0, 2.0, 5.0})
    if (digit * power >= least) return digit * power;
  return 10.0 * power;
}

std::string tick_text(double value, double step) {
  const int decimals = static_cast<int>(std::max(0.0, -std::floor(std::log10(step) + division_error)));
  return fmt::format("{:.{}f}", value, decimals);
}

std::vector<double> ValueScale::ticks() const {
  std::vector<double> ticks;
  for (int n = 0; n * step() <= end * (1.0 + division_error); ++n) ticks.push_back(n * step());
  return ticks;
}

std::string sign_of_unit(const std::string& unit) {
  const auto* const found = std::ranges::find(units, unit, &UnitSigns::unit);
  return found == units.end() ? "" : found->sign;
}

ValueScale scale_of(const Band& band, double max_value) {
  ValueScale scale{title_of(band.name), "", "", 1.0, band.name.starts_with("shade")};
  const auto* const found = std::ranges::find(units, band.unit, &UnitSigns::unit);
  if (found != units.end()) {
    scale.subtitle = found->words;
    scale.unit = found->sign;
  } else {
    const bool is_of_sky = band.name == "svf" || band.name == "svf_solid" || band.name == "svf_total";
    scale.subtitle = is_of_sky ? "No unit: 0 hidden, 1 open sky" : "No unit";
  }
  // One building fills little of most views
  const bool is_share_of_all = band.unit == "1" && band.name != "view_building";
  if (!is_share_of_all && max_value > 0.0) scale.end = two_digits_of(max_value);
  return scale;
}

}  // namespace farlod
