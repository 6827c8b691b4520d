// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "gdal/vector_file_gdal.hpp"

#include <array>
#include <sstream>

#include "base/lower_case.hpp"
#include "gdal/local_data_gdal.hpp"
#include "gdal/registered_formats_gdal.hpp"

namespace farlod {
namespace {

bool lists(const char* endings, const std::string& ending) {
  std::istringstream list(endings == nullptr ? "" : endings);
  for (std::string one; list >> one;)
    if (EQUAL(one.c_str(), ending.c_str())) return true;
  return false;
}

}  // namespace

GDALDatasetUniquePtr open_vector_file(const std::filesystem::path& file) {
  return open_within(GdalReach::local_files, file, GDAL_OF_VECTOR);
}

bool is_table(const std::filesystem::path& file) {
  const std::string ending = lower_case(file.extension().string());
  return ending == ".csv" || ending == ".tsv" || ending == ".txt";
}

GDALDatasetUniquePtr open_vector_file_or_table(const std::filesystem::path& file) {
  if (!is_table(file)) return open_vector_file(file);
  (void)registered_formats();
  constexpr std::array<const char*, 2> table_driver{"CSV", nullptr};
  const std::string name = "CSV:" + file.string();  // the prefix lets GDAL take any ending
  return GDALDatasetUniquePtr(GDALDataset::Open(name.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY, table_driver.data()));
}

std::vector<std::string> field_names(OGRLayer& layer) {
  std::vector<std::string> names;
  OGRFeatureDefn& fields = *layer.GetLayerDefn();
  for (int n = 0; n < fields.GetFieldCount(); ++n) names.emplace_back(fields.GetFieldDefn(n)->GetNameRef());
  return names;
}

bool has_vector_ending(const std::filesystem::path& file) {
  const std::string ending = file.extension().string();
  if (ending.size() < 2) return false;
  for (int n = 0; n < registered_formats().GetDriverCount(); ++n) {
    GDALDriver& driver = *registered_formats().GetDriver(n);
    if (driver.GetMetadataItem(GDAL_DCAP_VECTOR) != nullptr &&
        lists(driver.GetMetadataItem(GDAL_DMD_EXTENSIONS), ending.substr(1)))
      return true;
  }
  return false;
}

}  // namespace farlod
