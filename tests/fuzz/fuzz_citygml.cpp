// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <optional>

#include "base/expects.hpp"
#include "farlod/error.hpp"
#include "ingest/citygml/citygml_reader.hpp"
#include "ingest/citygml/citygml_xml.hpp"
#include "tests/fuzz/fuzzed_ingest.hpp"

namespace farlod::ingest {
namespace {

std::optional<CityGmlContents> read_as_one(const ReadingTask& task) {
  try {
    CityGmlReading whole(task, ReferenceBudget(task.foreign), RepeatedIds::reported);
    parse_xml(task.file, whole.listener());
    return whole.finish();
  } catch (const InputError&) {
    return std::nullopt;
  }
}

void expect_same(const CityModel& a, const CityModel& b) {
  const auto is_same_building = [](const Building& x, const Building& y) {
    return x.id == y.id && x.facet_count == y.facet_count;
  };
  const auto is_same_facet = [](const Facet& x, const Facet& y) {
    return x.first_ring == y.first_ring && x.ring_count == y.ring_count && x.surface == y.surface && x.part == y.part &&
           x.kind == y.kind;
  };
  FARLOD_EXPECTS(std::ranges::equal(a.buildings(), b.buildings(), is_same_building));
  FARLOD_EXPECTS(std::ranges::equal(a.facets(), b.facets(), is_same_facet));
  FARLOD_EXPECTS(std::ranges::equal(a.points(), b.points()));
}

void expect_same(const CityGmlContents& a, const CityGmlContents& b) {
  const auto is_same_problem = [](const Problem& x, const Problem& y) {
    return x.code == y.code && x.place == y.place && x.detail == y.detail && x.position == y.position && x.ring == y.ring;
  };
  expect_same(a.city.city, b.city.city);
  FARLOD_EXPECTS(std::ranges::equal(a.report.problems(), b.report.problems(), is_same_problem));
  FARLOD_EXPECTS(a.city.crs.definition == b.city.crs.definition && a.city.skipped == b.city.skipped);
  FARLOD_EXPECTS(a.city.relief_points == b.city.relief_points && a.foreign_hrefs == b.foreign_hrefs);
}

/// Whether a file is read in segments or as a whole makes no difference.
void expect_segments_change_nothing(const InputFile& file) {
  const GmlSurfaces none;
  const ReadingTask task{file, {}, none, {}, {.least = 64, .most = 8192}};
  try {
    const std::optional<CityGmlContents> in_segments = read_in_segments(task);
    if (!in_segments) return;
    const std::optional<CityGmlContents> as_one = read_as_one(task);
    FARLOD_EXPECTS(as_one);
    expect_same(*in_segments, *as_one);
  } catch (const InputError&) {
    FARLOD_EXPECTS(!read_as_one(task));
  }
}

}  // namespace
}  // namespace farlod::ingest

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::span bytes(data, size);
  farlod::ingest_bytes(bytes, ".gml", {});
  // LoD 0 is raised to prisms, and only where one asks for it
  farlod::ingest::IngestSettings footprints;
  footprints.lod.exactly = 0;
  farlod::ingest_bytes(bytes, ".gml", footprints);
  farlod::ingest::expect_segments_change_nothing(farlod::write_file(bytes, ".gml"));
  return 0;
}
