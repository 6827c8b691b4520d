// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "generator/city_writer.hpp"

#include <algorithm>

#include "generator/plan_frame.hpp"

namespace farlod {

std::optional<CityFormat> city_format_of(const std::filesystem::path& path) {
  const std::string ending = path.extension().string();
  if (ending == ".gml") return CityFormat::citygml;
  if (ending == ".json") return CityFormat::cityjson;
  if (ending == ".obj") return CityFormat::obj;
  if (ending == ".geojson") return CityFormat::geojson;
  return std::nullopt;
}

namespace {

/// The name of the file without its endings and without characters that XML, JSON or OBJ would have to escape.
[[nodiscard]] std::string plain_name(const std::filesystem::path& path) {
  std::string name = path.filename().string();
  name.resize(std::min(name.size(), name.find('.', 1)));
  for (char& c : name) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-';
    if (!plain) c = '_';
  }
  return name;
}

}  // namespace

CityHeader header_of(const CitySettings& settings, const std::filesystem::path& path) {
  CityHeader header{.name = plain_name(path), .lod = written_lod(settings), .epsg = settings.epsg};
  header.centre_easting_mm = millimetres(settings.centre_easting_m);
  header.centre_northing_mm = millimetres(settings.centre_northing_m);
  return header;
}

std::unique_ptr<GeneratedCityWriter> make_city_writer(CityFormat format, const std::filesystem::path& path,
                                                      const CityHeader& header) {
  switch (format) {
    case CityFormat::citygml:
      return make_citygml_writer(path, header);
    case CityFormat::cityjson:
      return make_cityjson_writer(path, header);
    case CityFormat::obj:
      return make_obj_writer(path, header);
    case CityFormat::geojson:
      break;
  }
  return make_geojson_writer(path, header);
}

}  // namespace farlod
