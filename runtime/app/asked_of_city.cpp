// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "app/asked_of_city.hpp"

#include <string>

#include "app/written_run.hpp"
#include "farlod/raster.hpp"

namespace farlod {

void require_buildings_for(const SvfOptions& options, const Package& package) {
  const bool asks_for_surfaces = options.source == ReceiverSource::surfaces;
  if (!asks_for_surfaces && !options.evaluation.within_m) return;
  if (package.description().buildings > 0 || !plan_of_surface_model(package)) return;
  const std::string begin = asks_for_surfaces ? "--surfaces" : "--within",
                    end = asks_for_surfaces ? ", or map the surface with --grid" : ", or leave --within out";
  throw NoAnswer(begin + " has no buildings here: this package is a surface model, which does not tell buildings from ground. " +
                 "Pack footprints or a city file" + end + ".");
}

}  // namespace farlod
