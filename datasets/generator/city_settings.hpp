// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace farlod {

/// The allowed values of a setting, both ends included.
struct SettingRange {
  double low, high;
};

/// The settings of a generated city. The same settings give the same city on every machine.
struct CitySettings {
  double size_m = 1000.0;
  std::uint64_t seed = 1;
  double rotation_deg = 0.0;
  double avenue_spacing_m = 170.0;
  double street_spacing_m = 85.0;
  double avenue_width_m = 22.0;
  double street_width_m = 13.0;
  double tower_share = 0.25;
  double max_height_m = 210.0;
  double height_scale = 1.0;
  double terrain_relief_m = 0.0;
  int lod = 1;
  double eaves_m = 0.0;
  double wrong_base_share = 0.0;
  bool overhangs = false;
  bool open_shells = false;
  bool balconies = false;
  bool projecting_floors = false;
  bool hillside = false;
  bool overlapping_parts = false;
  bool facade_details = false;
  int epsg = 32632;
  double centre_easting_m = 550000.0;
  double centre_northing_m = 5500000.0;

  /// Lists each numeric setting once, for the command line, the check of ranges and the help. `setting` is called with
  /// (name, value, range, group, help).
  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& setting) {
    setting("size", self.size_m, SettingRange{100.0, 200'000.0}, "City", "Edge of the square city, in metres");
    setting("rotation", self.rotation_deg, SettingRange{-360.0, 360.0}, "City",
            "Bearing of the avenues, in degrees clockwise from grid north");
    setting("avenue-spacing", self.avenue_spacing_m, SettingRange{60.0, 600.0}, "Streets",
            "Mean distance between the axes of avenues, in metres");
    setting("street-spacing", self.street_spacing_m, SettingRange{60.0, 600.0}, "Streets",
            "Mean distance between the axes of the streets that cross them, in metres");
    setting("avenue-width", self.avenue_width_m, SettingRange{4.0, 60.0}, "Streets",
            "Width of an avenue, in metres; every fourth is half as wide again");
    setting("street-width", self.street_width_m, SettingRange{4.0, 60.0}, "Streets",
            "Width of a street, in metres; every fifth is half as wide again");
    setting("towers", self.tower_share, SettingRange{0.0, 1.0}, "Buildings",
            "Share of the buildings in the core that are towers; a city needs about 400 m to have a core");
    setting("max-height", self.max_height_m, SettingRange{60.0, 1000.0}, "Buildings",
            "What the tallest towers come near to, in metres");
    setting("height-scale", self.height_scale, SettingRange{0.25, 4.0}, "Buildings",
            "Multiplies the heights of all buildings that are not towers");
    setting("terrain-relief", self.terrain_relief_m, SettingRange{0.0, 500.0}, "Buildings",
            "Hills between 0 and this height, in metres; a building stands at the lowest ground under its corners");
    setting("lod", self.lod, SettingRange{1, 2}, "Buildings",
            "1: flat-roofed prisms; 2: gabled and hipped roofs on low buildings, stepped tops on towers");
    setting("eaves", self.eaves_m, SettingRange{0.0, 1.0}, "Buildings",
            "Pitched roofs project by this much beyond walls that no neighbor touches, in metres, as sheets without thickness; "
            "needs --lod 2");
    setting("wrong-bases", self.wrong_base_share, SettingRange{0.0, 1.0}, "Buildings",
            "Share of the buildings that reach down to z = 0 or 10 to 40 m too low; their roofs stay where they are");
    setting("centre-easting", self.centre_easting_m, SettingRange{-1e7, 1e7}, "Place", "Easting of the city's centre, in metres");
    setting("centre-northing", self.centre_northing_m, SettingRange{-2e7, 2e7}, "Place",
            "Northing of the city's centre, in metres");
  }

  /// Lists each switch once: `flag` is called with (name, value, help).
  template <class Self, class Visitor>
  static void describe_switches(Self& self, Visitor&& flag) {
    flag("overhangs", self.overhangs, "Add pedestrian bridges across streets, and arcades under upper floors");
    flag("open-shells", self.open_shells,
         "Leave out the floors, and of the walls what a touching building covers; bridges stay whole");
    flag("balconies", self.balconies, "Add slabs of 3 x 1.2 x 0.2 m to some residential buildings, one a storey; needs --lod 2");
    flag("projecting-floors", self.projecting_floors,
         "Let the upper floors of some buildings project 0.5 to 2 m over the ground floor; their roofs are flat");
    flag("hillside", self.hillside,
         "Lay the city on slopes of 10 to 25 %, with closed fronts and terraces of touching houses, each on a base of its own");
    flag("overlapping-parts", self.overlapping_parts,
         "Make some buildings of two or three parts whose volumes overlap: towers in podiums, annexes in houses");
    flag("facade-details", self.facade_details,
         "Add windows, doors, dormers and chimneys, and name the level of detail 3; needs --lod 2");
  }
};

/// The level of detail that is written to the files.
[[nodiscard]] inline int written_lod(const CitySettings& settings) { return settings.facade_details ? 3 : settings.lod; }

/// Throws InvalidArgument for the first setting that is out of its range or contradicts another.
void check(const CitySettings& settings);

/// The code in "EPSG:n", in capitals or not; empty if the text is not of this form.
[[nodiscard]] std::optional<int> epsg_code(std::string_view text);

}  // namespace farlod
