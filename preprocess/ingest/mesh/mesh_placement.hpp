// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "farlod/point.hpp"
#include "ingest/files/input_file.hpp"

namespace farlod::ingest {

/// The place of a mesh on the map. Its format cannot store it; by convention, small files beside it do.
struct MeshPlacement {
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
[[nodiscard]] MeshPlacement find_mesh_placement(const InputFile& file);

/// Notes about the placement, for the user. `has_origin`: the user gave an origin, which is used instead.
[[nodiscard]] std::vector<std::string> notes_of(const MeshPlacement& placement, const InputFile& file, bool has_origin);

}  // namespace farlod::ingest
