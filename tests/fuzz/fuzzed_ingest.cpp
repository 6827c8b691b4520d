// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/fuzzed_ingest.hpp"

#include <cmath>
#include <filesystem>
#include <string>

#include "farlod/error.hpp"
#include "package/sources_layout.hpp"
#include "tests/fuzz/scratch_folder.hpp"

namespace farlod {
namespace {

namespace fs = std::filesystem;

bool is_finite(const Point3d& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

void expect_clean_ring(std::span<const Point3d> ring) {
  FARLOD_EXPECTS(ring.size() >= 3);
  for (std::size_t i = 0; i < ring.size(); ++i) {
    FARLOD_EXPECTS(is_finite(ring[i]));
    FARLOD_EXPECTS(ring[i] != ring[(i + 1) % ring.size()]);
  }
}

/// Places are in the file, and what is written around attributes there is known.
void expect_origin_in_file(const SourceCity& source, const Building& building, std::size_t file_bytes) {
  const std::span<const std::uint8_t> bytes = source.city.origin_of(building);
  if (bytes.empty()) {
    FARLOD_EXPECTS(!source.placed.has_value());
    return;
  }
  const auto origin = package::origin_from(bytes);
  FARLOD_EXPECTS(origin.has_value());
  FARLOD_EXPECTS(source.placed.has_value() || !origin->ids.empty());
  for (const SurfaceIds& ids : origin->ids) FARLOD_EXPECTS(ids.begin < ids.end && (ids.behind_building_id || !ids.id.empty()));
  if (!source.placed) return;
  for (const auto* places : {&origin->objects, &origin->semantics})
    for (const AttributePlace& place : *places)
      FARLOD_EXPECTS(place.at <= file_bytes && place.form <= source.placed->forms.size());
}

void expect_promises_kept(const SourceCity& source, std::size_t file_bytes) {
  const CityModel& city = source.city;
  for (const Building& building : city.buildings()) expect_origin_in_file(source, building, file_bytes);
  FARLOD_EXPECTS(!city.buildings().empty() || !source.relief_points.empty());
  for (const Point3d& p : source.relief_points) FARLOD_EXPECTS(is_finite(p));
  for (const Building& building : city.buildings()) FARLOD_EXPECTS(building.facet_count > 0);
  for (const Facet& facet : city.facets()) {
    FARLOD_EXPECTS(facet.ring_count > 0);
    for (std::uint32_t k = 0; k < facet.ring_count; ++k) expect_clean_ring(city.ring(facet, k));
  }
}

}  // namespace

fs::path write_file(std::span<const std::uint8_t> bytes, std::string_view ending) {
  static const ScratchFolder folder;
  return folder.write(bytes, "city" + std::string(ending));
}

void ingest_bytes(std::span<const std::uint8_t> bytes, std::string_view ending, const ingest::IngestSettings& settings) {
  Report report;
  try {
    expect_promises_kept(ingest::ingest(write_file(bytes, ending), settings, report), bytes.size());
  } catch (const InputError& refusal) {
    FARLOD_EXPECTS(!std::string_view(refusal.what()).empty());
  }
}

}  // namespace farlod
