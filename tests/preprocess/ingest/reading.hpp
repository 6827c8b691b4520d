// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "ingest/ingest.hpp"
#include "tests/scenes/temporary_folder.hpp"
#include "tests/scenes/test_data.hpp"

namespace farlod::ingest::test {

struct Reading {
  SourceCity source;
  Report report;

  [[nodiscard]] const CityModel& city() const { return source.city; }
  [[nodiscard]] std::set<int> codes() const {
    std::set<int> codes;
    for (const Problem& problem : report.problems()) codes.insert(static_cast<int>(problem.code));
    return codes;
  }
};

inline Reading read_file(const std::filesystem::path& file, const IngestSettings& settings = {}) {
  Reading reading;
  reading.source = ingest(file, settings, reading.report);
  return reading;
}

/// All that a reading gives, as text.
inline std::string described(const SourceCity& source, const Report& report) {
  std::ostringstream text;
  text.precision(17);
  text << source.source << ' ' << source.crs.definition << '\n';
  for (const Building& b : source.city.buildings()) {
    text << b.id << ' ' << b.first_facet << '\n';
    for (const std::uint8_t byte : source.city.origin_of(b)) text << static_cast<int>(byte) << ' ';
    for (const Facet& f : source.city.facets_of(b)) {
      text << f.first_ring << ' ' << f.surface << ' ' << f.part << ' ' << static_cast<int>(f.kind) << ':';
      for (std::uint32_t k = 0; k < f.ring_count; ++k)
        for (const Point3d& p : source.city.ring(f, k)) text << ' ' << p.x << ',' << p.y << ',' << p.z;
      text << '\n';
    }
  }
  if (source.placed)
    for (const AttributeForm& form : source.placed->forms) text << form.before_name << form.behind_value << '\n';
  for (const Point3d& p : source.relief_points) text << "relief " << p.x << ' ' << p.y << ' ' << p.z << '\n';
  for (const auto& [name, count] : source.skipped) text << count << ' ' << name << '\n';
  for (const Problem& p : report.problems()) {
    text << static_cast<int>(p.code) << ' ' << p.source << ' ' << p.place << ' ' << p.detail << ' ' << p.ring;
    if (p.position) text << ' ' << p.position->x << ' ' << p.position->y << ' ' << p.position->z;
    text << '\n';
  }
  return text.str();
}

/// Writes a file of the running test's own, which is gone when the program ends.
inline std::filesystem::path write_file(const std::string& name, const std::string& text) {
  static const scenes::TemporaryFolder folders;
  const auto* test = testing::UnitTest::GetInstance()->current_test_info();
  const std::filesystem::path folder = folders.path() / test->test_suite_name() / test->name();
  std::filesystem::create_directories(folder);
  std::ofstream(folder / name, std::ios::binary) << text;
  return folder / name;
}

inline Reading read_text(const std::string& name, const std::string& text, const IngestSettings& settings = {}) {
  return read_file(write_file(name, text), settings);
}

/// The normal of a facet's outer ring, as long as twice its area.
inline Point3d double_area_vector(const CityModel& city, const Facet& facet) {
  const auto ring = city.ring(facet, 0);
  Point3d sum;
  for (std::size_t i = 1; i + 1 < ring.size(); ++i) sum = sum + cross(ring[i] - ring[0], ring[i + 1] - ring[0]);
  return sum;
}

inline std::size_t count_kind(const CityModel& city, SurfaceKind kind) {
  return static_cast<std::size_t>(
      std::count_if(city.facets().begin(), city.facets().end(), [&](const Facet& f) { return f.kind == kind; }));
}

inline std::filesystem::path shared_data(const std::string& name) { return scenes::test_data(name); }

}  // namespace farlod::ingest::test

/// Real data lies outside of the project; where it is absent the test says so and skips.
#define FARLOD_NEEDS_DATA(name)                                          \
  if (!std::filesystem::exists(farlod::ingest::test::shared_data(name))) \
  GTEST_SKIP() << farlod::scenes::absence_of(farlod::ingest::test::shared_data(name))
