// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "evaluate/error_budget.hpp"

#include <cmath>

#include "base/expects.hpp"

namespace farlod {
namespace {

constexpr double reserve = 1.25;
/// Strata of equal share, each with one ray: between random rays (−1/2) and a smooth integrand (−1).
constexpr double decline = -0.75;

}  // namespace

double sampling_error(std::size_t rays) {
  FARLOD_EXPECTS(rays > 0);
  return reserve * sampling_error_factor * std::pow(static_cast<double>(rays), decline);
}

std::size_t rays_for_sampling_error(double error) {
  FARLOD_EXPECTS(error > 0.0);
  return static_cast<std::size_t>(std::ceil(std::pow(error / (reserve * sampling_error_factor), 1.0 / decline)));
}

double azimuth_error(std::size_t azimuths) {
  FARLOD_EXPECTS(azimuths > 0);
  return reserve * azimuth_error_factor / static_cast<double>(azimuths);
}

std::size_t azimuths_for_error(double error) {
  FARLOD_EXPECTS(error > 0.0);
  return static_cast<std::size_t>(std::ceil(reserve * azimuth_error_factor / error));
}

}  // namespace farlod
