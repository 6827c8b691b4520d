// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gdal_frmts.h>
#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <system_error>
#include <vector>

#include "base/expects.hpp"
#include "farlod/error.hpp"
#include "gdal/gdal_errors.hpp"
#include "results/atomic_file.hpp"
#include "results/crs_gdal.hpp"
#include "results/raster/raster_writers.hpp"

namespace farlod {
namespace {

using Array = std::shared_ptr<GDALMDArray>;
using Dimension = std::shared_ptr<GDALDimension>;

constexpr const char* mark_of_group = ".zgroup";

const GDALExtendedDataType& text_type() {
  static const GDALExtendedDataType type = GDALExtendedDataType::CreateString();
  return type;
}
const GDALExtendedDataType& real_type() {
  static const GDALExtendedDataType type = GDALExtendedDataType::Create(GDT_Float64);
  return type;
}
const GDALExtendedDataType& single_real_type() {
  static const GDALExtendedDataType type = GDALExtendedDataType::Create(GDT_Float32);
  return type;
}

void add_attribute(GDALIHasAttribute& holder, const std::string& name, const std::string& text) {
  if (const auto attribute = holder.CreateAttribute(name, {}, text_type())) attribute->Write(text.c_str());
}
void add_attribute(GDALIHasAttribute& holder, const std::string& name, const std::vector<double>& numbers) {
  const std::vector<GUInt64> size = numbers.size() == 1 ? std::vector<GUInt64>{} : std::vector<GUInt64>{numbers.size()};
  if (const auto attribute = holder.CreateAttribute(name, size, real_type()))
    size.empty() ? attribute->Write(numbers.front()) : attribute->Write(numbers.data(), numbers.size());
}

/// The group of a folder, and its arrays. Without a group GDAL has failed, and its errors say why.
struct ZarrGroup {
  GDALDatasetUniquePtr file;
  std::shared_ptr<GDALGroup> root;

