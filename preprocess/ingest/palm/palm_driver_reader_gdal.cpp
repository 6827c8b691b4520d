// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gdal_alg.h>
#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <memory>
#include <tuple>
#include <utility>

#include "farlod/angle.hpp"
#include "farlod/error.hpp"
#include "gdal/gdal_errors.hpp"
#include "gdal/height_raster_gdal.hpp"
#include "gdal/local_data_gdal.hpp"
#include "gdal/vector_file_gdal.hpp"
#include "gdal/wkt_gdal.hpp"
#include "ingest/model_builder/city_model_builder.hpp"
#include "ingest/palm/palm_driver_reader.hpp"

namespace farlod::ingest {
namespace {

constexpr const char* terrain_name = "zt";
constexpr const char* heights_name = "buildings_2d";
constexpr const char* cells_name = "buildings_3d";
constexpr const char* ids_name = "building_id";

/// Numbers of the cells, in the order of the file; NaN where there is none.
using CellValues = std::vector<double>;

/// A part of a column of air that a building fills, above the ground.
struct FilledRun {
  double bottom_m = 0.0, top_m = 0.0;
};

/// What the cells of a prism have in common.
using PrismKey = std::tuple<double, double, double>;  // building, bottom, top

/// Reads the variables of a static driver as arrays: GDAL's rasters of netCDF leave out its CRS and the order of its rows.
class PalmDriver {
 public:
  explicit PalmDriver(const InputFile& file) : name_(file.name) {
    file_ = open_within(file.is_named ? GdalReach::local_files : GdalReach::own_data, file.path, GDAL_OF_MULTIDIM_RASTER);
    if (file_) variables_ = file_->GetRootGroup();
    if (!variables_) throw InputError(name_ + " is a static driver of PALM that cannot be read: is it damaged?");
  }

  SourceCity read(Report& report) {
    lay_out();
    CityModelBuilder builder(name_, report);
    add_buildings(builder);
    return {.source = name_, .crs = {crs_, true, true}, .city = builder.take_city(), .relief_points = ground_points()};
  }

 private:
  using Array = std::shared_ptr<GDALMDArray>;

  [[nodiscard]] Array array(const char* name) const { return variables_->OpenMDArray(name); }
  [[nodiscard]] std::optional<double> attribute(const char* name) const {
    const auto found = variables_->GetAttribute(name);
    return found ? std::optional(found->ReadAsDouble()) : std::nullopt;
  }
  [[nodiscard]] double required(const char* name) const {
    if (const auto value = attribute(name)) return *value;
    throw InputError(name_ + " is a static driver of PALM without " + name + ": it does not say where it lies.");
  }

  /// All values of an array, in its order. Those that stand for no data are NaN, whether declared or not.
  [[nodiscard]] CellValues values_of(const GDALMDArray& variable) const {
    constexpr double no_number = 1e30;  // netCDF fills with 9.97e36
    std::vector<GUInt64> first(variable.GetDimensionCount(), 0);
    std::vector<std::size_t> counts;
    std::size_t all = 1;
    for (const auto& dimension : variable.GetDimensions()) all *= counts.emplace_back(dimension->GetSize());
    CellValues values(all);
    if (!variable.Read(first.data(), counts.data(), nullptr, nullptr, GDALExtendedDataType::Create(GDT_Float64), values.data()))
      refuse_raster(name_, "cannot be read to its end");
    bool is_declared = false, is_scaled = false, is_moved = false;
    const double no_data = variable.GetNoDataValueAsDouble(&is_declared);
    const double scale = variable.GetScale(&is_scaled), offset = variable.GetOffset(&is_moved);
    for (double& value : values) {
      const bool is_none = is_declared && value == no_data;
      value = (is_scaled ? scale : 1.0) * value + (is_moved ? offset : 0.0);
      // PALM's own number for no data lies beyond all depths
      if (is_none || !(std::abs(value) < no_number) || value == palm_no_data) value = none;
    }
    return values;
  }

  /// The values of cells: (y, x), or (z, y, x).
  [[nodiscard]] CellValues cells_of(const GDALMDArray& variable) const {
    const auto& dimensions = variable.GetDimensions();
    const std::size_t n = dimensions.size();
    if (n < 2 || dimensions[n - 1]->GetSize() != static_cast<GUInt64>(columns_) ||
        dimensions[n - 2]->GetSize() != static_cast<GUInt64>(rows_))
      throw InputError(name_ + ": its " + variable.GetName() + " has no value for each cell of y and x.");
    return values_of(variable);
  }

