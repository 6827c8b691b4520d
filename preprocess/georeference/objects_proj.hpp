// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>

#include "farlod/point.hpp"

// Private to the wrappers of PROJ: it names its types.
struct pj_ctx;
struct PJconsts;
struct PJ_OBJ_LIST;
struct PJ_OPERATION_FACTORY_CONTEXT;

namespace farlod::georeference {

struct Release {
  void operator()(pj_ctx* context) const;
  void operator()(PJconsts* object) const;
  void operator()(PJ_OBJ_LIST* list) const;
  void operator()(PJ_OPERATION_FACTORY_CONTEXT* search) const;
};
template <class T>
using Owned = std::unique_ptr<T, Release>;

/// The default context of PROJ is shared, and may use the network.
[[nodiscard]] Owned<pj_ctx> make_context();

/// Whether operations count whose grids are not installed.
enum class MissingGrids { count, do_not_count };

/// Operations from one system to another around a place, the most exact first. CrsTransformation chooses among those for
/// everywhere, which takes PROJ five times as long.
[[nodiscard]] Owned<PJ_OBJ_LIST> operations(pj_ctx* context, const PJconsts* from, const PJconsts* to,
                                            std::optional<Point2d> lon_lat_deg, MissingGrids missing_grids);

}  // namespace farlod::georeference
