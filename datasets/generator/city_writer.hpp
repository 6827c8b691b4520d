// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "generator/city_settings.hpp"
#include "generator/generated_building.hpp"

namespace farlod {

enum class CityFormat { citygml, cityjson, obj, geojson };

/// The format of a file by its ending: .gml, .city.json (or .json), .obj, .geojson. Empty for all others.
[[nodiscard]] std::optional<CityFormat> generated_format_of(const std::filesystem::path& path);

/// What a writer needs before the first building.
struct CityHeader {
  std::string name;  ///< of the data set
  int lod = 1;
  int epsg = 0;
  std::int64_t centre_easting_mm = 0, centre_northing_mm = 0;
  /// OBJ only: coordinates are relative to the centre of the city, for viewers that compute in float.
  bool obj_from_centre = false;
};
[[nodiscard]] CityHeader header_of(const CitySettings& settings, const std::filesystem::path& path);

/// Writes a city building by building: begin, add …, end. Memory does not grow with the city. The file gets its name at the end.
/// All members throw OutputError.
class GeneratedCityWriter {
 public:
  virtual ~GeneratedCityWriter() = default;
  virtual void begin() = 0;
  virtual void add(const GeneratedBuilding& building) = 0;
  virtual std::uint64_t end() = 0;
};

[[nodiscard]] std::unique_ptr<GeneratedCityWriter> make_city_writer(CityFormat format, const std::filesystem::path& path,
                                                                    const CityHeader& header);

/// CityGML 2.0: lod1Solid, or thematic surfaces with an lod2Solid or lod3Solid that refers to them. A component that is not
/// closed has no solid: in LoD1 it is an lod1MultiSurface. Parts are BuildingPart, installations BuildingInstallation with
/// their polygons in lod2Geometry or lod3Geometry, windows and doors openings of their WallSurface.
[[nodiscard]] std::unique_ptr<GeneratedCityWriter> make_citygml_writer(const std::filesystem::path& path,
                                                                       const CityHeader& header);
/// CityJSON 2.0: solids, or a MultiSurface where a component is not closed, from LoD2 on with the semantics of their surfaces.
/// Parts and installations are objects of their own. Vertices are collected in a second, temporary file.
[[nodiscard]] std::unique_ptr<GeneratedCityWriter> make_cityjson_writer(const std::filesystem::path& path,
                                                                        const CityHeader& header);
/// Wavefront OBJ: one group a building with all its components, convex faces without holes, z up, metres.
[[nodiscard]] std::unique_ptr<GeneratedCityWriter> make_obj_writer(const std::filesystem::path& path, const CityHeader& header);
/// GeoJSON footprints, one for each part, with `height` above `base`, in the CRS of the header. Roofs and overhangs are lost.
[[nodiscard]] std::unique_ptr<GeneratedCityWriter> make_geojson_writer(const std::filesystem::path& path,
                                                                       const CityHeader& header);

/// A text file that is written by appending and gets its name when it is committed. A file that is not committed is removed. A
/// destination that is a pipe is written to at once, and cannot be overwritten. Uses a buffer of fixed size. All members throw
/// OutputError.
class CityTextFile {
 public:
  explicit CityTextFile(std::filesystem::path destination);
  ~CityTextFile();
  CityTextFile(const CityTextFile&) = delete;
  CityTextFile& operator=(const CityTextFile&) = delete;

  /// The buffer to append to. Call `drain` after each building.
  [[nodiscard]] std::string& text() { return buffer_; }
  /// Writes the buffer to the file if it is full.
  void drain() {
    if (buffer_.size() >= buffer_bytes) flush();
  }
  /// The number of bytes appended so far.
  [[nodiscard]] std::uint64_t position() const { return flushed_bytes_ + buffer_.size(); }
  /// Overwrites the bytes from `position` on.
  void overwrite(std::uint64_t position, std::string_view text);
  /// Appends the whole text of another file, which is not committed.
  void append(CityTextFile& other);
  /// Returns the number of bytes in the file.
  std::uint64_t commit();

 private:
  static constexpr std::size_t buffer_bytes = std::size_t{1} << 20U;
  void flush();
  [[noreturn]] void fail() const;

  std::filesystem::path destination_, temporary_;  ///< a pipe has no temporary file
  std::fstream file_;
  std::string buffer_;
  std::uint64_t flushed_bytes_ = 0;
};

/// Appends whole millimetres as metres with three decimals.
void append_metres(std::string& text, std::int64_t value_mm);

}  // namespace farlod
