// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <vector>

#include "base/expects.hpp"
#include "results/netcdf_file.hpp"
#include "results/raster/raster_writer.hpp"
#include "results/table/feature_writer.hpp"

namespace farlod {
namespace {

constexpr std::size_t rows_at_once = 16384;
constexpr std::size_t characters_of_chunk = 16;

/// What the conventions want to be told of a column.
struct Meaning {
  std::string name, unit, text, standard_name;
};

const std::array<Meaning, 11>& meanings_of_places() {
  static const std::array<Meaning, 11> meanings{{{"x_m", "m", "easting", "projection_x_coordinate"},
                                                 {"y_m", "m", "northing", "projection_y_coordinate"},
                                                 {"z_m", "m", "height, as the package has it", ""},
                                                 {"height_above_ground_m", "m", "height above the ground", ""},
                                                 {"azimuth_deg", "degree", "where it faces, clockwise from true north", ""},
                                                 {"tilt_deg", "degree", "0 straight up, 90 of a wall", ""},
                                                 {"area_m2", "m2", "area that the receiver stands for", ""},
                                                 {"surface", "1", "number of the surface in its building", ""},
                                                 {"i", "1", "column of the cell in the grid", ""},
                                                 {"j", "1", "row of the cell in the grid", ""},
                                                 {"zone", "1", "number of the polygon in its file", ""}}};
  return meanings;
}

/// Names of the conventions' table, for columns that have one there; else empty.
std::string standard_name_of(const std::string& column) {
  if (column == "area_m2") return "cell_area";
  if (column == "vegetation_fraction") return "vegetation_area_fraction";
  return column.starts_with("z0_") ? "surface_roughness_length_for_momentum_in_air" : "";
}

bool is_coordinate(const std::string& name) { return name == "x_m" || name == "y_m" || name == "z_m"; }

std::vector<Band> bands_of(const AnswerColumns& columns) {
  std::vector<Band> bands =
      svf_bands(columns.quantity, columns.bounds == BoundsColumns::yes ? RasterBands::svf_and_bounds : RasterBands::svf);
  bands.insert(bands.end(), columns.further.begin(), columns.further.end());
  return bands;
}

/// The name of a variable: netCDF takes no slash.
std::string name_of_variable(std::string name) {
  std::ranges::replace(name, '/', '_');
  return name;
}

/// A column, and the rows of it that are not written yet.
struct Column {
  int variable = 0;
  FieldType type = FieldType::text;
  std::vector<double> numbers = {};
  std::vector<std::int64_t> whole_numbers = {};
  std::vector<std::string> texts = {};

  void add(const FieldValue& value) {
    if (type == FieldType::real) {
      const auto* number = std::get_if<double>(&value);
      numbers.push_back(number != nullptr ? *number : std::numeric_limits<double>::quiet_NaN());
    } else if (type == FieldType::whole) {
      const auto* number = std::get_if<std::int64_t>(&value);
      whole_numbers.push_back(number != nullptr ? *number : NetcdfFile::no_whole);
    } else {
      const auto* text = std::get_if<std::string_view>(&value);
      texts.emplace_back(text != nullptr ? *text : std::string_view());
    }
  }
  void put(NetcdfFile& file, std::size_t first_row, std::size_t rows) {
    if (type == FieldType::real) file.put(variable, std::array{first_row}, std::array{rows}, numbers);
    if (type == FieldType::whole) file.put(variable, std::array{first_row}, std::array{rows}, whole_numbers);
    if (type == FieldType::text) put_texts(file, first_row, rows);
    numbers.clear();
    whole_numbers.clear();
    texts.clear();
  }

 private:
  void put_texts(NetcdfFile& file, std::size_t first_row, std::size_t rows) const {
    std::size_t longest = 1;
    for (const std::string& text : texts) longest = std::max(longest, text.size());
    std::vector<char> characters(rows * longest, '\0');
    for (std::size_t n = 0; n < rows; ++n)
      std::ranges::copy(texts[n], characters.begin() + static_cast<std::ptrdiff_t>(n * longest));
    file.put(variable, std::array{first_row, std::size_t{0}}, std::array{rows, longest}, characters);
  }
};

class CfPointWriter final : public FeatureWriter {
 public:
  CfPointWriter(const TableFrame& frame, const std::filesystem::path& path) : frame_(frame), file_(path) {}

