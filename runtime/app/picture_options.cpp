// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "app/picture_options.hpp"

#include <CLI/CLI.hpp>

#include "app/format_advice.hpp"
#include "console/option_list.hpp"

namespace farlod {
namespace {

const OutputFormat* picture_format_of(const std::string& file, const char* option) {
  const auto is_picture = [](const OutputFormat& f) { return f.is_picture; };
  const OutputFormat* const format = output_format_of(file);
  if (format == nullptr || !is_picture(*format))
    throw CLI::ValidationError(option, "\"" + file + "\" is not the name of a picture: " + advice(is_picture));
  return format;
}

void resolve_preview(SvfOptions& o) {
  if (o.preview_file.empty()) return;
  if (o.source != ReceiverSource::grid) throw CLI::ValidationError("--preview", "it goes with --grid");
  o.preview_format = picture_format_of(o.preview_file, "--preview");
}

void resolve_histogram(const SvfOptions& o) {
  if (o.histogram_file.empty()) return;
  if (o.source == ReceiverSource::at)
    throw CLI::ValidationError("--histogram", "it goes with --grid, --points, --along and --surfaces");
  (void)picture_format_of(o.histogram_file, "--histogram");
}

void resolve_verify_map(SvfOptions& o) {
  if (o.verify_file.empty()) return;
  if (o.evaluation.verify == 0) throw CLI::ValidationError("--verify-map", "it needs receivers to verify: give --verify");
  if (o.source == ReceiverSource::at)
    throw CLI::ValidationError("--verify-map", "it goes with --grid, --points, --along and --surfaces");
  o.verify_format = output_format_of(o.verify_file);
  const auto fits = [](const OutputFormat& f) { return f.is_picture || f.name == "CSV"; };
  if (o.verify_format == nullptr || !fits(*o.verify_format))
    throw CLI::ValidationError("--verify-map", "\"" + o.verify_file + "\" is neither a picture nor a table: " + advice(fits));
}

void resolve_projection(const RawPictures& raw, SvfOptions& o) {
  if (raw.projection.empty()) return;
  if (o.source != ReceiverSource::at || !o.format->is_picture)
    throw CLI::ValidationError("--projection", "it goes with a picture of --at");
  o.projection = raw.projection == "equidistant"  ? SkyProjection::equidistant
                 : raw.projection == "equal-area" ? SkyProjection::equal_area
                                                  : SkyProjection::orthographic;
}

}  // namespace

void add_picture_options(CLI::App& app, RawPictures& raw, SvfOptions& o) {
  app.add_option("--preview", o.preview_file, "Also draw the raster as this picture (PNG, SVG or PDF), with a colour scale")
      ->type_name(file_value)
      ->group("Output");
  app.add_option("--histogram", o.histogram_file,
                 "Also draw how the values are distributed as this picture (PNG, SVG or PDF); surfaces count by their area")
      ->type_name(file_value)
      ->group("Output");
  app.add_option("--projection", raw.projection, "Of a picture of the sky above --at (default: equal-area)")
      ->check(CLI::IsMember({"equidistant", "equal-area", "orthographic"}))
      ->group("Output");
}

void resolve_pictures(const RawPictures& raw, SvfOptions& o) {
  resolve_preview(o);
  resolve_verify_map(o);
  resolve_histogram(o);
  resolve_projection(raw, o);
}

}  // namespace farlod
