// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <proj.h>
// Builds CRSs from parts; needs proj.h before it
#include <proj_experimental.h>

#include <cstdlib>
#include <limits>
#include <numbers>
#include <regex>
#include <utility>

#include "base/expects.hpp"
#include "georeference/crs.hpp"
#include "georeference/objects_proj.hpp"

namespace farlod::georeference {
namespace {

using Context = std::shared_ptr<PJ_CONTEXT>;
using Object = Owned<PJ>;

Object clone(const Context& context, const PJ* object) { return Object(proj_clone(context.get(), object)); }

bool is_projected_or_geographic(PJ_TYPE type) {
  return type == PJ_TYPE_PROJECTED_CRS || type == PJ_TYPE_GEOGRAPHIC_2D_CRS || type == PJ_TYPE_GEOGRAPHIC_3D_CRS;
}

/// Removes the shift to WGS 84 that old WKT and PROJ strings contain.
Object without_shift(const Context& context, Object crs) {
  while (crs && proj_get_type(crs.get()) == PJ_TYPE_BOUND_CRS) crs.reset(proj_get_source_crs(context.get(), crs.get()));
  return crs;
}

/// The horizontal part of a compound CRS; any other CRS itself.
Object horizontal_part(const Context& context, Object crs) {
  while (crs && proj_get_type(crs.get()) == PJ_TYPE_COMPOUND_CRS) crs.reset(proj_crs_get_sub_crs(context.get(), crs.get(), 0));
  return crs;
}

struct Axis {
  std::string direction;
  double unit = 1.0;  ///< in metres or radians
};

std::optional<Axis> axis_of(const Context& context, const PJ* crs, int index) {
  const Object system(proj_crs_get_coordinate_system(context.get(), crs));
  const char* direction = nullptr;
  double unit = 1.0;
  if (!system || index >= proj_cs_get_axis_count(context.get(), system.get())) return std::nullopt;
  if (!proj_cs_get_axis_info(context.get(), system.get(), index, nullptr, nullptr, &direction, &unit, nullptr, nullptr, nullptr))
    return std::nullopt;
  return Axis{direction, unit};
}

/// The unit of the vertical axis, if the CRS has one.
std::optional<double> vertical_unit_m(const Context& context, const PJ* crs) {
  if (proj_get_type(crs) == PJ_TYPE_COMPOUND_CRS) {
    const Object vertical = without_shift(context, Object(proj_crs_get_sub_crs(context.get(), crs, 1)));
    const auto axis = vertical ? axis_of(context, vertical.get(), 0) : std::nullopt;
    return axis ? std::optional(axis->unit) : std::nullopt;
  }
  const Object plain = without_shift(context, clone(context, crs));
  const auto axis = axis_of(context, plain.get(), 2);
  return axis ? std::optional(axis->unit) : std::nullopt;
}

/// The entry of the EPSG register with the same name and content.
Object entry_of_register(const Context& context, const PJ* crs) {
  constexpr int surely = 90;  // the confidence that GDAL requires
  int* confidences = nullptr;
  const Owned<PJ_OBJ_LIST> list(proj_identify(context.get(), crs, "EPSG", nullptr, &confidences));
  Object entry;
  if (list && proj_list_get_count(list.get()) > 0 && confidences[0] >= surely)
    entry.reset(proj_list_get(context.get(), list.get(), 0));
  proj_int_list_destroy(confidences);
  return entry;
}

bool has_code(const PJ* crs) {
  const char* authority = proj_get_id_auth_name(crs, 0);
  return authority != nullptr && std::string(authority) == "EPSG" && proj_get_id_code(crs, 0) != nullptr;
}

/// "NAD83 / New York Long Island (ftUS)" without the unit: the name of the same CRS in metres.
std::string without_unit(std::string name) {
  const auto bracket = name.rfind(" (");
  if (bracket != std::string::npos) name.erase(bracket);
  return name;
}

}  // namespace

struct Crs::Impl {
  Context context;
  Object shifted;     ///< easting first, with its shift to WGS 84 if it has one: for transformations
  Object plain;       ///< easting first, without that shift
  Object registered;  ///< in the order of the authority: the entry of the EPSG register, or the given definition
  Object whole;       ///< the definition with its vertical system; empty where it has none
  double height_unit_m = 1.0;
  bool says_height_unit = false;
  bool northing_first = false;
  struct WayToGeographic {
    Crs base;
    CrsTransformation way;
    WayToGeographic(Crs geographic, CrsTransformation transformation)
        : base(std::move(geographic)), way(std::move(transformation)) {}
  };
  mutable std::unique_ptr<const WayToGeographic> to_geographic;  ///< of a projected CRS, made when first used: it takes 20 ms
  const WayToGeographic& way_to_geographic(const Crs& owner) const;

