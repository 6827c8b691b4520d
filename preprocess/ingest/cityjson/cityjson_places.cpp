// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <string>
#include <utility>

#include "base/expects.hpp"
#include "ingest/cityjson/cityjson_reader.hpp"

namespace farlod::ingest {
namespace {

// The numbers of forms: a sum of these
constexpr std::uint32_t among_members = 1, behind_others = 1, with_a_member_of_their_own = 2;

package::AttributeForm form_around(const std::string& before_all, const std::string& behind_all) {
  return {.before_all = before_all,
          .before_name = "\"",
          .before_value = "\":",
          .behind_value = "",
          .between = ",",
          .behind_all = behind_all};
}

}  // namespace

std::vector<package::AttributeForm> CityJsonPlaceFinder::forms() {
  const std::string own = "\"attributes\":{";
  return {form_around("", ""), form_around(",", ""), form_around(own, "}"), form_around("," + own, "}")};
}

void CityJsonPlaceFinder::open(std::string_view name, bool is_object, std::uint64_t at) {
  const Thing thing = open_.empty() ? Thing::object : thing_in(open_.back().thing, name, is_object);
  if (!open_.empty() && open_.back().thing == Thing::object && name == "attributes") {
    takes_attributes_ = is_object;
    among_attributes_.reset();
  }
  if (thing == Thing::geometries) places_.semantics.clear();
  if (thing == Thing::geometry) places_.semantics.emplace_back();
  if (thing == Thing::surfaces) places_.semantics.back().clear();
  open_.push_back({thing, at, at});
}

CityJsonPlaceFinder::Thing CityJsonPlaceFinder::thing_in(Thing outer, std::string_view name, bool is_object) {
  switch (outer) {
    case Thing::object:
      if (name == "attributes" && is_object) return Thing::attributes;
      return name == "geometry" && !is_object ? Thing::geometries : Thing::other;
    case Thing::geometries:
      return is_object ? Thing::geometry : Thing::other;
    case Thing::geometry:
      return name == "semantics" && is_object ? Thing::semantics : Thing::other;
    case Thing::semantics:
      return name == "surfaces" && !is_object ? Thing::surfaces : Thing::other;
    case Thing::surfaces:
      return is_object ? Thing::surface : Thing::other;
    case Thing::attributes:
    case Thing::surface:
    case Thing::other:
      break;
  }
  return Thing::other;
}

void CityJsonPlaceFinder::close(std::uint64_t at) {
  FARLOD_EXPECTS(!open_.empty());
  const Open closed = open_.back();
  open_.pop_back();
  if (!open_.empty()) open_.back().last = at;
  if (closed.thing == Thing::attributes) among_attributes_ = place_in(closed, among_members);
  if (closed.thing == Thing::surface) places_.semantics.back().push_back(place_in(closed, among_members));
  if (closed.thing != Thing::object || !takes_attributes_) return;
  places_.object = among_attributes_.value_or(place_in(closed, among_members + with_a_member_of_their_own));
}

package::AttributePlace CityJsonPlaceFinder::place_in(const Open& members, std::uint32_t form) {
  return {members.last, form + (members.first == members.last ? 0 : behind_others)};
}

void CityJsonPlaceFinder::value(std::string_view name, std::uint64_t at) {
  if (open_.empty()) return;
  open_.back().last = at;
  if (open_.back().thing != Thing::object || name != "attributes") return;
  takes_attributes_ = false;
  among_attributes_.reset();
}

CityJsonPlaces CityJsonPlaceFinder::take() {
  CityJsonPlaces places = std::move(places_);
  *this = {};
  return places;
}

}  // namespace farlod::ingest
