// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/city/citygml_parser.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace farlod {
namespace {

/// Longitudes end at 180: such a reference point is one in degrees, and the matrix counts in metres.
bool is_in_degrees(const Point3d& p) { return std::abs(p.x) <= 180.0 && std::abs(p.y) <= 180.0; }

}  // namespace

void CityGmlTextParser::start(const XmlTag& tag) {
  if (root_.empty()) root_ = tag.name;
  has_crs_ |= !tag.srs_name.empty();
  places_.start(tag);
  if (skipped_depth_ > 0) {
    ++skipped_depth_;
  } else if (const MaybeMeaning meaning = meaning_of(tag)) {
    open_.push_back(*meaning);
  } else {
    skipped_depth_ = 1;
  }
}

void CityGmlTextParser::end(std::size_t end) {
  if (skipped_depth_ > 0) {
    --skipped_depth_;
  } else {
    const Meaning meaning = open_.back();
    open_.pop_back();
    undo(meaning);
  }
  places_.end(end);
}

void CityGmlTextParser::text(std::string_view piece) {
  places_.text(piece);
  if (skipped_depth_ > 0) return;
  if (in_surfaces_)
    reader_.text(piece);
  else if (words_ != nullptr)
    *words_ += piece;
}

CityGmlTextParser::MaybeMeaning CityGmlTextParser::meaning_of(const XmlTag& tag) {
  if (in_surfaces_) return may_hold_surfaces(tag) && reader_.start(tag) ? MaybeMeaning(Meaning::geometry) : std::nullopt;
  if (scopes_.empty()) {
    if (!is_building(tag)) return Meaning::nothing;
    begin_building(tag);
    return Meaning::building;
  }
  const CityGmlThing thing = thing_of(tag);
  if (thing == CityGmlThing::skipped) return std::nullopt;
  return prototype_ ? meaning_in_prototype(tag) : meaning_of_thing(tag, thing);
}

CityGmlTextParser::MaybeMeaning CityGmlTextParser::meaning_of_thing(const XmlTag& tag, CityGmlThing thing) {
  switch (thing) {
    case CityGmlThing::geometry:
      return meaning_of_geometry(tag);
    case CityGmlThing::part:
      return begin_part(tag);
    case CityGmlThing::installation:
      return begin_installation(tag, CityGmlRole::installation);
    case CityGmlThing::element:
      return begin_installation(tag, CityGmlRole::element);
    case CityGmlThing::boundary:
    case CityGmlThing::opening:
      return begin_semantics(tag, thing);
    case CityGmlThing::relation:
      if (!installations_.empty()) words_ = &relation_;
      relation_.clear();
      return Meaning::relation;
    case CityGmlThing::skipped:
    case CityGmlThing::other:
      break;
  }
  return Meaning::nothing;
}

void CityGmlTextParser::begin_building(const XmlTag& tag) {
  ++buildings_;
  building_.building.id = tag.id.empty() ? "building " + std::to_string(buildings_) : std::string(tag.id);
  scopes_.push_back({});
  begin_object(tag);
}

void CityGmlTextParser::begin_object(const XmlTag& tag) {
  scopes_.back().object = building_.building.objects.size();
  scopes_.back().kind = SurfaceKind::unknown;
  scopes_.back().semantics.reset();
  building_.building.objects.emplace_back();
  places_.open(tag);
}

CityGmlTextParser::Meaning CityGmlTextParser::begin_part(const XmlTag& tag) {
  scopes_.push_back(scopes_.back());
  begin_object(tag);
  // All parts beyond 65,535 share the last number
  if (building_.parts < std::numeric_limits<std::uint16_t>::max()) ++building_.parts;
  scopes_.back().part = building_.parts;
  return Meaning::part;
}

CityGmlTextParser::Meaning CityGmlTextParser::begin_installation(const XmlTag& tag, CityGmlRole role) {
  scopes_.push_back(scopes_.back());
  begin_object(tag);
  scopes_.back().installation = installations_.size();
  installations_.push_back({role, building_.uses.size()});
  return Meaning::installation;
}

CityGmlTextParser::Meaning CityGmlTextParser::begin_semantics(const XmlTag& tag, CityGmlThing thing) {
  scopes_.push_back(scopes_.back());
  Scope& scope = scopes_.back();
  if (thing == CityGmlThing::boundary) {
    scope.kind = kind_of_semantics(tag.name);
    scope.in_boundary = true;
  }
  scope.semantics = building_.building.semantics.size();
  building_.building.semantics.push_back({scope.kind, {}});
  places_.open(tag);
  return Meaning::semantics;
}