  /// Where an axis begins, and the length of its cells.
  struct Axis {
    double begin_m = 0.0, step_m = 1.0;
    int count = 0;
  };
  [[nodiscard]] Axis axis(const char* name) const {
    const Array found = array(name);
    const CellValues centres = found ? values_of(*found) : CellValues();
    if (centres.size() < 2) throw InputError(name_ + " is a static driver of PALM without a variable " + name + ".");
    const double step = (centres.back() - centres.front()) / static_cast<double>(centres.size() - 1);
    constexpr double tolerance = 0.01;  // of a cell: floats of large domains
    for (std::size_t k = 0; k < centres.size(); ++k)
      if (!(std::abs(centres[k] - centres.front() - static_cast<double>(k) * step) < tolerance * std::abs(step)))
        throw InputError(name_ + ": its cells along " + name + " are not regular.");
    return {centres.front() - 0.5 * step, step, static_cast<int>(centres.size())};
  }

  void lay_out() {
    x_ = axis("x");
    y_ = axis("y");
    columns_ = x_.count;
    rows_ = y_.count;
    const Array crs = array("crs");
    const auto code = crs ? crs->GetAttribute("epsg_code") : nullptr;
    const Array placed = array(array(terrain_name) ? terrain_name : heights_name);
    crs_ = code ? code->ReadAsString() : placed ? wkt_of(placed->GetSpatialRef().get()) : "";
    origin_ = {required("origin_x"), required("origin_y"), attribute("origin_z").value_or(0.0)};
    turn_ = Angle::degrees(attribute("rotation_angle").value_or(0.0));
  }

  /// Columns and rows are counted from the corner of the first cell.
  [[nodiscard]] Point2d place(double column, double row) const {
    const double x = x_.begin_m + column * x_.step_m, y = y_.begin_m + row * y_.step_m;
    return {origin_.x + x * cos(turn_) + y * sin(turn_), origin_.y - x * sin(turn_) + y * cos(turn_)};
  }

  std::vector<Point3d> ground_points() const {
    std::vector<Point3d> points;
    const Array terrain = array(terrain_name);
    if (!terrain) return points;
    const CellValues heights = cells_of(*terrain);
    for (std::size_t n = 0; n < heights.size(); ++n) {
      const auto [row, column] = std::div(static_cast<int>(n), columns_);
      const Point2d p = place(column + 0.5, row + 0.5);
      if (std::isfinite(heights[n])) points.push_back({p.x, p.y, origin_.z + heights[n]});
    }
    return points;
  }

  using Runs = std::vector<std::vector<FilledRun>>;  ///< of each cell, from the ground up

  [[nodiscard]] Runs runs_of_heights(const GDALMDArray& heights) const {
    Runs runs;
    for (const double height : cells_of(heights))
      runs.push_back(height > 0.0 ? std::vector<FilledRun>{{0.0, height}} : std::vector<FilledRun>());
    return runs;
  }

  /// Where the layers of cells begin and end: half-way between their centres. The lowest one begins on the ground.
  [[nodiscard]] std::vector<double> borders_of_layers() const {
    const Array z = array("z");
    const CellValues centres = z ? values_of(*z) : CellValues();
    if (centres.empty()) throw InputError(name_ + ": its buildings_3d has no heights z.");
    std::vector<double> borders{0.0};
    for (std::size_t n = 1; n < centres.size(); ++n) borders.push_back(0.5 * (centres[n - 1] + centres[n]));
    // PALM's first centre lies on the ground, and the second one half a cell above it: the first cell has no height
    if (centres.size() > 2 && centres[0] == 0.0) borders[1] = std::max(0.0, 1.5 * centres[1] - 0.5 * centres[2]);
    // The last layer is as high as the one below it
    borders.push_back(2.0 * centres.back() - borders.back());
    return borders;
  }

