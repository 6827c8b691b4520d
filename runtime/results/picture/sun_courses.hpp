// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "results/picture/sky_picture.hpp"

namespace farlod {

/// Draws the ways of the sun over a picture of the sky, with a dot at each full hour and its number where there is room. Where
/// geometry hides the sun, the line is pale and dashed, and the dots are hollow.
void add_sun_courses(Drawing& drawing, const Hemisphere& hemisphere, SkyProjection projection, const SunOfSky& sun);

/// Which line is which day, and the lines of text of the sun.
void add_sun_legend(Drawing& drawing, PagePoint upper_left, const SunOfSky& sun);

}  // namespace farlod
