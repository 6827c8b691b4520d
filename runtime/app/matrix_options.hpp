// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/svf_options.hpp"

namespace CLI {
class App;
}

namespace farlod {

/// A matrix of view factors besides -o.
void add_matrix_options(CLI::App& app, SvfOptions& o);

/// Once all else is known. Throws CLI::ValidationError.
void resolve_matrix(const SvfOptions& o);

}  // namespace farlod
