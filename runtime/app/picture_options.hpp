// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "app/svf_options.hpp"

namespace CLI {
class App;
}

namespace farlod {

/// What the options of pictures say, as text, unless SvfOptions has it so.
struct RawPictures {
  std::string projection;
};

/// Pictures besides -o, and how the sky is laid into one.
void add_picture_options(CLI::App& app, RawPictures& raw, SvfOptions& o);

/// Once the receivers and the format of -o are known. Also of the map of a verification. Throws CLI::ValidationError.
void resolve_pictures(const RawPictures& raw, SvfOptions& o);

}  // namespace farlod
