// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "georeference/objects_proj.hpp"

#include <proj.h>

namespace farlod::georeference {

void Release::operator()(pj_ctx* context) const { proj_context_destroy(context); }
void Release::operator()(PJconsts* object) const { proj_destroy(object); }
void Release::operator()(PJ_OBJ_LIST* list) const { proj_list_destroy(list); }
void Release::operator()(PJ_OPERATION_FACTORY_CONTEXT* search) const { proj_operation_factory_context_destroy(search); }

Owned<pj_ctx> make_context() {
  Owned<PJ_CONTEXT> context(proj_context_create());
  proj_context_set_enable_network(context.get(), 0);
  proj_log_level(context.get(), PJ_LOG_NONE);
  return context;
}

Owned<PJ_OBJ_LIST> operations(pj_ctx* context, const PJconsts* from, const PJconsts* to, std::optional<Point2d> lon_lat_deg,
                              MissingGrids missing_grids) {
  const Owned<PJ_OPERATION_FACTORY_CONTEXT> search(proj_create_operation_factory_context(context, nullptr));
  constexpr double around_deg = 0.01;
  if (lon_lat_deg)
    proj_operation_factory_context_set_area_of_interest(context, search.get(), lon_lat_deg->x - around_deg,
                                                        lon_lat_deg->y - around_deg, lon_lat_deg->x + around_deg,
                                                        lon_lat_deg->y + around_deg);
  proj_operation_factory_context_set_spatial_criterion(context, search.get(), PROJ_SPATIAL_CRITERION_PARTIAL_INTERSECTION);
  const bool all_count = missing_grids == MissingGrids::count;
  proj_operation_factory_context_set_grid_availability_use(
      context, search.get(),
      all_count ? PROJ_GRID_AVAILABILITY_IGNORED : PROJ_GRID_AVAILABILITY_DISCARD_OPERATION_IF_MISSING_GRID);
  proj_operation_factory_context_set_allow_ballpark_transformations(context, search.get(), 0);
  return Owned<PJ_OBJ_LIST>(proj_create_operations(context, from, to, search.get()));
}

}  // namespace farlod::georeference
