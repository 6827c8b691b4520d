// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <proj.h>

#include <cmath>

#include "base/expects.hpp"
#include "georeference/height_shift.hpp"
#include "georeference/objects_proj.hpp"

namespace farlod::georeference {
namespace {

/// The first grid of an operation that is not installed: its name as `projsync` fetches it, else as the register has it.
std::string missing_grid(PJ_CONTEXT* context, const PJ* operation) {
  for (int n = 0; n < proj_coordoperation_get_grid_used_count(context, operation); ++n) {
    const char *name = nullptr, *address = nullptr;
    int is_there = 0;
    const int is_known =
        proj_coordoperation_get_grid_used(context, operation, n, &name, nullptr, nullptr, &address, nullptr, nullptr, &is_there);
    if (is_known == 0 || is_there != 0) continue;
    const std::string text = address != nullptr ? address : "";
    if (!text.empty()) return text.substr(text.rfind('/') + 1);
    return name != nullptr ? name : "";
  }
  return {};
}

}  // namespace

struct HeightShift::Impl {
  Owned<PJ_CONTEXT> context;
  Owned<PJ> operation;
  double to_unit_m = 1.0;

  [[nodiscard]] std::optional<double> at(Point2d p) const {
    const PJ_COORD there = proj_trans(operation.get(), PJ_FWD, proj_coord(p.x, p.y, 0.0, HUGE_VAL));
    return std::isfinite(there.xyz.z) ? std::optional(there.xyz.z * to_unit_m) : std::nullopt;
  }
};

HeightShift::HeightShift(const Crs& from, const Crs& to, Point2d typical) {
  FARLOD_EXPECTS(from.heights_name() && to.heights_name());
  is_same_ = from.heights_name() == to.heights_name();
  if (is_same_) return;
  auto impl = std::make_shared<Impl>();
  impl->context = make_context();
  impl->to_unit_m = to.height_unit_m();
  PJ_CONTEXT* const context = impl->context.get();
  const Owned<PJ> own(proj_create(context, from.whole_wkt().c_str())), other(proj_create(context, to.whole_wkt().c_str()));
  const auto list =
      own && other ? operations(context, own.get(), other.get(), from.lon_lat_deg(typical), MissingGrids::count) : nullptr;
  std::string grid;
  for (int n = 0; list && n < proj_list_get_count(list.get()) && !impl_; ++n) {
    const Owned<PJ> found(proj_list_get(context, list.get(), n));
    if (proj_coordoperation_has_ballpark_transformation(context, found.get()) != 0) continue;
    if (grid.empty()) grid = missing_grid(context, found.get());
    if (proj_coordoperation_is_instantiable(context, found.get()) == 0) continue;
    impl->operation.reset(proj_normalize_for_visualization(context, found.get()));
    if (impl->operation && impl->at(typical)) impl_ = impl;
  }
  if (!impl_)
    reason_ = "its heights count from another zero (" + *from.heights_name() + ") than those of the city (" + *to.heights_name() +
              "), and PROJ has no way from one to the other" + (grid.empty() ? "" : " without the grid " + grid);
}

std::optional<double> HeightShift::at(Point2d p_from) const {
  FARLOD_EXPECTS(is_known());
  return impl_->at(p_from);
}

}  // namespace farlod::georeference
