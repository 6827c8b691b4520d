// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "results/city/citygml_building.hpp"
#include "results/city/citygml_names.hpp"
#include "results/city/citygml_places.hpp"
#include "results/city/citygml_surfaces.hpp"
#include "results/city/xml_text.hpp"

namespace farlod {

/// Parses CityGML 1.0, 2.0 and 3.0 as farlod-pack does, building by building.
class CityGmlTextParser : public XmlTextReader {
 public:
  using OnBuilding = std::function<void(CityGmlBuildingText&&)>;
  explicit CityGmlTextParser(OnBuilding on) : on_(std::move(on)) {}

  void bind(std::string_view prefix, std::string_view space) override { places_.bind(prefix, space); }
  void unbind() override { places_.unbind(); }
  void start(const XmlTag& tag) override;
  void end(std::size_t end) override;
  void text(std::string_view piece) override;

  [[nodiscard]] const std::string& root() const { return root_; }
  [[nodiscard]] const std::vector<GenericAttributeForm>& forms() const { return places_.forms(); }

 private:
  /// The role of an open element. It is undone when the element ends.
  enum class Meaning {
    nothing,
    building,
    part,
    installation,
    semantics,
    surfaces,
    geometry,
    relation,
    prototype,
    prototype_number
  };
  /// Empty: the element is skipped with everything inside it.
  using MaybeMeaning = std::optional<Meaning>;

  /// What surrounds a surface.
  struct Scope {
    std::size_t part = 0, object = 0;
    std::optional<std::size_t> semantics, installation;
    SurfaceKind kind = SurfaceKind::unknown;
    bool in_boundary = false;
  };
  struct Installation {
    CityGmlRole role = CityGmlRole::installation;
    std::size_t first_use = 0;
    bool is_inside = false;
  };
  /// An ImplicitGeometry.
  struct Prototype {
    CityGmlUse use;
    bool has_surfaces = false;
    std::string matrix, position;
  };

  void begin_building(const XmlTag& tag);
  [[nodiscard]] MaybeMeaning meaning_of(const XmlTag& tag);
  [[nodiscard]] MaybeMeaning meaning_of_thing(const XmlTag& tag, CityGmlThing thing);
  [[nodiscard]] MaybeMeaning meaning_in_prototype(const XmlTag& tag);
  [[nodiscard]] MaybeMeaning meaning_of_geometry(const XmlTag& tag);
  [[nodiscard]] std::optional<CityGmlRole> role_of_geometry(int lod, std::string_view what) const;
  [[nodiscard]] CityGmlRole role_here() const;
  [[nodiscard]] CityGmlUse use_here(int lod, CityGmlRole role) const;
  void begin_surfaces(const CityGmlUse& use, const XmlTag& tag);
  [[nodiscard]] Meaning begin_part(const XmlTag& tag);
  [[nodiscard]] Meaning begin_installation(const XmlTag& tag, CityGmlRole role);
  [[nodiscard]] Meaning begin_semantics(const XmlTag& tag, CityGmlThing thing);
  void begin_object(const XmlTag& tag);
  void undo(Meaning meaning);
  void end_relation();
  void end_object();
  void end_installation();
  void end_semantics();
  void end_building();
  void end_prototype();

  OnBuilding on_;
  CityGmlPlaces places_;
  CityGmlBuildingText building_;
  CityGmlSurfaceReader reader_{building_.surfaces};
  std::vector<Meaning> open_;
  std::vector<Scope> scopes_;  ///< empty outside of buildings
  std::vector<Installation> installations_;
  std::optional<Prototype> prototype_;
  std::string root_;
  std::string* words_ = nullptr;  ///< where the text of the current element goes
  std::string relation_;
  std::size_t skipped_depth_ = 0, buildings_ = 0;
  bool in_surfaces_ = false, has_crs_ = false;
};

}  // namespace farlod
