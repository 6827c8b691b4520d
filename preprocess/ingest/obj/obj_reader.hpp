// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "farlod/pack.hpp"
#include "farlod/point.hpp"
#include "ingest/files/input_file.hpp"
#include "ingest/model_builder/city_model_builder.hpp"

namespace farlod::ingest {

/// How the coordinates of a mesh are brought into its CRS.
struct ObjFrame {
  Point3d origin;  ///< added to the coordinates after their vertical axis is z
  UpAxis up = UpAxis::z;
};

/// What an OBJ file holds besides buildings.
struct ObjRest {
  std::vector<Point3d> relief_points;  ///< corners of its ground
  SkippedFeatures skipped;
};

/// Reads an OBJ file. A building is a group (`g`); an object (`o`) if the file has more than one; or, without either, a connected
/// component. A repeated name begins another building. Coplanar neighboring faces share a surface number. Works on all threads of
/// the task arena that it is called in. Returns what the names of groups, objects and materials say to be no building. Throws
/// InputError when there are no faces, and Cancelled when a stop is requested.
ObjRest read_obj(const InputFile& file, const ObjFrame& frame, CityModelBuilder& builder, const std::stop_token& stop = {});

/// The place of an OBJ file on the map. The format cannot store it; by convention, small files beside it do.
struct ObjPlacement {
  std::string crs;                ///< as a file beside it defines it; empty: no file does
  std::optional<Point3d> origin;  ///< is added to the coordinates
  std::string crs_file, origin_file;
};

/// Searches for the files of several conventions, the most specific first. `NAME` is the name of the file without its ending:
///   NAME.prj                                              CRS
///   NAME.offset, NAME_offset.xyz, offset.xyz              one line of three numbers: the origin
///   coords.txt, ../odm_georeferencing/coords.txt          OpenDroneMap: "WGS84 UTM 32N", then easting and northing
///   metadata.xml, also one or two folders up              ContextCapture: <SRS> and <SRSOrigin>x,y,z</SRSOrigin>
/// A file that does not have the content of its convention is ignored.
[[nodiscard]] ObjPlacement find_obj_placement(const InputFile& file);

/// Notes about the placement, for the user. `has_origin`: the user gave an origin, which is used instead.
[[nodiscard]] std::vector<std::string> notes_of(const ObjPlacement& placement, const InputFile& file, bool has_origin);

}  // namespace farlod::ingest
