// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/svf_options.hpp"
#include "farlod/package.hpp"
#include "results/provenance.hpp"

namespace farlod {

/// What the files of a run say of it. Paths, threads and limits are no part of it: they change no value.
[[nodiscard]] Provenance provenance_of(const SvfOptions& options, const PackageDescription& package);

}  // namespace farlod
