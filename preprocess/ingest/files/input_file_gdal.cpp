// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cpl_conv.h>
#include <cpl_vsi.h>
#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <algorithm>
#include <array>
#include <system_error>
#include <utility>

#include "farlod/error.hpp"
#include "gdal/gdal_errors.hpp"
#include "gdal/local_data_gdal.hpp"
#include "gdal/raster_layers_gdal.hpp"
#include "ingest/files/file_format.hpp"
#include "ingest/files/input_file.hpp"
#include "ingest/files/input_search.hpp"

namespace farlod::ingest {
namespace {

GdalReach reach_of(const InputFile& file) { return file.is_named ? GdalReach::local_files : GdalReach::own_data; }

/// Has a raster of several, or one that has a place.
bool lies_on_the_map(const InputFile& file) {
  const GDALDatasetUniquePtr raster = open_within(reach_of(file), file.path, GDAL_OF_RASTER);
  std::array<double, 6> transform{};
  if (raster && raster->GetRasterCount() == 0) return !raster_layers(*raster).empty();
  return raster && raster->GetGeoTransform(transform.data()) == CE_None;
}

bool has_raster(const InputFile& file, const std::string& name) {
  const GDALDatasetUniquePtr raster = open_within(reach_of(file), file.path, GDAL_OF_RASTER);
  return raster && has_raster_layer(*raster, name);
}

/// Some formats hold features and rasters. Tables without geometries, such as the variables of one dimension in netCDF, are no
/// features of a city.
bool holds_features(const InputFile& file, const std::optional<std::string>& layer) {
  if (!is_known_within(reach_of(file), file.path, GDAL_OF_RASTER)) return true;
  const GDALDatasetUniquePtr dataset = open_within(reach_of(file), file.path, GDAL_OF_VECTOR);
  if (!dataset || (layer && dataset->GetLayerByName(layer->c_str()) == nullptr && has_raster(file, *layer))) return false;
  for (OGRLayer* one : dataset->GetLayers())
    if (one->GetGeomType() != wkbNone) return true;
  return false;
}

}  // namespace

MapKind map_kind_of(const InputFile& file, const std::optional<std::string>& layer) {
  const GdalErrors quiet;
  const GdalReach reach = reach_of(file);
  if (is_known_within(reach, file.path, GDAL_OF_VECTOR) && holds_features(file, layer)) return MapKind::features;
  if (is_known_within(reach, file.path, GDAL_OF_RASTER))
    return lies_on_the_map(file) ? MapKind::raster : MapKind::placeless_raster;
  const bool is_for_a_name =
      !file.is_named && is_known_within(GdalReach::local_files, file.path, GDAL_OF_RASTER | GDAL_OF_VECTOR);
  return is_for_a_name ? MapKind::only_by_name : MapKind::unknown;
}

bool is_palm_driver(const InputFile& file) {
  constexpr std::size_t mark_bytes = 4;
  const std::string beginning = read_beginning(file, mark_bytes);
  if (!beginning.starts_with("CDF") && beginning != "\x89HDF") return false;
  const GdalErrors quiet;
  const GDALDatasetUniquePtr netcdf = open_within(reach_of(file), file.path, GDAL_OF_MULTIDIM_RASTER);
  const auto variables = netcdf ? netcdf->GetRootGroup() : nullptr;
  if (!variables || !variables->GetAttribute("origin_x")) return false;
  return variables->OpenMDArray("zt") || variables->OpenMDArray("buildings_2d") || variables->OpenMDArray("buildings_3d");
}

namespace {

namespace fs = std::filesystem;

/// GDAL searches its list of members for each one. With more members, the searches take longer than the reading.
constexpr std::size_t most_members = 100'000;

struct CloseFolder {
  void operator()(VSIDIR* folder) const { VSICloseDir(folder); }
};

std::unique_ptr<VSIDIR, CloseFolder> open_archive(const fs::path& archive, const std::string& gdal_name) {
  std::unique_ptr<VSIDIR, CloseFolder> folder(VSIOpenDir(gdal_name.c_str(), -1, nullptr));
  if (folder) return folder;
  throw InputError(archive.string() + " is a zip archive that cannot be read: it is empty, damaged, or was cut short.");
}

void require_city_size(const fs::path& archive, std::size_t members, std::uintmax_t unpacked_bytes) {
  if (members > most_members)
    throw InputError(archive.string() + " holds more than " + std::to_string(most_members) +
                     " files: unpack it, and give the folder instead.");
  if (unpacked_bytes > most_unpacked_bytes(fs::file_size(archive)))
    throw InputError(archive.string() + " claims to unpack to " + std::to_string(unpacked_bytes >> 20) +
                     " MiB, more than a hundred times its size: that is no city. Unpack it yourself if you trust it.");
}

std::vector<InputFile> list(const fs::path& archive) {
  const std::string gdal_name = "/vsizip/{" + fs::absolute(archive).lexically_normal().string() + "}";
  const auto folder = open_archive(archive, gdal_name);
  std::vector<InputFile> files;
  std::uintmax_t unpacked_bytes = 0;
  while (const VSIDIREntry* entry = VSIGetNextDirEntry(folder.get())) {
    if (VSI_ISDIR(entry->nMode)) continue;
    // The limit keeps the sum from overflowing: a declared size may be any number
    unpacked_bytes += std::min<std::uintmax_t>(entry->nSize, std::uintmax_t{1} << 46);
    require_city_size(archive, files.size(), unpacked_bytes);
    files.emplace_back((archive / printable(entry->pszName)).string(), fs::path(gdal_name) / entry->pszName, archive);
    files.back().declared_bytes = entry->nSize;
  }
  return files;
}

}  // namespace

std::vector<InputFile> files_in_zip(const fs::path& archive) {
  const GdalErrors quiet;
  std::vector<InputFile> files = list(archive);
  std::sort(files.begin(), files.end(), [](const InputFile& a, const InputFile& b) { return a.name < b.name; });
  return files;
}

namespace {

struct CloseFile {
  void operator()(VSILFILE* file) const { VSIFCloseL(file); }
};
using PackedFile = std::unique_ptr<VSILFILE, CloseFile>;

/// Unpacks a file while it is read, and counts the bytes: they may neither exceed the limit nor end before the declared size.
class UnpackingBuffer : public std::streambuf {
 public:
  UnpackingBuffer(PackedFile packed, const InputFile& file)
      : file_(std::move(packed)), name_(file.name), declared_bytes_(file.declared_bytes) {
    std::error_code unknown;
    const std::uintmax_t packed_bytes = std::filesystem::file_size(file.on_disk, unknown);
    most_bytes_ = most_unpacked_bytes(unknown ? 0 : packed_bytes);
  }

