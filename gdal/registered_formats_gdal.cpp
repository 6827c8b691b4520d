// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "gdal/registered_formats_gdal.hpp"

#include <cpl_conv.h>
#include <dlfcn.h>

#include <filesystem>
#include <mutex>
#include <system_error>

namespace farlod {
namespace {

/// The folder that GDAL itself lies in; empty where it is linked into the program.
std::filesystem::path folder_of_gdal() {
  Dl_info info{};
  if (dladdr(reinterpret_cast<const void*>(&GDALAllRegister), &info) == 0 || info.dli_fname == nullptr) return {};
  return std::filesystem::path(info.dli_fname).parent_path();
}

void use_bundled_data() {
  // Not share/gdal: that is beside the GDAL of many systems, which needs no advice
  const std::filesystem::path data = folder_of_gdal().parent_path() / "share/farlod/gdal";
  std::error_code none;
  if (!std::filesystem::is_directory(data, none)) return;
  if (CPLGetConfigOption("GDAL_DATA", nullptr) == nullptr) CPLSetConfigOption("GDAL_DATA", data.c_str());
  CPLSetConfigOption("GDAL_DRIVER_PATH", "disable");
}

}  // namespace

GDALDriverManager& registered_formats() {
  static std::once_flag once;
  std::call_once(once, [] {
    use_bundled_data();
    GDALAllRegister();
  });
  return *GetGDALDriverManager();
}

}  // namespace farlod
