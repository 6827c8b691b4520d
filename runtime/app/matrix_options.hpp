// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/svf_options.hpp"

namespace CLI {
class App;
}

namespace farlod {

/// A matrix of view factors, and what surfaces see as EnergyPlus reads it, besides -o.
void add_matrix_options(CLI::App& app, SvfOptions& o);

/// Once all else is known: asks for what the files need. Throws CLI::ValidationError.
void resolve_matrix(SvfOptions& o);

}  // namespace farlod
