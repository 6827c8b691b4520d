// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "app/format_options.hpp"

#include <CLI/CLI.hpp>

#include "app/format_advice.hpp"
#include "app/picture_options.hpp"

namespace farlod {
namespace {

/// Whether a format that is for the receivers has room for what is asked of each.
bool has_room(const OutputFormat& format, const RawQuantities& raw, const SvfOptions& o) {
  if (format.holds_bounds) return true;
  if (o.evaluation.bounds) return false;
  try {
    const RequestedQuantities requested = resolved(raw, &format);
    if (!requested.any()) return true;
    return format.is_picture && (o.source == ReceiverSource::at ? !any_but_irradiation(requested.further) : fits_picture(raw));
  } catch (const CLI::ValidationError&) {
    // Some options go with formats that have quantities of their own, such as those for SOLWEIG
    return false;
  }
}

/// Any format that goes with all that is asked for.
auto can_be_chosen(const RawQuantities& raw, const SvfOptions& o) {
  return [&raw, &o](const OutputFormat& f) { return fits(f, o.source) && has_room(f, raw, o); };
}

void require_format_that_fits(const RawQuantities& raw, const SvfOptions& o) {
  const bool is_for_receivers = fits(*o.format, o.source);
  if (is_for_receivers && (o.format->holds_bounds || !o.evaluation.bounds)) return;
  const std::string ending = o.output.extension().string(), choice = advice(can_be_chosen(raw, o));
  if (!is_for_receivers && o.source == ReceiverSource::grid)
    throw CLI::ValidationError("-o", "--grid makes a raster, which " + ending + " cannot hold: " + choice);
  if (!is_for_receivers) throw CLI::ValidationError("-o", "only --grid makes a raster: " + choice + " for points and surfaces");
  throw CLI::ValidationError("--bounds", "a file that ends in " + ending + " has no room for bounds: " + choice);
}

}  // namespace

bool fits(const OutputFormat& format, ReceiverSource source) {
  if (format.is_picture) return source == ReceiverSource::grid || source == ReceiverSource::at;
  return source == ReceiverSource::grid ? format.holds_rasters() : format.holds_tables();
}

bool any_but_irradiation(Quantities further) {
  further.irradiation = false;
  return further.any();
}

void resolve_format(const std::string& output, const RawQuantities& quantities, SvfOptions& o) {
  o.format = output_format_of(o.output);
  if (output.empty()) throw CLI::ValidationError("-o", "the name is empty: give a file");
  if (o.format == nullptr)
    throw CLI::ValidationError("-o", "the ending of \"" + output +
                                         "\" is not one that can be written here: " + advice(can_be_chosen(quantities, o)) +
                                         nearest_ending(o.output, can_be_chosen(quantities, o)));
  require_format_that_fits(quantities, o);
}

}  // namespace farlod