 protected:
  int_type underflow() override {
    const GdalErrors errors;
    const std::size_t count = VSIFReadL(piece_.data(), 1, piece_.size(), file_.get());
    read_bytes_ += count;
    if (read_bytes_ > most_bytes_)
      throw InputError(name_ + " unpacks to more than " + std::to_string(most_bytes_ >> 20) +
                       " MiB, a hundred times its size: that is no city. Unpack it yourself if you trust it.");
    if (count == 0) require_end(errors);
    setg(piece_.data(), piece_.data(), piece_.data() + count);
    return count == 0 ? traits_type::eof() : traits_type::to_int_type(piece_[0]);
  }

 private:
  void require_end(const GdalErrors& errors) const {
    if (!errors.any() && (!declared_bytes_ || read_bytes_ == *declared_bytes_)) return;
    throw InputError(name_ + " cannot be unpacked beyond " + std::to_string(read_bytes_) +
                     " bytes: the archive is damaged, cut short or locked by a password.");
  }

  PackedFile file_;
  std::string name_;
  std::uintmax_t read_bytes_ = 0, most_bytes_ = 0;
  std::optional<std::uintmax_t> declared_bytes_;
  std::array<char, std::size_t{1} << 16> piece_;
};

/// Rethrows the exceptions of its buffer. Without `badbit`, a stream treats them as the end of the file.
class UnpackingStream : public std::istream {
 public:
  UnpackingStream(PackedFile packed, const InputFile& file) : std::istream(nullptr), buffer_(std::move(packed), file) {
    rdbuf(&buffer_);
    exceptions(std::ios::badbit);
  }

 private:
  UnpackingBuffer buffer_;
};

std::unique_ptr<std::istream> try_to_open(const InputFile& file) {
  if (!file.is_packed()) {
    auto stream = std::make_unique<std::ifstream>(file.path, std::ios::binary);
    return *stream ? std::move(stream) : nullptr;
  }
  const GdalErrors quiet;
  // GDAL would otherwise write a file with the properties of a .gz beside it
  CPLSetConfigOption("CPL_VSIL_GZIP_WRITE_PROPERTIES", "NO");
  PackedFile packed(VSIFOpenL(file.path.c_str(), "rb"));
  return packed ? std::make_unique<UnpackingStream>(std::move(packed), file) : nullptr;
}

}  // namespace

std::unique_ptr<std::istream> open_input(const InputFile& file) {
  if (file.pipe) return file.pipe->take_all();
  if (auto stream = try_to_open(file)) return stream;
  if (file.is_packed())
    throw InputError(file.name + " cannot be unpacked: the archive is damaged, or packed in a way that is not known.");
  throw InputError(file.name + " cannot be opened. Check its permissions.");
}

std::optional<std::string> find_beginning(const InputFile& file, std::size_t most_bytes) {
  std::error_code error;
  if (!file.is_packed() && !std::filesystem::is_regular_file(file.path, error)) return std::nullopt;
  if (!try_to_open(file)) return std::nullopt;
  return read_beginning(file, most_bytes);
}

}  // namespace farlod::ingest
