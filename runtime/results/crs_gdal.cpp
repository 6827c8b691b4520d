// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/crs_gdal.hpp"

#include <cpl_conv.h>
#include <cpl_error.h>
#include <ogr_spatialref.h>

#include <array>
#include <memory>
#include <string_view>

#include "gdal/gdal_errors.hpp"

namespace farlod {
namespace {

/// An attribute of the conventions, and the parameters of WKT 1 whose values it has. The second may be empty.
struct Parameter {
  const char* name;
  std::array<const char*, 2> of_wkt;
};

struct Projection {
  const char* of_wkt;
  const char* name;
  std::array<Parameter, 5> parameters;  ///< those behind the last one have no name
};

constexpr Parameter false_easting{"false_easting", {SRS_PP_FALSE_EASTING, nullptr}};
constexpr Parameter false_northing{"false_northing", {SRS_PP_FALSE_NORTHING, nullptr}};
constexpr Parameter both_parallels{"standard_parallel", {SRS_PP_STANDARD_PARALLEL_1, SRS_PP_STANDARD_PARALLEL_2}};
constexpr Parameter origin_latitude{"latitude_of_projection_origin", {SRS_PP_LATITUDE_OF_ORIGIN, nullptr}};
constexpr Parameter meridian{"longitude_of_central_meridian", {SRS_PP_CENTRAL_MERIDIAN, nullptr}};
constexpr Parameter origin_longitude{"longitude_of_projection_origin", {SRS_PP_CENTRAL_MERIDIAN, nullptr}};

constexpr Projection projections[] = {
    {SRS_PT_TRANSVERSE_MERCATOR,
     "transverse_mercator",
     {{{"scale_factor_at_central_meridian", {SRS_PP_SCALE_FACTOR, nullptr}},
       meridian,
       origin_latitude,
       false_easting,
       false_northing}}},
    {SRS_PT_LAMBERT_CONFORMAL_CONIC_2SP,
     "lambert_conformal_conic",
     {{both_parallels, meridian, origin_latitude, false_easting, false_northing}}},
    {SRS_PT_ALBERS_CONIC_EQUAL_AREA,
     "albers_conical_equal_area",
     {{both_parallels,
       {"longitude_of_central_meridian", {SRS_PP_LONGITUDE_OF_CENTER, nullptr}},
       {"latitude_of_projection_origin", {SRS_PP_LATITUDE_OF_CENTER, nullptr}},
       false_easting,
       false_northing}}},
    {SRS_PT_LAMBERT_AZIMUTHAL_EQUAL_AREA,
     "lambert_azimuthal_equal_area",
     {{{"longitude_of_projection_origin", {SRS_PP_LONGITUDE_OF_CENTER, nullptr}},
       {"latitude_of_projection_origin", {SRS_PP_LATITUDE_OF_CENTER, nullptr}},
       false_easting,
       false_northing,
       {nullptr, {}}}}},
    {SRS_PT_MERCATOR_1SP,
     "mercator",
     {{{"scale_factor_at_projection_origin", {SRS_PP_SCALE_FACTOR, nullptr}},
       origin_longitude,
       false_easting,
       false_northing,
       {nullptr, {}}}}},
};

std::vector<double> values_of(const Parameter& parameter, const OGRSpatialReference& crs) {
  std::vector<double> values;
  for (const char* name : parameter.of_wkt)
    if (name != nullptr) values.push_back(crs.GetNormProjParm(name, 0.0));
  return values;
}

}  // namespace

bool read_crs(OGRSpatialReference& crs, const std::string& wkt, std::optional<int> epsg) {
  // PROJ knows the names of a code already; for WKT it looks each of them up, which takes longer than a small map
  const bool is_known = (epsg && crs.importFromEPSG(*epsg) == OGRERR_NONE) || crs.importFromWkt(wkt.c_str()) == OGRERR_NONE;
  if (!is_known) CPLError(CE_Failure, CPLE_AppDefined, "the coordinate reference system is not valid WKT");
  crs.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  return is_known;
}

CfGridMapping cf_grid_mapping_of(const std::string& wkt, std::optional<int> epsg) {
  const GdalErrors errors;
  CfGridMapping mapping;
  OGRSpatialReference crs;
  if (!read_crs(crs, wkt, epsg)) return mapping;
  if (crs.IsCompound() != 0) crs.StripVertical();
  mapping.parameters = {{"semi_major_axis", {crs.GetSemiMajor()}},
                        {"inverse_flattening", {crs.GetInvFlattening()}},
                        {"longitude_of_prime_meridian", {crs.GetPrimeMeridian()}}};
  const char* projection = crs.GetAttrValue("PROJECTION");
  for (const Projection& known : projections) {
    if (projection == nullptr || std::string_view(projection) != known.of_wkt) continue;
    mapping.name = known.name;
    for (const Parameter& parameter : known.parameters)
      if (parameter.name != nullptr) mapping.parameters.emplace_back(parameter.name, values_of(parameter, crs));
  }
  return mapping;
}

std::string esri_wkt_of(const std::string& wkt) {
  const GdalErrors errors;
  OGRSpatialReference crs;
  if (crs.importFromWkt(wkt.c_str()) != OGRERR_NONE) return wkt;
  constexpr std::array<const char*, 2> options{"FORMAT=WKT1_ESRI", nullptr};
  char* text = nullptr;
  const OGRErr refused = crs.exportToWkt(&text, options.data());
  const std::unique_ptr<char, decltype(&VSIFree)> owner(text, VSIFree);
  return refused == OGRERR_NONE ? std::string(text) : wkt;
}

}  // namespace farlod
