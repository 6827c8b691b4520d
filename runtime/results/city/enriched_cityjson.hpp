// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "farlod/surfaces.hpp"
#include "results/city/cityjson_file.hpp"
#include "results/table/table_writer.hpp"

namespace farlod {

/// The receivers of a run: on whole buildings, or on what lies in a mask or box.
enum class EnrichedExtent { whole_buildings, part_of_the_city };

/// A CityJSON file that comes back with what a run computed as attributes.
///   (1) The output is the input, byte for byte, with texts inserted.
///   (2) Objects of `semantics.surfaces` get the attributes of their surfaces; a building gets those of its row in the table of
///       buildings, its parts and installations those of their own surfaces.
///   (3) Nothing is inserted where there is no answer.
class EnrichedCityJson {
 public:
  /// Reads the file. Throws InputError where it cannot be read, is no CityJSON or a sequence of texts, or has attributes of these
  /// names already.
  EnrichedCityJson(const std::filesystem::path& city, AnswerColumns columns);

  /// What it holds until the run has ended.
  [[nodiscard]] std::size_t bytes() const { return file_.bytes(); }
  /// Writes the file again, and returns what the user should know, a sentence each. Throws OutputError, and InputError where the
  /// surfaces of the run are not those of the file: their numbers, kinds, tilts and areas are compared.
  [[nodiscard]] std::vector<std::string> write(const SurfaceMeans& means, EnrichedExtent extent,
                                               const std::filesystem::path& output) const;

 private:
  std::filesystem::path path_;
  AnswerColumns columns_;
  CityJsonFile file_;
};

}  // namespace farlod
