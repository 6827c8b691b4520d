// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pybind11/pybind11.h>

#include "farlod/evaluation.hpp"

namespace farlod {

/// The figures of a run under the names that the summary of farlod-svf gives them; what there is not is left out.
[[nodiscard]] pybind11::dict summary_dict(const EvaluationSummary& run);

}  // namespace farlod
