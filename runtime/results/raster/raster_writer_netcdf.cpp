// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/raster/raster_writer_netcdf.hpp"

#include <netcdf.h>

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "contract/expects.hpp"
#include "farlod/error.hpp"
#include "results/atomic_file.hpp"
#include "results/decimal.hpp"
#include "results/raster/cf_grid_mapping_gdal.hpp"

namespace farlod {
namespace {

constexpr int compression_level = 2;  // 4 is 1 % smaller, and takes half as long again
constexpr std::size_t chunk_bytes = raster_tile_edge * raster_tile_edge * sizeof(float);
constexpr std::size_t prime_slots = 7;
constexpr std::size_t library_bytes = 1 << 20;  // what HDF5 keeps of a file besides, such as the index of its chunks

/// A file that is being written. All functions throw OutputError, which names the result.
class File {
 public:
  explicit File(const AtomicFile& file) : destination_(file.destination()) {
    must(nc_create(file.temporary().c_str(), NC_NETCDF4 | NC_CLOBBER, &id_));
    is_open_ = true;
    // All values are written, or are the fill value of a chunk that never came
    must(nc_set_fill(id_, NC_FILL, nullptr));
  }
  ~File() {
    if (is_open_) nc_abort(id_);
  }
  File(const File&) = delete;
  File& operator=(const File&) = delete;

  void close() {
    is_open_ = false;
    must(nc_close(id_));
  }
  [[nodiscard]] int dimension(const char* name, std::size_t length) {
    int dimension = 0;
    must(nc_def_dim(id_, name, length, &dimension));
    return dimension;
  }
  [[nodiscard]] int variable(const std::string& name, nc_type type, std::span<const int> dimensions) {
    int variable = 0;
    must(nc_def_var(id_, name.c_str(), type, static_cast<int>(dimensions.size()), dimensions.data(), &variable));
    return variable;
  }
  void attribute(int variable, const std::string& name, const std::string& text) {
    must(nc_put_att_text(id_, variable, name.c_str(), text.size(), text.data()));
  }
  void attribute(int variable, const std::string& name, std::span<const double> numbers) {
    must(nc_put_att_double(id_, variable, name.c_str(), NC_DOUBLE, numbers.size(), numbers.data()));
  }
  void must(int status) const {
    if (status != NC_NOERR) throw OutputError(destination_, nc_strerror(status));
  }
  [[nodiscard]] int id() const { return id_; }

 private:
  std::filesystem::path destination_;
  int id_ = 0;
  bool is_open_ = false;
};

void add_axis(File& file, int dimension, const char* name, const char* axis) {
  const int variable = file.variable(name, NC_DOUBLE, std::array{dimension});
  file.attribute(variable, "standard_name", std::string("projection_") + name + "_coordinate");
  file.attribute(variable, "long_name",
                 axis == std::string("X") ? "easting of the pixel's centre" : "northing of the pixel's centre");
  file.attribute(variable, "units", "m");
  file.attribute(variable, "axis", axis);
}

void add_grid_mapping(File& file, const RasterFrame& raster) {
  const CfGridMapping mapping = cf_grid_mapping_of(raster.crs_wkt, raster.epsg);
  const int crs = file.variable("crs", NC_INT, {});
  if (!mapping.name.empty()) file.attribute(crs, "grid_mapping_name", mapping.name);
  for (const auto& [name, values] : mapping.parameters) file.attribute(crs, name, values);
  file.attribute(crs, "crs_wkt", raster.crs_wkt);
  // Those of GDAL, which knows neither the corner of the first pixel nor, in older versions, crs_wkt
  file.attribute(crs, "spatial_ref", raster.crs_wkt);
  const double step = raster.step_m;
  file.attribute(crs, "GeoTransform",
                 shortest_decimal(raster.north_west_m.x) + " " + shortest_decimal(step) + " 0 " +
                     shortest_decimal(raster.north_west_m.y) + " 0 " + shortest_decimal(-step));
}

int add_band(File& file, const Band& band, std::array<int, 2> dimensions, const RasterFrame& raster) {
  const int variable = file.variable(band.name, NC_FLOAT, dimensions);
  const std::array<std::size_t, 2> chunk{std::min(raster_tile_edge, raster.rows), std::min(raster_tile_edge, raster.columns)};
  const float none = std::numeric_limits<float>::quiet_NaN();
  file.must(nc_def_var_chunking(file.id(), variable, NC_CHUNKED, chunk.data()));
  file.must(nc_def_var_deflate(file.id(), variable, NC_SHUFFLE, 1, compression_level));
  file.must(nc_def_var_fill(file.id(), variable, NC_FILL, &none));
  // A chunk comes as a whole, and never again
  file.must(nc_set_var_chunk_cache(file.id(), variable, chunk_bytes, prime_slots, 1.0F));
  file.attribute(variable, "long_name", band.definition);
  file.attribute(variable, "units", band.unit);
  if (!raster.crs_wkt.empty()) file.attribute(variable, "grid_mapping", "crs");
  return variable;
}

/// Some thousand numbers at a time.
void write_axis(File& file, const char* name, std::size_t count, double first, double step) {
  constexpr std::size_t at_once = 4096;
  int variable = 0;
  file.must(nc_inq_varid(file.id(), name, &variable));
  std::vector<double> centres;
  for (std::size_t begin = 0; begin < count; begin += at_once) {
    centres.clear();
    for (std::size_t n = begin; n < std::min(begin + at_once, count); ++n)
      centres.push_back(first + (static_cast<double>(n) + 0.5) * step);
    const std::size_t length = centres.size();
    file.must(nc_put_vara_double(file.id(), variable, &begin, &length, centres.data()));
  }
}

}  // namespace

struct NetcdfWriter::Impl {
  RasterFrame frame;
  AtomicFile destination;
  File file;
  std::vector<int> bands;  ///< the variables

