// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "results/spool_file.hpp"
#include "results/table/feature_writer.hpp"
#include "results/table/surface_shapes.hpp"
#include "results/table/table_writer.hpp"

namespace farlod {

// The tables as layers of features. Names, order and digits of the columns are those of CSV. A place has a height where the
// receiver has one. All functions throw OutputError.

/// The layer `points`. A field of the user's points is of numbers where all of its values are, as type_of_column() says.
void write_points_as_features(const PointRows& rows, const TableFrame& frame, FeatureWriter& writer);

/// The layer `receivers`, of all rows in the spool file.
void write_receivers_as_features(SurfaceSpool& receivers, const TableFrame& frame, FeatureWriter& writer);

/// The layers `surfaces`, of polygons where there are shapes of them, and `buildings`, without geometry.
void write_surfaces_as_features(std::span<const SurfaceMean> rows, const TableFrame& frame, SurfaceShapes* shapes,
                                FeatureWriter& writer);
void write_buildings_as_features(std::span<const BuildingMean> rows, const TableFrame& frame, FeatureWriter& writer);

/// What a column of the user's points holds: whole numbers, numbers, or text, where one value is neither. Empty fields decide
/// nothing; a column without values is text. Numbers with zeros before them (`007`), with a plus, or of more digits than fit
/// are text: a number would not come back as it was.
[[nodiscard]] FieldType type_of_column(const Attributes& attributes, std::size_t column, std::size_t rows);
/// A field of such a column; none where it is empty.
[[nodiscard]] FieldValue attribute_value(std::string_view text, FieldType type);

/// The three tables of surfaces as layers of one file.
class SurfaceTablesInLayers : public SurfaceTablesWriter {
 public:
  SurfaceTablesInLayers(const TableFrame& frame, const std::filesystem::path& path, std::unique_ptr<FeatureWriter> writer)
      : frame_(frame), path_(path), writer_(std::move(writer)), receivers_(path) {}
  void write_part(std::size_t part, std::span<const SurfacePoint> rows) override { receivers_.add(part, rows); }
  [[nodiscard]] std::vector<std::filesystem::path> commit(std::span<const SurfaceMean> surfaces,
                                                          std::span<const BuildingMean> buildings) override;

 private:
  TableFrame frame_;
  std::filesystem::path path_;
  std::unique_ptr<FeatureWriter> writer_;
  SurfaceSpool receivers_;
};

/// For formats of one layer a file: the receivers in it, the surfaces as OUT.surfaces.fgb, or as CSV where no package has shapes
/// of them, and the buildings, which have no places, as OUT.buildings.csv.
class SurfaceTablesInFiles : public SurfaceTablesWriter {
 public:
  using MakeWriter = std::unique_ptr<FeatureWriter> (*)(const TableFrame& frame, const std::filesystem::path& path);

  SurfaceTablesInFiles(const TableFrame& frame, const std::filesystem::path& path, MakeWriter make_writer)
      : frame_(frame), path_(path), make_writer_(make_writer), receivers_(path) {}
  void write_part(std::size_t part, std::span<const SurfacePoint> rows) override { receivers_.add(part, rows); }
  [[nodiscard]] std::vector<std::filesystem::path> commit(std::span<const SurfaceMean> surfaces,
                                                          std::span<const BuildingMean> buildings) override;

 private:
  TableFrame frame_;
  std::filesystem::path path_;
  MakeWriter make_writer_;
  SurfaceSpool receivers_;
};

/// For formats of points: the receivers in it, the other two tables as OUT.surfaces.csv and
/// OUT.buildings.csv.
class SurfaceTablesBesideCsv : public SurfaceTablesWriter {
 public:
  /// Writes the file of the receivers.
  using WriteReceivers = std::function<void(SurfaceSpool& receivers)>;

  SurfaceTablesBesideCsv(const TableFrame& frame, const std::filesystem::path& path, WriteReceivers write)
      : frame_(frame), path_(path), write_(std::move(write)), receivers_(path) {}
  void write_part(std::size_t part, std::span<const SurfacePoint> rows) override { receivers_.add(part, rows); }
  [[nodiscard]] std::vector<std::filesystem::path> commit(std::span<const SurfaceMean> surfaces,
                                                          std::span<const BuildingMean> buildings) override;

 private:
  TableFrame frame_;
  std::filesystem::path path_;
  WriteReceivers write_;
  SurfaceSpool receivers_;
};

}  // namespace farlod
