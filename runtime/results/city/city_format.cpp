// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/city/city_format.hpp"

#include <array>
#include <string_view>

#include "base/lower_case.hpp"

namespace farlod {
namespace {

struct CityEnding {
  std::string_view ending;
  CityFileFormat format;
};

constexpr std::array<CityEnding, 6> city_endings{{{".city.json", CityFileFormat::cityjson},
                                                  {".city.jsonl", CityFileFormat::cityjsonseq},
                                                  {".jsonl", CityFileFormat::cityjsonseq},
                                                  {".gml", CityFileFormat::citygml},
                                                  {".xml", CityFileFormat::citygml},
                                                  {".citygml", CityFileFormat::citygml}}};

}  // namespace

std::string name_of(CityFileFormat format) {
  if (format == CityFileFormat::cityjsonseq) return "CityJSONSeq";
  return format == CityFileFormat::cityjson ? "CityJSON" : "CityGML";
}

std::optional<CityFileFormat> city_format_of(const std::filesystem::path& path) {
  const std::string name = lower_case(path.filename().string());
  for (const auto& [ending, format] : city_endings)
    if (name.size() > ending.size() && name.ends_with(ending)) return format;
  return std::nullopt;
}

std::string endings_of(CityFileFormat format) {
  std::string list, last;
  for (const auto& [ending, of_format] : city_endings) {
    if (of_format != format) continue;
    if (!last.empty()) list += (list.empty() ? "" : ", ") + last;
    last = ending;
  }
  return list.empty() ? last : list + " or " + last;
}

}  // namespace farlod
