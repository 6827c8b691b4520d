// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <netcdf.h>

#include <functional>
#include <limits>
#include <numeric>

#include "farlod/error.hpp"
#include "results/crs_gdal.hpp"
#include "results/netcdf_file.hpp"

namespace farlod {
namespace {

constexpr int compression_level = 2;  // 4 is 1 % smaller, and takes half as long again
constexpr std::size_t prime_slots = 7;

nc_type type_of(NetcdfType type) {
  switch (type) {
    case NetcdfType::text:
      return NC_CHAR;
    case NetcdfType::whole:
      return NC_INT64;
    case NetcdfType::single_real:
      return NC_FLOAT;
    case NetcdfType::real:
      return NC_DOUBLE;
    case NetcdfType::nothing:
      break;
  }
  return NC_INT;
}

std::size_t bytes_of(nc_type type) { return type == NC_CHAR ? 1 : type == NC_FLOAT ? 4 : 8; }

}  // namespace

NetcdfFile::NetcdfFile(const std::filesystem::path& path) : file_(path) {
  must(nc_create(file_.temporary().c_str(), NC_NETCDF4 | NC_CLOBBER, &id_));
  is_open_ = true;
  // All values are written, or are the fill value of a chunk that never came
  must(nc_set_fill(id_, NC_FILL, nullptr));
}

NetcdfFile::~NetcdfFile() {
  if (is_open_) nc_abort(id_);
}

void NetcdfFile::must(int status) const {
  if (status != NC_NOERR) throw OutputError(file_.destination(), nc_strerror(status));
}

void NetcdfFile::describe(const std::string& title, const Provenance& provenance) {
  attribute(whole_file, "Conventions", "CF-1.8");
  attribute(whole_file, "title", title);
  for (const auto& [name, value] : entries_of(provenance)) attribute(whole_file, name == "software" ? "source" : name, value);
}

int NetcdfFile::dimension(const std::string& name, std::size_t length) {
  static_assert(unlimited == NC_UNLIMITED);
  int dimension = 0;
  must(nc_def_dim(id_, name.c_str(), length, &dimension));
  return dimension;
}

int NetcdfFile::variable(const std::string& name, NetcdfType type, std::span<const int> dimensions) {
  int variable = 0;
  must(nc_def_var(id_, name.c_str(), type_of(type), static_cast<int>(dimensions.size()), dimensions.data(), &variable));
  return variable;
}

void NetcdfFile::declare_missing(int variable) {
  nc_type type = NC_NAT;
  must(nc_inq_vartype(id_, variable, &type));
  constexpr float none = std::numeric_limits<float>::quiet_NaN();
  constexpr double none_real = std::numeric_limits<double>::quiet_NaN();
  constexpr std::int64_t none_whole = no_whole;
  if (type == NC_FLOAT) must(nc_def_var_fill(id_, variable, NC_FILL, &none));
  if (type == NC_DOUBLE) must(nc_def_var_fill(id_, variable, NC_FILL, &none_real));
  if (type == NC_INT64) must(nc_def_var_fill(id_, variable, NC_FILL, &none_whole));
}

void NetcdfFile::compress(int variable, std::span<const std::size_t> chunk) {
  nc_type type = NC_NAT;
  must(nc_inq_vartype(id_, variable, &type));
  const std::size_t bytes = std::accumulate(chunk.begin(), chunk.end(), bytes_of(type), std::multiplies<>());
  must(nc_def_var_chunking(id_, variable, NC_CHUNKED, chunk.data()));
  must(nc_def_var_deflate(id_, variable, NC_SHUFFLE, 1, compression_level));
  must(nc_set_var_chunk_cache(id_, variable, bytes, prime_slots, 1.0F));
}

void NetcdfFile::attribute(int variable, const std::string& name, const std::string& text) {
  static_assert(whole_file == NC_GLOBAL);
  must(nc_put_att_text(id_, variable, name.c_str(), text.size(), text.data()));
}

void NetcdfFile::attribute(int variable, const std::string& name, std::span<const double> numbers) {
  must(nc_put_att_double(id_, variable, name.c_str(), NC_DOUBLE, numbers.size(), numbers.data()));
}

int NetcdfFile::crs(const std::string& wkt, std::optional<int> epsg) {
  const CfGridMapping mapping = cf_grid_mapping_of(wkt, epsg);
  const int crs = variable("crs", NetcdfType::nothing, {});
  if (!mapping.name.empty()) attribute(crs, "grid_mapping_name", mapping.name);
  for (const auto& [name, values] : mapping.parameters) attribute(crs, name, values);
  attribute(crs, "crs_wkt", wkt);
  attribute(crs, "spatial_ref", wkt);  // that of GDAL, whose older versions do not know crs_wkt
  return crs;
}

void NetcdfFile::end_definitions() { must(nc_enddef(id_)); }

void NetcdfFile::put(int variable, Extent first, Extent size, std::span<const float> values) {
  must(nc_put_vara_float(id_, variable, first.data(), size.data(), values.data()));
}
void NetcdfFile::put(int variable, Extent first, Extent size, std::span<const double> values) {
  must(nc_put_vara_double(id_, variable, first.data(), size.data(), values.data()));
}
void NetcdfFile::put(int variable, Extent first, Extent size, std::span<const std::int64_t> values) {
  must(nc_put_vara(id_, variable, first.data(), size.data(), values.data()));
}
void NetcdfFile::put(int variable, Extent first, Extent size, std::span<const char> values) {
  must(nc_put_vara_text(id_, variable, first.data(), size.data(), values.data()));
}

void NetcdfFile::commit() {
  is_open_ = false;
  must(nc_close(id_));
  file_.commit();
}

}  // namespace farlod