CityGmlTextParser::MaybeMeaning CityGmlTextParser::meaning_of_geometry(const XmlTag& tag) {
  const int lod = tag.name[3] - '0';
  const std::string_view what = tag.name.substr(4);
  if (lod > 3) return std::nullopt;
  if (what == "ImplicitRepresentation") {
    prototype_ = Prototype{use_here(lod, role_here()), false, {}, {}};
    prototype_->use.placement = building_.placements.size();
    return Meaning::prototype;
  }
  const std::optional<CityGmlRole> role = role_of_geometry(lod, what);
  if (!role) return std::nullopt;
  begin_surfaces(use_here(lod, *role), tag);
  return Meaning::surfaces;
}

CityGmlRole CityGmlTextParser::role_here() const {
  const Scope& scope = scopes_.back();
  if (scope.installation) return installations_[*scope.installation].role;
  return scope.in_boundary ? CityGmlRole::boundary : CityGmlRole::shell;
}

CityGmlUse CityGmlTextParser::use_here(int lod, CityGmlRole role) const {
  const Scope& scope = scopes_.back();
  return {lod, scope.part, role, scope.object, scope.semantics, {}};
}

std::optional<CityGmlRole> CityGmlTextParser::role_of_geometry(int lod, std::string_view what) const {
  if (what == "FootPrint" || what == "RoofEdge") return CityGmlRole::outline;
  if (what != "Solid" && what != "MultiSurface" && what != "Geometry") return std::nullopt;
  if (lod > 0) return role_here();
  const Scope& scope = scopes_.back();
  if (what != "MultiSurface" || scope.installation) return std::nullopt;
  const bool is_outline = !scope.in_boundary || scope.kind == SurfaceKind::floor || scope.kind == SurfaceKind::roof;
  return is_outline ? std::optional(CityGmlRole::outline) : std::nullopt;
}

void CityGmlTextParser::begin_surfaces(const CityGmlUse& use, const XmlTag& tag) {
  reader_.begin_use(building_.uses.size());
  building_.uses.push_back(use);
  if (!tag.href.empty()) reader_.add_reference(tag.href);
  in_surfaces_ = true;
}

CityGmlTextParser::MaybeMeaning CityGmlTextParser::meaning_in_prototype(const XmlTag& tag) {
  if (open_.back() == Meaning::prototype_number) return std::nullopt;
  const bool is_matrix = tag.name == "transformationMatrix";
  if (is_matrix || tag.name == "pos" || tag.name == "coordinates") {
    words_ = is_matrix ? &prototype_->matrix : &prototype_->position;
    words_->clear();
    return Meaning::prototype_number;
  }
  if (tag.name != "relativeGMLGeometry" && tag.name != "relativeGeometry") return Meaning::nothing;
  prototype_->has_surfaces = true;
  begin_surfaces(prototype_->use, tag);
  return Meaning::surfaces;
}

void CityGmlTextParser::undo(Meaning meaning) {
  switch (meaning) {
    case Meaning::nothing:
      break;
    case Meaning::building:
      return end_building();
    case Meaning::part:
      return end_object();
    case Meaning::installation:
      return end_installation();
    case Meaning::semantics:
      return end_semantics();
    case Meaning::surfaces:
      in_surfaces_ = false;
      break;
    case Meaning::geometry:
      return reader_.end();
    case Meaning::relation:
      return end_relation();
    case Meaning::prototype:
      return end_prototype();
    case Meaning::prototype_number:
      words_ = nullptr;
      break;
  }
}

void CityGmlTextParser::end_relation() {
  if (words_ != nullptr) installations_.back().is_inside = relation_ == "inside";
  words_ = nullptr;
}

void CityGmlTextParser::end_object() {
  ClosedPlace closed = places_.close();
  building_.building.objects[scopes_.back().object] = closed.place;
  std::ranges::move(closed.names, std::back_inserter(building_.building.names_of_objects));
  scopes_.pop_back();
}

void CityGmlTextParser::end_installation() {
  // CityGML 3.0 says only after the geometry whether an installation is inside
  if (installations_.back().is_inside)
    for (std::size_t k = installations_.back().first_use; k < building_.uses.size(); ++k)
      building_.uses[k].role = CityGmlRole::inside;
  installations_.pop_back();
  end_object();
}

void CityGmlTextParser::end_semantics() {
  ClosedPlace closed = places_.close();
  building_.building.semantics[*scopes_.back().semantics].place = closed.place;
  std::ranges::move(closed.names, std::back_inserter(building_.building.names_of_surfaces));
  scopes_.pop_back();
}

void CityGmlTextParser::end_building() {
  end_object();
  on_(std::move(building_));
  building_ = {};
}

void CityGmlTextParser::end_prototype() {
  const std::vector<double> position = numbers_in(prototype_->position);
  std::optional<PrototypePlacement> placement;
  if (prototype_->has_surfaces && position.size() == 3 && std::isfinite(position[0] + position[1] + position[2])) {
    const Point3d reference_point{position[0], position[1], position[2]};
    if (!has_crs_ || !is_in_degrees(reference_point))
      placement = PrototypePlacement::from(numbers_in(prototype_->matrix), reference_point);
  }
  building_.placements.push_back(placement);
  prototype_.reset();
}

}  // namespace farlod
