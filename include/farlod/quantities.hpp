// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "farlod/angle.hpp"
#include "farlod/canopy.hpp"
#include "farlod/export.hpp"
#include "farlod/light.hpp"
#include "farlod/word.hpp"

namespace farlod {

/// Divisions of the sky into patches, for methods that know a radiance for each. Patches are counted as Radiance counts them:
/// band by band from the horizon upwards; in a band the first is centred at true north, and the others follow clockwise; the
/// zenith is the last. The ground, which Radiance counts first, is not among them.
enum class SkyPatchSet : std::uint8_t {
  none,
  tregenza,  ///< 145: bands of 12° with 30, 30, 24, 24, 18, 12, 6 patches, and the zenith
  reinhart   ///< 577: each of those divided into four; bands of 6.2°
};
inline constexpr std::array<Word<SkyPatchSet>, 3> sky_patch_words{
    {{"none", SkyPatchSet::none}, {"tregenza", SkyPatchSet::tregenza}, {"reinhart", SkyPatchSet::reinhart}}};

/// What is computed beside the sky view factor, from the same horizons. Where a receiver is answered by rays alone
/// (EvaluationMethod of docs/stages/evaluate.md), the same is made of rays for each azimuth.
// NOLINTNEXTLINE(clang-analyzer-optin.performance.Padding): members stand by subject, and there are few of it
struct Quantities {
  /// The share of the sky's solid angle: column `svf_solid`.
  bool svf_solid = false;
  /// The sky view factors of the northern, eastern, southern and western half of the sky, as UMEP defines them: each twice the
  /// half's share, so that it is 1 in the open, and (svfE + svfW) / 2 = (svfN + svfS) / 2 = svf. Of a receiver that is tilted,
  /// one may be larger than 1. Columns `svfN`, `svfE`, `svfS`, `svfW`.
  bool directional = false;
  /// The shares of the sky that geometry of the neighborhood hides, and that of the far city alone: columns `hidden_near`,
  /// `hidden_far`. Of a receiver that looks straight up, they and svf add up to 1.
  bool hidden = false;
  /// The elevation in degrees above which all is sky, at so many azimuths (0, or 4 to 3,600), the first of them true north, the
  /// others clockwise. 90 where there is no sky. What is seen below a bridge is not told. Columns `horizon_AZIMUTH`.
  std::size_t horizons = 0;
  /// The level distance in metres to what makes each horizon: the nearest thing that is met within a fiftieth of a degree below
  /// it, or, where a far map is not as exact, within two degrees. NaN where the horizon is level. Rays find it in a scene of the
  /// whole city, which takes its time and memory. Needs `horizons`. Columns `distance_AZIMUTH`.
  bool horizon_distances = false;
  /// The share of each patch that is seen, weighted by the cosine to the receiver's normal: the sum of shares times the patches'
  /// own view factors is svf. 0 where a patch lies behind the receiver. Columns `patch_N`, from 1.
  SkyPatchSet sky_patches = SkyPatchSet::none;
  /// The hours of sunshine: those of the positions at which nothing hides the sun's centre, and it shines on the receiver's
  /// front. Column `sunlit_h`; of no positions, as in a polar night, it is 0.
  std::optional<std::vector<SunPosition>> sun = {};
  /// The same hours, of which crowns of trees take what they take of light, by the rule of `canopy`: column `sunlit_total_h`. Of
  /// a city without trees it is `sunlit_h`. Needs `sun`.
  bool sunlit_total = false;
  /// The light of a period, for the next three.
  std::optional<Light> light = {};
  /// What falls on the receiver in the period, in kWh/m²: columns `irradiation`, `irradiation_direct` of the sun,
  /// `irradiation_diffuse` of the sky, `irradiation_reflected`, and with Light::by_month `irradiation_01` … for each month that
  /// there is. Crowns of trees take their share of what comes from the sun and the sky, by the rule of `canopy`, and reflect
  /// nothing. What is reflected is one bounce: the ground in the open sends the share
  /// `ground_albedo` of what falls on it to all that a receiver sees of the lower half of its sphere, and all else that hides sky
  /// the share `facade_albedo` of what falls on the mean upright plane in the open.
  bool irradiation = false;
  /// The mean of the same over the period, by day and by night, in W/m²: column `irradiance`.
  bool irradiance = false;
  /// The mean of the light to the eye, in lx, over the intervals that know theirs (LightInterval::diffuse_lux): column
  /// `illuminance`. Otherwise as irradiance.
  bool illuminance = false;
  /// The share of the hours with a sun above the horizon in which it does not shine on the receiver's front: column `shade`. NaN
  /// where there are no such hours. Where the sun shines through crowns, what they take of it counts as shade. With
  /// Light::by_step `shade_20260621T1000` … for each interval that begins then.
  bool shade = false;
  /// What comes from the CIE's overcast sky, as a share of what a level plane in the open gets: column `sky_component`. Of a
  /// wall it is the vertical sky component. Crowns take their share, as of irradiation.
  bool sky_component = false;
  /// What fills a receiver's view, by class, of all directions before its front, weighted by the cosine (with
  /// SkyWeight::solid_angle all alike): columns `view_sky`, `view_ground`, `view_roof`, `view_wall_n`, `view_wall_e`,
  /// `view_wall_s`, `view_wall_w` (walls by the part of the turn that the side seen faces, see `wall_sectors`), `view_crown` (of
  /// trees, as if nothing passed them), `view_other` (undersides). They add up to 1; of a city without trees `view_sky` is `svf`.
  /// What is met nowhere below the horizontal is ground. Takes `rays` rays against the whole city, with its trees, whatever the
  /// engine.
  bool view_factors = false;
  /// The parts of the same that lie below the horizontal: columns `view_ground_below`, `view_roof_below`, `view_wall_n_below` …,
  /// `view_crown_below`, `view_other_below`. Of a receiver that looks straight up, all are 0.
  bool view_factors_below = false;
  /// The same of the six faces of a small cube, weighted by the cosine to each, whatever the receiver's normal: columns
  /// `view_sky_up`, `view_ground_up` … of the face that looks up, then `_down`, `_north`, `_east`, `_south`, `_west` by true
  /// azimuths. Those of a face are the view factors of a receiver that looks there, and add up to 1. Not on surfaces.
  bool view_cube = false;
  /// The same of all directions around the place alike: shares of the sphere's solid angle, columns `view_sky_sphere`,
  /// `view_ground_sphere` …, which add up to 1. Not on surfaces.
  bool view_sphere = false;
  /// The same of a person who turns around: of all directions whose elevation is between ±`eye_field_deg`, alike. Columns
  /// `view_sky_eye`, `view_ground_eye` …, which add up to 1; `view_crown_eye` is the green view. Not on surfaces.
  bool view_eye = false;
  /// Half the height of that field, 1 to 90; 90 is the whole sphere.
  double eye_field_deg = 30.0;
  /// Parts of the turn by which walls are told apart in all of these: 4, or 8 with `view_wall_ne` between `view_wall_n` and
  /// `view_wall_e`, and so on. Each is centred at its true azimuth.
  std::size_t wall_sectors = 4;
  /// The id of a building that receivers look for, as tables of surfaces name it; all count that share it. Column
  /// `view_building`: the share of the view that it fills, of all directions before the receiver's front, weighted as svf is;
  /// what lies below the horizontal of a receiver that looks straight up is not before its front. Column `sees_building`: 1 where
  /// anything of it is seen, and else 0; in any direction of a receiver that looks straight up, before the front of others and of
  /// all on surfaces. What hides it is the whole city to the last tile, far or near, with its crowns, as if nothing passed them,
  /// whatever the engine: far maps do not tell buildings apart. Takes `rays` rays of its own, all towards the building, of which
  /// the share is an average, so that as much of one that is far away is known; what fills less than a ray of the building's box
  /// may be missed.
  std::optional<std::string> seen_building = {};
  /// What crowns of trees do to the sky, by the rule of `canopy`; a package without trees has none. `svf`, horizons and all else
  /// stay those of buildings and ground.
  ///
  /// The light of the sky that comes past crowns and through them: column `svf_total`. And 1 − the sky that lies behind crowns,
  /// as UMEP defines it: column `svfveg`. By the rule `once`, with one transmissivity ψ for all crowns,
  /// svf_total = svf − (1 − svfveg)(1 − ψ).
  bool svf_total = false;
  /// A certain lower and upper bound of svf_total, with the same azimuths or rays, the true far city and each of its crowns by
  /// itself: columns `svf_total_low`, `svf_total_high`. Needs svf_total and EvaluationSettings::bounds.
  bool svf_total_bounds = false;
  /// 1 − the sky that buildings would hide and crowns in front of them hide first, as UMEP defines it: column `svfaveg`. Takes
  /// rays for each receiver, whatever the engine.
  bool svfaveg = false;
  /// svfveg and svfaveg of the northern, eastern, southern and western half of the sky, as UMEP defines them: what crowns hide in
  /// a half counts twice, so that the mean of opposite halves is the value of the whole sky. Of a receiver that is tilted, one
  /// may be less than 0. Columns `svfNveg`, `svfEveg`, `svfSveg`, `svfWveg`, `svfNaveg`, `svfEaveg`, `svfSaveg`, `svfWaveg`.
  /// Takes the rays of svfaveg.
  bool directional_vegetation = false;
  /// What fills a receiver's view: sky, crowns, and all else; they add up to 1. Columns `share_sky`, `share_vegetation`,
  /// `share_building`. Takes the rays of svfaveg.
  bool sky_shares = false;
  CanopySettings canopy = {};
  /// What hides each of the 153 patches of the sky that SOLWEIG of UMEP knows, as bits, which the header shadow_patches tells how
  /// to read. Columns `shadow_1` to `shadow_7`, `vegshadow_1` …, `vbshadow_1` …. Takes rays against the whole city, with its
  /// trees, whatever the engine and the receiver's normal.
  bool shadow_patches = false;