  [[nodiscard]] Runs runs_of_cells(const GDALMDArray& cells) const {
    const std::vector<double> borders = borders_of_layers();
    const CellValues filled = cells_of(cells);
    Runs runs(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
    if (filled.size() != runs.size() * (borders.size() - 1)) throw InputError(name_ + ": its buildings_3d is not of (z, y, x).");
    for (std::size_t n = 0; n < filled.size(); ++n) {
      const double bottom = borders[n / runs.size()], top = borders[n / runs.size() + 1];
      std::vector<FilledRun>& of_cell = runs[n % runs.size()];
      if (filled[n] != 1.0 || !(top > bottom)) continue;
      if (!of_cell.empty() && of_cell.back().top_m == bottom)
        of_cell.back().top_m = top;
      else
        of_cell.push_back({bottom, top});
    }
    return runs;
  }

  void add_buildings(CityModelBuilder& builder) {
    Runs runs;
    if (const Array cells = array(cells_name))
      runs = runs_of_cells(*cells);
    else if (const Array heights = array(heights_name))
      runs = runs_of_heights(*heights);
    const Array ids = array(ids_name);
    const CellValues building = ids ? cells_of(*ids) : CellValues(runs.size(), none);
    std::size_t most = 0;
    for (const auto& of_cell : runs) most = std::max(most, of_cell.size());
    for (std::size_t k = 0; k < most; ++k) outline(runs, building, k);
    for (auto& [id, prisms] : buildings_) add_building(builder, id, prisms);
  }

  struct Prism {
    Rings rings;
    FilledRun run;
  };

  /// Collects the outlines of the k-th runs.
  void outline(const Runs& runs, const CellValues& building, std::size_t k) {
    std::map<PrismKey, int> numbers;
    std::vector<PrismKey> keys{{}};
    std::vector<int> of_cell(runs.size(), 0);
    for (std::size_t n = 0; n < runs.size(); ++n) {
      if (runs[n].size() <= k) continue;
      const double id = std::isfinite(building[n]) ? building[n] : no_building;
      const PrismKey key{id, runs[n][k].bottom_m, runs[n][k].top_m};
      const auto [found, is_new] = numbers.try_emplace(key, static_cast<int>(keys.size()));
      if (is_new) keys.push_back(key);
      of_cell[n] = found->second;
    }
    for (auto& [number, rings] : polygons_of(of_cell)) {
      const auto [id, bottom_m, top_m] = keys[static_cast<std::size_t>(number)];
      const std::string name = id == no_building ? "cells " + std::to_string(++without_id_) : std::to_string(std::llround(id));
      buildings_[name].push_back({std::move(rings), {bottom_m, top_m}});
    }
  }

  /// The outlines of neighbouring cells of one number, but for 0.
  [[nodiscard]] std::vector<std::pair<int, Rings>> polygons_of(std::vector<int>& of_cell) const {
    GDALDriverManager& formats = *GetGDALDriverManager();
    const GDALDatasetUniquePtr raster(formats.GetDriverByName("MEM")->Create("", columns_, rows_, 1, GDT_Int32, nullptr));
    const GDALDatasetUniquePtr table(formats.GetDriverByName("Memory")->Create("", 0, 0, 0, GDT_Unknown, nullptr));
    OGRLayer* const layer = table->CreateLayer("outlines", nullptr, wkbPolygon, nullptr);
    OGRFieldDefn number("number", OFTInteger);
    GDALRasterBand* const band = raster->GetRasterBand(1);
    if (layer->CreateField(&number) != OGRERR_NONE ||
        band->RasterIO(GF_Write, 0, 0, columns_, rows_, of_cell.data(), columns_, rows_, GDT_Int32, 0, 0, nullptr) != CE_None ||
        GDALPolygonize(band, band, OGRLayer::ToHandle(layer), 0, nullptr, nullptr, nullptr) != CE_None)
      throw InputError(name_ + ": its buildings cannot be outlined.");
    std::vector<std::pair<int, Rings>> polygons;
    layer->ResetReading();
    for (Feature feature = next_feature(*layer); feature; feature = next_feature(*layer)) {
      Rings rings;
      for (const OGRLinearRing* line : *feature->GetGeometryRef()->toPolygon()) rings.push_back(ring_of(*line));
      polygons.emplace_back(feature->GetFieldAsInteger(0), std::move(rings));
    }
    return polygons;
  }

  [[nodiscard]] Ring ring_of(const OGRLinearRing& line) const {
    Ring ring;
    for (int k = 0; k < line.getNumPoints(); ++k) {
      // Without a place on the map, GDAL counts columns and rows
      const Point2d p = place(line.getX(k), line.getY(k));
      ring.push_back({p.x, p.y, 0.0});
    }
    return ring;
  }

  static void add_building(CityModelBuilder& builder, const std::string& id, std::vector<Prism>& prisms) {
    const bool stands = std::any_of(prisms.begin(), prisms.end(), [](const Prism& prism) { return prism.run.bottom_m == 0.0; });
    builder.begin_building(id, HeightReference::on_ground, stands ? Foot::on_ground : Foot::above_ground);
    for (std::size_t part = 0; part < prisms.size(); ++part)
      builder.add_prism(prisms[part].rings, RingEnd::repeats_first, prisms[part].run.bottom_m, prisms[part].run.top_m,
                        static_cast<std::uint16_t>(part));
    builder.end_building("none of its cells is usable");
  }

  static constexpr double none = std::numeric_limits<double>::quiet_NaN();
  static constexpr double palm_no_data = -9999.0;
  static constexpr double no_building = -std::numeric_limits<double>::infinity();

  std::string name_;
  GDALDatasetUniquePtr file_;
  std::shared_ptr<GDALGroup> variables_;
  Axis x_, y_;
  int columns_ = 0, rows_ = 0;
  std::string crs_;
  Point3d origin_;
  Angle turn_;
  std::map<std::string, std::vector<Prism>> buildings_;
  std::size_t without_id_ = 0;
};

}  // namespace

SourceCity read_palm_driver(const InputFile& file, Report& report) {
  const GdalErrors quiet;
  return PalmDriver(file).read(report);
}

}  // namespace farlod::ingest
