// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "app/quantity_options.hpp"
#include "app/svf_options.hpp"
#include "results/output_format.hpp"

namespace farlod {

/// Whether a format is for such receivers: a picture is a map of --grid, or the sky above --at.
[[nodiscard]] bool fits(const OutputFormat& format, ReceiverSource source);

/// Whether more is asked for than svf and irradiation, which is all that a picture of the sky shows.
[[nodiscard]] bool any_but_irradiation(Quantities further);

/// Chooses the format by the ending of the name of -o, once the receivers and --bounds are known. Throws CLI::ValidationError,
/// whose message offers only endings that go with all that is asked for.
void resolve_format(const std::string& output, const RawQuantities& quantities, SvfOptions& o);

}  // namespace farlod