  void begin(const FeatureLayer& layer) override {
    FARLOD_EXPECTS(columns_.empty() && (layer.geometry == LayerGeometry::points || is_level(layer.geometry)));
    if (is_level(layer.geometry)) coordinates_ = "x_m y_m";
    file_.describe(layer.description, frame_.provenance);
    file_.attribute(NetcdfFile::whole_file, "featureType", "point");
    const int point = file_.dimension("point", NetcdfFile::unlimited);
    if (!frame_.crs_wkt.empty()) (void)file_.crs(frame_.crs_wkt, frame_.epsg);
    const std::vector<Band> bands = bands_of(frame_.columns);
    for (const FeatureField& field : layer.fields) {
      columns_.push_back(column_of(field, point));
      describe(columns_.back().variable, field, bands);
    }
    file_.end_definitions();
  }
  void add(const FeatureRow& row) override {
    FARLOD_EXPECTS(row.values.size() == columns_.size());
    for (std::size_t n = 0; n < row.values.size(); ++n) columns_[n].add(row.values[n]);
    if (++waiting_ == rows_at_once) put_rows();
  }
  void commit() override {
    put_rows();
    file_.commit();
  }

 private:
  Column column_of(const FeatureField& field, int point) {
    const std::string name = name_of_variable(field.name);
    if (field.type != FieldType::text) {
      const NetcdfType type = field.type == FieldType::whole ? NetcdfType::whole : NetcdfType::real;
      const int variable = file_.variable(name, type, std::array{point});
      file_.compress(variable, std::array{rows_at_once});
      if (name != "x_m" && name != "y_m") file_.declare_missing(variable);
      return {variable, field.type};
    }
    // As many characters as the longest text turns out to have
    const int characters = file_.dimension(name + "_length", NetcdfFile::unlimited);
    const int variable = file_.variable(name, NetcdfType::text, std::array{point, characters});
    file_.compress(variable, std::array{rows_at_once, characters_of_chunk});
    file_.attribute(variable, "_Encoding", "utf-8");
    return {variable, field.type};
  }
  void describe(int variable, const FeatureField& field, const std::vector<Band>& bands) {
    const auto& places = meanings_of_places();
    // The area of a cell is not that of a receiver, whose column has the same name
    if (const auto band = std::ranges::find(bands, field.name, &Band::name); band != bands.end())
      describe(variable, {field.name, band->unit, band->definition, standard_name_of(field.name)});
    else if (const auto place = std::ranges::find(places, field.name, &Meaning::name); place != places.end())
      describe(variable, *place);
    if (is_coordinate(field.name)) return;
    file_.attribute(variable, "coordinates", coordinates_);
    if (!frame_.crs_wkt.empty()) file_.attribute(variable, "grid_mapping", "crs");
  }
  void describe(int variable, const Meaning& meaning) {
    file_.attribute(variable, "units", meaning.unit);
    file_.attribute(variable, "long_name", meaning.text);
    if (!meaning.standard_name.empty()) file_.attribute(variable, "standard_name", meaning.standard_name);
    if (meaning.name == "z_m") file_.attribute(variable, "positive", "up");
  }
  void put_rows() {
    for (Column& column : columns_)
      if (waiting_ > 0) column.put(file_, written_, waiting_);
    written_ += waiting_;
    waiting_ = 0;
  }

  TableFrame frame_;
  NetcdfFile file_;
  std::vector<Column> columns_;
  std::string coordinates_ = "x_m y_m z_m";
  std::size_t written_ = 0, waiting_ = 0;
};

}  // namespace

std::unique_ptr<FeatureWriter> netcdf_point_writer(const TableFrame& frame, const std::filesystem::path& path) {
  return std::make_unique<CfPointWriter>(frame, path);
}

}  // namespace farlod
