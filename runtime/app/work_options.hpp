// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "app/svf_options.hpp"

namespace CLI {
class App;
}

namespace farlod {

/// Adds --resume, --shard and --merge. Both must outlive the parsing.
void add_work_options(CLI::App& app, std::string& shard_text, SvfOptions& options);

/// Once the other options are resolved. Throws CLI::ValidationError.
void resolve_work(const std::string& shard_text, SvfOptions& options);

}  // namespace farlod
