// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>

#include "evaluate/sky_evaluator.hpp"
#include "farlod/answer_file.hpp"

namespace farlod {

/// The answers of the n-th cell of a run as it was kept, if it was. `wanted` has the sizes that they must have.
[[nodiscard]] std::optional<SvfValues> find_answers(const AnswerFile& file, std::size_t n, SvfValues wanted);
void keep_answers(const AnswerFile& file, std::size_t n, const SvfValues& values);

}  // namespace farlod