  /// Empty when `given` is neither geographic nor projected.
  static std::shared_ptr<const Impl> make(const Context& context, Object given);
};

std::shared_ptr<const Crs::Impl> Crs::Impl::make(const Context& context, Object given) {
  auto impl = std::make_shared<Impl>();
  impl->context = context;
  const auto height_unit = vertical_unit_m(context, given.get());
  if (height_unit) impl->whole = clone(context, given.get());
  Object horizontal = horizontal_part(context, std::move(given));
  Object plain = horizontal ? without_shift(context, clone(context, horizontal.get())) : nullptr;
  if (!plain || !is_projected_or_geographic(proj_get_type(plain.get()))) return nullptr;
  plain.reset(proj_crs_demote_to_2D(context.get(), nullptr, plain.get()));
  horizontal.reset(proj_crs_demote_to_2D(context.get(), nullptr, horizontal.get()));
  const auto first = axis_of(context, plain.get(), 0);
  if (!first) return nullptr;
  impl->northing_first = first->direction == "north" || first->direction == "south";
  const bool projected = proj_get_type(plain.get()) == PJ_TYPE_PROJECTED_CRS;
  impl->says_height_unit = height_unit.has_value();
  impl->height_unit_m = height_unit.value_or(projected ? first->unit : 1.0);
  impl->shifted.reset(proj_normalize_for_visualization(context.get(), horizontal.get()));
  impl->plain.reset(proj_normalize_for_visualization(context.get(), plain.get()));
  if (!has_code(plain.get()))
    if (Object entry = entry_of_register(context, plain.get())) plain = std::move(entry);
  impl->registered = std::move(plain);
  return impl->shifted && impl->plain ? impl : nullptr;
}

std::optional<Crs> Crs::find(const std::string& definition) {
  const Context context = make_context();
  Object given(proj_create(context.get(), definition.c_str()));
  if (!given) return std::nullopt;
  auto impl = Impl::make(context, std::move(given));
  return impl ? std::optional(Crs(std::move(impl))) : std::nullopt;
}

bool Crs::is_projected() const { return proj_get_type(impl_->plain.get()) == PJ_TYPE_PROJECTED_CRS; }
double Crs::unit() const { return axis_of(impl_->context, impl_->plain.get(), 0)->unit; }
double Crs::height_unit_m() const { return impl_->height_unit_m; }
bool Crs::says_height_unit() const { return impl_->says_height_unit; }
bool Crs::northing_first() const { return impl_->northing_first; }

bool Crs::runs_east_and_north() const {
  const auto x = axis_of(impl_->context, impl_->plain.get(), 0), y = axis_of(impl_->context, impl_->plain.get(), 1);
  return x && y && x->direction == "east" && y->direction == "north";
}

namespace {

/// The longitude of the prime meridian from Greenwich.
std::optional<double> prime_meridian_deg(const Context& context, const PJ* crs) {
  const Object meridian(proj_get_prime_meridian(context.get(), crs));
  double longitude = 0.0, unit = 1.0;
  if (!meridian || !proj_prime_meridian_get_parameters(context.get(), meridian.get(), &longitude, &unit, nullptr))
    return std::nullopt;
  return longitude * unit * (180.0 / std::numbers::pi);
}

}  // namespace

bool Crs::is_in_degrees_from_greenwich() const {
  if (is_projected() || prime_meridian_deg(impl_->context, impl_->plain.get()) != 0.0) return false;
  // A definition may have fewer digits of the factor than a double
  constexpr double digits_of_files = 1e-9;
  return std::abs(unit() - std::numbers::pi / 180.0) < digits_of_files;
}

const Crs::Impl::WayToGeographic& Crs::Impl::way_to_geographic(const Crs& owner) const {
  FARLOD_EXPECTS(owner.is_projected());  // a geographic CRS would own itself
  if (!to_geographic) {
    const Crs base = owner.geographic();
    to_geographic = std::make_unique<WayToGeographic>(base, CrsTransformation(owner, base, {}));
  }
  return *to_geographic;
}

std::optional<Point2d> Crs::lon_lat_deg(Point2d p) const {
  const Crs base = is_projected() ? impl_->way_to_geographic(*this).base : *this;
  const auto there = is_projected() ? impl_->way_to_geographic(*this).way.apply(p) : p;
  if (!there) return std::nullopt;
  const Point2d lon_lat = base.unit() * (180.0 / std::numbers::pi) * *there;
  const double greenwich_deg = prime_meridian_deg(base.impl_->context, base.impl_->plain.get()).value_or(0.0);
  return std::abs(lon_lat.y) <= 90.0 ? std::optional(Point2d{lon_lat.x + greenwich_deg, lon_lat.y}) : std::nullopt;
}

std::optional<Point2d> Crs::wgs84_lon_lat_deg(Point2d p) const {
  const auto own_deg = lon_lat_deg(p);
  if (!own_deg) return std::nullopt;
  const Context& context = impl_->context;
  const Crs base = geographic();
  const Object wgs84(proj_normalize_for_visualization(context.get(), Object(proj_create(context.get(), "EPSG:4326")).get()));
  const auto found = operations(context.get(), base.impl_->plain.get(), wgs84.get(), own_deg, MissingGrids::do_not_count);
  const Object shift(found ? proj_list_get(context.get(), found.get(), 0) : nullptr);
  const auto in_base = is_projected() ? impl_->way_to_geographic(*this).way.apply(p) : p;
  if (!shift) return own_deg;
  const PJ_COORD there = proj_trans(shift.get(), PJ_FWD, proj_coord(in_base->x, in_base->y, 0.0, HUGE_VAL));
  return std::isfinite(there.xy.x) && std::isfinite(there.xy.y) ? std::optional(Point2d{there.xy.x, there.xy.y}) : std::nullopt;
}

namespace {

/// Programs write such names where they know the unit of heights alone.
bool is_of_no_system(const std::string& name) {
  static const std::regex form("(unknown|unnamed|undefined)( .*)?", std::regex::ECMAScript | std::regex::icase);
  return name.empty() || std::regex_match(name, form);
}

}  // namespace

std::optional<std::string> Crs::heights_name() const {
  if (!impl_->whole) return std::nullopt;
  const Object plain = without_shift(impl_->context, clone(impl_->context, impl_->whole.get()));
  const bool is_compound = proj_get_type(plain.get()) == PJ_TYPE_COMPOUND_CRS;
  if (!is_compound) return "ellipsoidal heights of " + geographic().name();
  const Object vertical = without_shift(impl_->context, Object(proj_crs_get_sub_crs(impl_->context.get(), plain.get(), 1)));
  if (!vertical || is_of_no_system(proj_get_name(vertical.get()))) return std::nullopt;
  return proj_get_name(vertical.get());
}

std::string Crs::whole_wkt() const {
  FARLOD_EXPECTS(impl_->whole != nullptr);
  const char* const options[] = {"MULTILINE=NO", nullptr};
  const char* text = proj_as_wkt(impl_->context.get(), impl_->whole.get(), PJ_WKT2_2019, options);
  FARLOD_EXPECTS(text != nullptr);
  return text;
}

std::string Crs::name() const { return proj_get_name(impl_->registered.get()); }

std::optional<int> Crs::epsg() const {
  if (!has_code(impl_->registered.get())) return std::nullopt;
  // EPSG has numbers alone. NOLINTNEXTLINE(cert-err34-c)
  return std::atoi(proj_get_id_code(impl_->registered.get(), 0));
}

std::string Crs::wkt() const {
  const char* const options[] = {"MULTILINE=NO", nullptr};
  const char* text = proj_as_wkt(impl_->context.get(), impl_->registered.get(), PJ_WKT2_2019, options);
  FARLOD_EXPECTS(text != nullptr);
  return text;
}

std::optional<AreaOfUse> Crs::area_of_use() const {
  AreaOfUse a;
  constexpr double unknown = -1000.0;
  if (!proj_get_area_of_use(impl_->context.get(), impl_->registered.get(), &a.west_deg, &a.south_deg, &a.east_deg, &a.north_deg,
                            nullptr))
    return std::nullopt;
  return a.west_deg == unknown ? std::nullopt : std::optional(a);
}

std::string Crs::area_name() const {
  const char* name = nullptr;
  const bool is_known =
      proj_get_area_of_use(impl_->context.get(), impl_->registered.get(), nullptr, nullptr, nullptr, nullptr, &name) != 0;
  return is_known && name != nullptr ? name : "";
}

Ellipsoid Crs::ellipsoid() const {
  Ellipsoid e;
  const Object found(proj_get_ellipsoid(impl_->context.get(), impl_->plain.get()));
  FARLOD_EXPECTS(found != nullptr);
  proj_ellipsoid_get_parameters(impl_->context.get(), found.get(), &e.semi_major_m, nullptr, nullptr, &e.inverse_flattening);
  return e;
}

namespace {

/// "UTM zone 32N", "UTM zone 32N with prefix", "3-degree Gauss-Kruger zone 3".
std::string conversion_name(const Context& context, const PJ* projected) {
  const Object conversion(proj_crs_get_coordoperation(context.get(), projected));
  return conversion ? proj_get_name(conversion.get()) : "";
}

}  // namespace

std::optional<UtmZone> Crs::utm_zone() const {
  if (!is_projected() || unit() != 1.0) return std::nullopt;
  const std::string title = conversion_name(impl_->context, impl_->plain.get());
  constexpr std::string_view start = "UTM zone ";
  if (!title.starts_with(start) || (title.back() != 'N' && title.back() != 'S')) return std::nullopt;
  // What is no number is 0, which is no zone. NOLINTNEXTLINE(cert-err34-c)
  const int number = std::atoi(title.c_str() + start.size());
  if (number < 1 || number > 60) return std::nullopt;
  return UtmZone{number, title.back() == 'N'};
}

double Crs::zone_width_deg() const {
  if (!is_projected()) return 0.0;
  const std::string title = conversion_name(impl_->context, impl_->plain.get());
  if (title.starts_with("3-degree Gauss")) return 3.0;
  return title.starts_with("UTM zone ") || title.find("Gauss-Kruger zone") != std::string::npos ? 6.0 : 0.0;
}

bool Crs::equals(const Crs& other) const {
  return proj_is_equivalent_to_with_ctx(impl_->context.get(), impl_->plain.get(), other.impl_->plain.get(), PJ_COMP_EQUIVALENT) !=
         0;
}

Crs Crs::geographic() const {
  if (!is_projected()) return *this;
  auto impl = Impl::make(impl_->context, Object(proj_crs_get_geodetic_crs(impl_->context.get(), impl_->plain.get())));
  FARLOD_EXPECTS(impl != nullptr);
  return Crs(std::move(impl));
}

Crs Crs::counted_in(const LengthUnit& length) const {
  FARLOD_EXPECTS(is_projected());
  const Context& context = impl_->context;
  const char* code = length.epsg_code.empty() ? nullptr : length.epsg_code.c_str();
  const Object twin(proj_crs_alter_cs_linear_unit(context.get(), impl_->plain.get(), length.name.c_str(), length.metres,
                                                  code == nullptr ? nullptr : "EPSG", code));
  FARLOD_EXPECTS(twin != nullptr);
  const std::string twin_name = without_unit(proj_get_name(impl_->registered.get())) + length.mark;
  auto impl = Impl::make(context, Object(proj_alter_name(context.get(), twin.get(), twin_name.c_str())));
  FARLOD_EXPECTS(impl != nullptr);
  return Crs(std::move(impl));
}

Crs Crs::utm(UtmZone zone) const {
  FARLOD_EXPECTS(!is_projected());
  const Context& context = impl_->context;
  const Object conversion(proj_create_conversion_utm(context.get(), zone.number, zone.north ? 1 : 0));
  const Object system(proj_create_cartesian_2D_cs(context.get(), PJ_CART2D_EASTING_NORTHING, nullptr, 0));
  const std::string title = name() + " / UTM zone " + std::to_string(zone.number) + (zone.north ? "N" : "S");
  auto impl = Impl::make(context, Object(proj_create_projected_crs(context.get(), title.c_str(), impl_->registered.get(),
                                                                   conversion.get(), system.get())));
  FARLOD_EXPECTS(impl != nullptr);
  return Crs(std::move(impl));
}

std::optional<Crs::Distortion> Crs::distortion_at(Point2d p_projected) const {
  // proj_factors of PROJ 9.1 ignores the unit of a CRS in feet
  if (unit() != 1.0) return counted_in(metre).distortion_at(unit() * p_projected);
  const auto& [base, way] = impl_->way_to_geographic(*this);
  const auto place = way.apply(p_projected);
  if (!place) return std::nullopt;
  const PJ_FACTORS f = proj_factors(impl_->plain.get(), proj_coord(place->x * base.unit(), place->y * base.unit(), 0.0, 0.0));
  if (!(f.tissot_semiminor > 0.0) || !std::isfinite(f.tissot_semimajor) || !std::isfinite(f.meridian_convergence))
    return std::nullopt;
  return Distortion{Angle::radians(f.meridian_convergence), f.tissot_semiminor, f.tissot_semimajor};
}

struct CrsTransformation::Impl {
  Context context = make_context();
  Object operation;  ///< empty when PROJ has no operation between the two
};

CrsTransformation::CrsTransformation(const Crs& from, const Crs& to, Point2d typical) {
  auto impl = std::make_shared<Impl>();
  Object any(
      proj_create_crs_to_crs_from_pj(impl->context.get(), from.impl_->shifted.get(), to.impl_->shifted.get(), nullptr, nullptr));
  if (any) {
    (void)proj_trans(any.get(), PJ_FWD, proj_coord(typical.x, typical.y, 0.0, HUGE_VAL));
    Object resolved(proj_trans_get_last_used_operation(any.get()));
    impl->operation = resolved ? std::move(resolved) : std::move(any);
  }
  impl_ = std::move(impl);
}

void CrsTransformation::apply(std::span<Point3d> points) const {
  for (Point3d& p : points) {
    const auto there = apply(horizontal(p));
    constexpr double nowhere = std::numeric_limits<double>::infinity();
    p = there ? Point3d{there->x, there->y, p.z} : Point3d{nowhere, nowhere, p.z};
  }
}

std::optional<Point2d> CrsTransformation::apply(Point2d point) const {
  if (!impl_->operation) return std::nullopt;
  const PJ_COORD there = proj_trans(impl_->operation.get(), PJ_FWD, proj_coord(point.x, point.y, 0.0, HUGE_VAL));
  if (!std::isfinite(there.xy.x) || !std::isfinite(there.xy.y)) return std::nullopt;
  return Point2d{there.xy.x, there.xy.y};
}

}  // namespace farlod::georeference
