// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "horizon/overhangs.hpp"
#include "rays/ray_engine.hpp"
#include "receivers/receiver.hpp"

namespace farlod {

/// Traces the rays that the far map leaves open, of receivers for whom they are more than `most` to one side of the estimate.
/// `whole_city` is asked for when it is needed. Returns how many were traced.
[[nodiscard]] std::uint64_t retrace_open_rays(double most, std::span<const Receiver> receivers, const RayEngine& engine,
                                              const std::function<PlacedScene()>& whole_city, std::span<FreeRays> free);

}  // namespace farlod