  Impl(const RasterFrame& raster, const std::filesystem::path& path) : frame(raster), destination(path), file(destination) {}

  void describe() {
    file.attribute(NC_GLOBAL, "Conventions", "CF-1.8");
    file.attribute(NC_GLOBAL, "title", frame.bands.front().definition);
    for (const auto& [name, value] : entries_of(frame.provenance))
      file.attribute(NC_GLOBAL, name == "software" ? "source" : name, value);
  }
};

NetcdfWriter::NetcdfWriter(const RasterFrame& frame, const std::filesystem::path& path)
    : impl_(std::make_unique<Impl>(frame, path)) {
  File& file = impl_->file;
  impl_->describe();
  const int y = file.dimension("y", frame.rows), x = file.dimension("x", frame.columns);
  add_axis(file, y, "y", "Y");
  add_axis(file, x, "x", "X");
  if (!frame.crs_wkt.empty()) add_grid_mapping(file, frame);
  for (const Band& band : frame.bands) impl_->bands.push_back(add_band(file, band, {y, x}, frame));
  file.must(nc_enddef(file.id()));
  write_axis(file, "y", frame.rows, frame.north_west_m.y, -frame.step_m);
  write_axis(file, "x", frame.columns, frame.north_west_m.x, frame.step_m);
}

NetcdfWriter::~NetcdfWriter() = default;

void NetcdfWriter::write(const RasterTile& tile) {
  const std::vector<std::span<const float>> bands = bands_of(tile);
  FARLOD_EXPECTS(bands.size() == impl_->bands.size());
  const std::array<std::size_t, 2> first{tile.place.row * raster_tile_edge, tile.place.column * raster_tile_edge};
  const std::array<std::size_t, 2> size{pixels_of_tile(tile.place.row, impl_->frame.rows),
                                        pixels_of_tile(tile.place.column, impl_->frame.columns)};
  std::vector<float> inside(size[0] * size[1]);
  for (std::size_t n = 0; n < bands.size(); ++n) {
    for (std::size_t row = 0; row < size[0]; ++row)
      std::copy_n(bands[n].data() + row * raster_tile_edge, size[1], inside.data() + row * size[1]);
    impl_->file.must(nc_put_vara_float(impl_->file.id(), impl_->bands[n], first.data(), size.data(), inside.data()));
  }
}

std::uint64_t NetcdfWriter::bytes_for(const RasterFrame& frame) {
  // A chunk in the cache of each variable; one as it is filtered, and the pixels of a tile that lie inside
  return (frame.bands.size() + 3) * chunk_bytes + library_bytes;
}

void NetcdfWriter::commit() {
  impl_->file.close();  // a full disk may show only now
  impl_->destination.commit();
}

}  // namespace farlod