  [[nodiscard]] FARLOD_EXPORT bool any() const;
  [[nodiscard]] FARLOD_EXPORT bool any_of_canopies() const;
  /// Those that are of the light of a period.
  [[nodiscard]] bool any_of_light() const { return irradiation || irradiance || illuminance || shade; }
  /// Those that crowns dim, where a package has some.
  [[nodiscard]] bool any_dimmed_by_crowns() const { return any_of_light() || sky_component || sunlit_total; }
  /// Those that are seen by rays against the whole city, crowns included.
  [[nodiscard]] bool any_seen_by_rays() const { return shadow_patches || seen_building || any_of_views(); }
  /// Those that say what fills the view.
  [[nodiscard]] bool any_of_views() const { return view_factors || view_factors_below || any_of_places(); }
  /// Those that are of a place, not of a surface: receivers on surfaces have none.
  [[nodiscard]] bool any_of_places() const { return view_cube || view_sphere || view_eye; }
  /// Those that know SkyWeight::cosine alone.
  [[nodiscard]] FARLOD_EXPORT bool any_weighted() const;
};

/// Asks for a quantity by its word, as farlod-svf --quantity does: with 36 horizons, or 145 patches, where their number is not
/// chosen yet. False: there is no quantity of this word.
[[nodiscard]] FARLOD_EXPORT bool ask_for(std::string_view word, Quantities& quantities);

/// The word of a quantity, and what it stands for, as a phrase behind the word.
struct QuantityWord {
  std::string_view word, meaning;
  bool is_of_crowns = false;  ///< it needs a package with trees
  bool is_weighted = true;    ///< by the cosine: it has no place beside SkyWeight::solid_angle
};
/// All that there are, in the order of their columns.
[[nodiscard]] FARLOD_EXPORT std::vector<QuantityWord> quantity_words();
/// Those of the quantities that are asked for.
[[nodiscard]] FARLOD_EXPORT std::vector<QuantityWord> words_of(const Quantities& quantities);

/// One of the numbers that a receiver has.
struct ColumnDescription {
  std::string name;             ///< such as "svf_low"
  std::string unit = "1";       ///< in the words of UDUNITS; "1" of a share
  std::string definition = {};  ///< what the number is, as a phrase
};

/// The columns of some quantities, in their order.
[[nodiscard]] FARLOD_EXPORT std::vector<ColumnDescription> column_descriptions_of(const Quantities& quantities);
/// The names of the columns of some quantities, in their order.
[[nodiscard]] FARLOD_EXPORT std::vector<std::string> columns_of(const Quantities& quantities);

}  // namespace farlod
