// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "results/picture/sky_picture.hpp"

namespace farlod {

/// From pale to dark red with the direct irradiance on a plane that faces the sun; pale at nothing, dark from 1,000 W/m² on.
[[nodiscard]] Colour colour_of_sun(double direct_w_m2);

/// Draws where the sun stands in a period over a picture of the sky: dots in these colours where it is seen, small grey ones
/// where something hides it.
void add_suns(Drawing& drawing, const Hemisphere& hemisphere, SkyProjection projection, const LightOfSky& light);

/// What the dots mean, and the lines of text of the light.
void add_light_legend(Drawing& drawing, PagePoint upper_left, const LightOfSky& light);

}  // namespace farlod
