// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "farlod/point.hpp"
#include "ingest/files/input_file.hpp"

namespace farlod::ingest {

/// Where an OBJ file lies on the map. The format has no place for it; by custom small files beside it tell.
struct ObjPlacement {
  std::string crs;                ///< as the file beside it says it; empty: none does
  std::optional<Point3d> origin;  ///< to be added to the coordinates
  std::string crs_file, origin_file;
};

/// Looks for the customs of several programs, the most particular first. `NAME` is the file's name without its ending:
///   NAME.prj                                              CRS
///   NAME.offset, NAME_offset.xyz, offset.xyz              one line of three numbers: the origin
///   coords.txt, ../odm_georeferencing/coords.txt          OpenDroneMap: "WGS84 UTM 32N", then easting and northing
///   metadata.xml, also one or two folders up              ContextCapture: <SRS> and <SRSOrigin>x,y,z</SRSOrigin>
/// A file that is not as its custom asks for is no such file.
[[nodiscard]] ObjPlacement find_obj_placement(const InputFile& file);

/// What the user is told of it. `has_origin`: one was given, and holds.
[[nodiscard]] std::vector<std::string> notes_of(const ObjPlacement& placement, const InputFile& file, bool has_origin);

}  // namespace farlod::ingest
