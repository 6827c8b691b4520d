// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/svf_options.hpp"
#include "farlod/answer_file.hpp"
#include "farlod/package.hpp"
#include "results/provenance.hpp"

namespace farlod {

/// The options that the values of a run depend on, and what they are; a flag is "on". Files have their names without folders.
/// Paths, threads and limits are no part of it: they change no value.
[[nodiscard]] AnswerKey key_of(const SvfOptions& options);

/// What decides whether answers that are kept may be taken again: the same, the program, and the contents of the package and of
/// all files that the options name.
[[nodiscard]] AnswerKey key_of_answers(const SvfOptions& options, const PackageDescription& package);

/// What the files of a run say of it: its key as a command line.
[[nodiscard]] Provenance provenance_of(const SvfOptions& options, const PackageDescription& package);

}  // namespace farlod
