// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "gdal/local_data_gdal.hpp"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <cpl_vsi.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "base/lower_case.hpp"
#include "farlod/error.hpp"
#include "gdal/registered_formats_gdal.hpp"
#include "gdal/virtual_file_gdal.hpp"

namespace farlod {
namespace {

using namespace std::string_view_literals;

/// Formats whose files hold their data, or have it in companions of the same name. Others may follow once somebody has looked
/// whether a file of theirs can name another one. SQLite cannot be among them: its virtual tables name files.
constexpr std::array self_contained{
    "AAIGrid"sv,    "AIG"sv,     "BT"sv,          "DTED"sv,    "EHdr"sv,   "ENVI"sv,         "ESRI Shapefile"sv, "ESRIJSON"sv,
    "FlatGeobuf"sv, "GML"sv,     "GPKG"sv,        "GS7BG"sv,   "GSAG"sv,   "GSBG"sv,         "GTiff"sv,          "GeoJSON"sv,
    "GeoJSONSeq"sv, "JPEG"sv,    "JP2OpenJPEG"sv, "KML"sv,     "LIBKML"sv, "MapInfo File"sv, "OpenFileGDB"sv,    "PNG"sv,
    "SAGA"sv,       "SRTMHGT"sv, "TopoJSON"sv,    "USGSDEM"sv, "XYZ"sv};

/// Formats that lead to the network, to a database or into memory, or that run or write what a file tells them to.
constexpr std::array beyond_this_computer{
    "AmigoCloud"sv, "Carto"sv,    "Cloudant"sv,  "CouchDB"sv,       "CSW"sv,           "DAAS"sv,
    "DERIVED"sv,    "EEDA"sv,     "EEDAI"sv,     "Elasticsearch"sv, "GDALG"sv,         "GEORASTER"sv,
    "GMLAS"sv,      "GPSBabel"sv, "GTI"sv,       "HANA"sv,          "HTTP"sv,          "KMLSUPEROVERLAY"sv,
    "MEM"sv,        "Memory"sv,   "MongoDBv3"sv, "MRF"sv,           "MSSQLSpatial"sv,  "MySQL"sv,
    "NAS"sv,        "NGW"sv,      "OAPIF"sv,     "OCI"sv,           "ODBC"sv,          "OGCAPI"sv,
    "OGR_OGDI"sv,   "PGeo"sv,     "PLMOSAIC"sv,  "PLSCENES"sv,      "PostGISRaster"sv, "PostgreSQL"sv,
    "STACIT"sv,     "STACTA"sv,   "TileDB"sv,    "WCS"sv,           "WFS"sv,           "WMS"sv,
    "WMTS"sv};

constexpr std::array virtual_formats{"OGR_VRT"sv, "VRT"sv};

template <std::size_t n>
bool lists(const std::array<std::string_view, n>& names, const char* name) {
  return std::any_of(names.begin(), names.end(), [&](std::string_view one) { return EQUAL(one.data(), name); });
}

CPLStringList allowed_formats(GdalReach reach) {
  GDALDriverManager& formats = registered_formats();
  CPLStringList names;
  for (int n = 0; n < formats.GetDriverCount(); ++n) {
    const char* name = formats.GetDriver(n)->GetDescription();
    if (reach == GdalReach::own_data ? lists(self_contained, name) : !lists(beyond_this_computer, name)) names.AddString(name);
  }
  return names;
}

/// The name of the format that knows a file; empty when none does.
std::string format_of(const std::filesystem::path& file, unsigned int kinds, CPLStringList allowed) {
  GDALDriverH driver = GDALIdentifyDriverEx(file.c_str(), kinds, allowed.List(), nullptr);
  return driver == nullptr ? "" : GDALGetDescription(driver);
}

/// A table of MapInfo may be a view of other tables, or a list of them ("seamless").
void require_own_table(const std::filesystem::path& file) {
  constexpr std::size_t most_bytes = std::size_t{1} << 20;
  VSILFILE* stream = VSIFOpenL(file.c_str(), "rb");
  if (stream == nullptr) return;
  std::string text(most_bytes, '\0');
  text.resize(VSIFReadL(text.data(), 1, text.size(), stream));
  VSIFCloseL(stream);
  text = lower_case(text);
  if (text.find("create view") != text.npos || text.find("isseamless") != text.npos)
    throw InputError(file.string() + " is a MapInfo table that names other tables: give it by its own name, not in a folder.");
}

/// Overviews that lie elsewhere than their name says.
void require_own_overviews(GDALDataset& dataset, const std::filesystem::path& file) {
  const char* elsewhere = dataset.GetMetadataItem("OVERVIEW_FILE", "OVERVIEWS");
  if (elsewhere == nullptr) return;
  throw InputError(file.string() + " names another file as its overviews, \"" + elsewhere +
                   "\": remove OVERVIEW_FILE from its .aux.xml, or write it anew with gdal_translate.");
}

/// With which a vector file of a format is opened.
CPLStringList vector_options(const std::string& format, const std::optional<std::string>& encoding) {
  CPLStringList options;
  if (format == "CSV") {
    // Columns of WKT that GDAL does not look for by itself, such as that of Open Buildings
    options.SetNameValue("GEOM_POSSIBLE_NAMES", "WKT,_WKT*,geometry,geom,the_geom,wkb_geometry");
  } else if (format == "ESRI Shapefile") {
    if (encoding) options.SetNameValue("ENCODING", encoding->c_str());
  } else {
    // For GML: GDAL must write nothing beside the file, and fetch no schema from an address in it
    options.SetNameValue("WRITE_GFS", "NO");
    options.SetNameValue("DOWNLOAD_SCHEMA", "NO");
  }
  return options;
}

}  // namespace

bool is_known_within(GdalReach reach, const std::filesystem::path& file, unsigned int kinds) {
  return !format_of(file, kinds, allowed_formats(reach)).empty();
}

GDALDatasetUniquePtr open_within(GdalReach reach, const std::filesystem::path& file, unsigned int kinds,
                                 const std::optional<std::string>& encoding) {
  CPLStringList allowed = allowed_formats(reach);
  require_local_name(file.string(), file.string());
  const std::string format = format_of(file, kinds, allowed);
  if (lists(virtual_formats, format.c_str()))
    require_local_sources(file, [](const std::string& source) {
      constexpr unsigned int any = GDAL_OF_RASTER | GDAL_OF_VECTOR;
      std::string found = format_of(source, any, allowed_formats(GdalReach::own_data));
      if (found.empty()) found = format_of(source, any, allowed_formats(GdalReach::local_files));
      return found.empty()                           ? SourceKind::unknown
             : lists(virtual_formats, found.c_str()) ? SourceKind::names_others
                                                     : SourceKind::data;
    });
  if (reach == GdalReach::own_data && format == "MapInfo File") require_own_table(file);
  CPLStringList options = (kinds & GDAL_OF_VECTOR) != 0 ? vector_options(format, encoding) : CPLStringList();
  GDALDatasetUniquePtr dataset(GDALDataset::Open(file.c_str(), kinds | GDAL_OF_READONLY, allowed.List(), options.List()));
  if (dataset && (kinds & GDAL_OF_RASTER) != 0) require_own_overviews(*dataset, file);
  return dataset;
}

}  // namespace farlod
