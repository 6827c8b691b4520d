// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <stop_token>
#include <string>
#include <unordered_set>

#include "city/source.hpp"
#include "farlod/problem.hpp"
#include "ingest/citygml/citygml_building.hpp"
#include "ingest/citygml/citygml_parser.hpp"
#include "ingest/citygml/citygml_segments.hpp"
#include "ingest/citygml/gml_references.hpp"
#include "ingest/citygml/gml_surfaces.hpp"
#include "ingest/files/input_file.hpp"
#include "ingest/model_builder/city_model_builder.hpp"
#include "ingest/model_builder/lod_choice.hpp"

namespace farlod::ingest {

/// What was read of a file.
struct CityGmlContents {
  SourceCity city;
  Report report;
  std::unordered_set<std::string> foreign_hrefs;  ///< references of buildings to what is outside of them
};

/// A file to read, and how.
struct ReadingTask {
  const InputFile& file;
  LodChoice lod;
  const GmlSurfaces& foreign;  ///< what buildings refer to outside of themselves
  std::stop_token stop;
  SegmentSizes segments;
};

/// Makes the city of a whole file, or of a segment of it that `append` adds to what comes before.
class CityGmlReading {
 public:
  /// `budget`: nothing is taken of it yet. `has_crs`: whether an earlier segment names a CRS.
  /// `forms`: those of attributes in earlier segments.
  CityGmlReading(const ReadingTask& task, const ReferenceBudget& budget, RepeatedIds repeated_ids, bool has_crs = false,
                 std::vector<package::AttributeForm> forms = {});

  /// What the file, or the segment, is passed to.
  [[nodiscard]] XmlListener& listener() { return parser_; }
  [[nodiscard]] bool has_crs() const { return !parser_.srs_name().empty(); }
  [[nodiscard]] const std::vector<package::AttributeForm>& forms() const { return parser_.forms(); }
  /// Adds the next segment. Throws CannotBeCut where the two would have been read otherwise as one.
  void append(CityGmlReading&& next);
  /// Throws InputError when there is neither a building nor terrain.
  [[nodiscard]] CityGmlContents finish();

 private:
  void take(const CityGmlBuilding& building);
  [[noreturn]] void throw_nothing_there() const;
  void report_unreadable_relief(std::size_t points);

  const ReadingTask& task_;
  bool has_places_;
  Report report_;
  ReferenceBudget budget_;
  CityModelBuilder builder_;
  CityGmlParser parser_;
  std::unordered_set<std::string> foreign_hrefs_;
};

}  // namespace farlod::ingest