  explicit ZarrGroup(const std::filesystem::path& folder) {
    GDALRegister_Zarr();  // all drivers would take longer than a small map
    GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("Zarr");
    if (driver == nullptr) return;
    CPLStringList options;
    options.AddString("FORMAT=ZARR_V2");
    file.reset(driver->CreateMultiDimensional(folder.c_str(), nullptr, options.List()));
    if (file) root = file->GetRootGroup();
  }
  /// Null where GDAL fails.
  [[nodiscard]] Array array(const std::string& name, const std::vector<Dimension>& dimensions, const GDALExtendedDataType& type,
                            const std::string& chunk = "") const {
    CPLStringList options;
    options.SetNameValue("COMPRESS", "ZLIB");
    options.SetNameValue("ZLIB_LEVEL", "2");
    if (!chunk.empty()) options.SetNameValue("BLOCKSIZE", chunk.c_str());
    return root->CreateMDArray(name, dimensions, type, options.List());
  }
};

/// An axis, by what the conventions and GDAL call it.
struct Axis {
  std::string name, axis, gdal_type, gdal_direction, text;
};

Dimension add_axis(const ZarrGroup& group, const Axis& axis, std::size_t count, double first, double step) {
  Dimension dimension = group.root->CreateDimension(axis.name, axis.gdal_type, axis.gdal_direction, count);
  const Array places = dimension ? group.array(axis.name, {dimension}, real_type()) : nullptr;
  if (!places) return nullptr;
  dimension->SetIndexingVariable(places);
  add_attribute(*places, "standard_name", "projection_" + axis.name + "_coordinate");
  add_attribute(*places, "long_name", axis.text);
  add_attribute(*places, "units", "m");
  add_attribute(*places, "axis", axis.axis);
  std::vector<double> centres;
  for (std::size_t n = 0; n < count; ++n) centres.push_back(first + (static_cast<double>(n) + 0.5) * step);
  const std::array<GUInt64, 1> begin{0};
  const std::array<std::size_t, 1> size{count};
  places->Write(begin.data(), size.data(), nullptr, nullptr, real_type(), centres.data());
  return dimension;
}

void add_grid_mapping(const ZarrGroup& group, const RasterFrame& raster) {
  const CfGridMapping mapping = cf_grid_mapping_of(raster.crs_wkt, raster.epsg);
  const Array crs = group.array("crs", {}, GDALExtendedDataType::Create(GDT_Int32));
  if (!crs) return;
  // Without it, xarray does not know that the array has no dimensions
  const auto json = GDALExtendedDataType::CreateString(0, GEDTST_JSON);
  if (const auto dimensions = crs->CreateAttribute("_ARRAY_DIMENSIONS", {}, json)) dimensions->Write("[]");
  if (!mapping.name.empty()) add_attribute(*crs, "grid_mapping_name", mapping.name);
  for (const auto& [name, values] : mapping.parameters) add_attribute(*crs, name, values);
  add_attribute(*crs, "crs_wkt", raster.crs_wkt);
}

Array add_band(const ZarrGroup& group, const Band& band, const std::vector<Dimension>& dimensions, const RasterFrame& raster) {
  static_assert(raster_tile_edge == 256);
  Array array = group.array(band.name, dimensions, single_real_type(), "256,256");
  if (!array) return nullptr;
  array->SetNoDataValue(std::numeric_limits<double>::quiet_NaN());
  add_attribute(*array, "units", band.unit);
  add_attribute(*array, "long_name", band.definition);
  if (raster.crs_wkt.empty()) return array;
  add_attribute(*array, "grid_mapping", "crs");
  // GDAL looks for the CRS here alone
  if (OGRSpatialReference crs; read_crs(crs, raster.crs_wkt, raster.epsg)) array->SetSpatialRef(&crs);
  return array;
}

class ZarrWriter final : public RasterWriter {
 public:
  ZarrWriter(const RasterFrame& frame, const std::filesystem::path& path) : frame_(frame), path_(path), folder_(path) {
    // Asked before the work: commit() would find it after hours
    std::error_code nothing_there;
    if (std::filesystem::exists(path, nothing_there) && !std::filesystem::exists(path / mark_of_group, nothing_there))
      throw OutputError(path, "it is there already, and no Zarr group; choose another name");
    const GdalErrors errors;
    group_.emplace(folder_.temporary());
    if (!group_->root) throw OutputError(path, errors.any() ? errors.last() : "this GDAL cannot write Zarr");
    describe();
    const Axis northing{"y", "Y", GDAL_DIM_TYPE_HORIZONTAL_Y, "NORTH", "northing of the pixel's centre"};
    const Axis easting{"x", "X", GDAL_DIM_TYPE_HORIZONTAL_X, "EAST", "easting of the pixel's centre"};
    const Dimension y = add_axis(*group_, northing, frame.rows, frame.north_west_m.y, -frame.step_m);
    const Dimension x = add_axis(*group_, easting, frame.columns, frame.north_west_m.x, frame.step_m);
    if (!frame.crs_wkt.empty()) add_grid_mapping(*group_, frame);
    throw_if_any(errors);
    for (const Band& band : frame.bands) bands_.push_back(add_band(*group_, band, {y, x}, frame));
    throw_if_any(errors);
  }
  ~ZarrWriter() override {
    const GdalErrors nobody_hears;  // of a folder that is given up
    bands_.clear();
    group_.reset();
  }
  void write(const RasterTile& tile) override {
    const GdalErrors errors;
    const std::vector<std::span<const float>> bands = bands_of(tile);
    FARLOD_EXPECTS(bands.size() == bands_.size());
    const std::array<GUInt64, 2> first{tile.place.row * raster_tile_edge, tile.place.column * raster_tile_edge};
    const std::array<std::size_t, 2> size{pixels_of_tile(tile.place.row, frame_.rows),
                                          pixels_of_tile(tile.place.column, frame_.columns)};
    const std::array<GPtrDiff_t, 2> stride{raster_tile_edge, 1};
    for (std::size_t n = 0; n < bands.size(); ++n)
      bands_[n]->Write(first.data(), size.data(), nullptr, stride.data(), single_real_type(), bands[n].data());
    throw_if_any(errors);
  }
  void commit() override {
    const GdalErrors errors;
    bands_.clear();
    group_.reset();  // a full disk may show only now
    throw_if_any(errors);
    folder_.commit(mark_of_group);
  }

 private:
  void throw_if_any(const GdalErrors& errors) const {
    if (errors.any()) throw OutputError(path_, errors.last());
  }
  void describe() {
    GDALGroup& root = *group_->root;
    add_attribute(root, "Conventions", "CF-1.8");
    add_attribute(root, "title", frame_.bands.front().definition);
    for (const auto& [name, value] : entries_of(frame_.provenance))
      add_attribute(root, name == "software" ? "source" : name, value);
  }

  RasterFrame frame_;
  std::filesystem::path path_;
  AtomicFolder folder_;
  std::optional<ZarrGroup> group_;
  std::vector<Array> bands_;
};

}  // namespace

std::unique_ptr<RasterWriter> zarr_writer(const RasterFrame& frame, const std::filesystem::path& path) {
  return std::make_unique<ZarrWriter>(frame, path);
}

}  // namespace farlod
