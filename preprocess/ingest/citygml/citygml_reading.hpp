// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "city/city_model.hpp"
#include "farlod/problem.hpp"
#include "ingest/citygml/citygml_building.hpp"
#include "ingest/citygml/citygml_vocabulary.hpp"
#include "ingest/citygml/citygml_xml.hpp"
#include "ingest/citygml/gml_surfaces.hpp"
#include "ingest/files/input_file.hpp"
#include "ingest/model_builder/city_model_builder.hpp"

namespace farlod::ingest {

/// Parses CityGML 1.0, 2.0 and 3.0, building by building. Holds one building at a time, and the points of the relief.
/// Bridges, tunnels and other constructions count as buildings. Elements of unknown vocabularies, and all other objects of the
/// city, are skipped with everything inside them, and counted.
class CityGmlParser : public XmlListener {
 public:
  using TakeBuilding = std::function<void(const CityGmlBuilding&)>;
  /// `has_crs`: whether an earlier segment of the file names a CRS. `forms`: those of attributes in earlier segments.
  explicit CityGmlParser(TakeBuilding take, bool has_crs = false, std::vector<package::AttributeForm> forms = {})
      : take_(std::move(take)), has_crs_(has_crs), places_(std::move(forms)) {}

  void bind(std::string_view prefix, std::string_view space) override { places_.bind(prefix, space); }
  void unbind() override { places_.unbind(); }
  void start(const XmlElement& element) override;
  void end(std::string_view name, std::uint64_t end) override;
  void text(std::string_view piece) override;

  /// Adds what was found in the next segment of the file, but for its buildings. Returns false when the segment would have been
  /// read otherwise had one parser read both: a building without an id is called by its number in the file, where a prototype is
  /// placed depends on whether a CRS was named before it, and forms of attributes are numbered as they occur.
  [[nodiscard]] bool append(const CityGmlParser& next);

  [[nodiscard]] const std::string& srs_name() const { return srs_name_; }
  [[nodiscard]] const std::string& root() const { return root_; }
  [[nodiscard]] ReliefReader& relief() { return relief_; }
  [[nodiscard]] const SkippedFeatures& skipped() const { return skipped_.counts(); }
  [[nodiscard]] const std::vector<package::AttributeForm>& forms() const { return places_.forms(); }

 private:
  /// The role of an open element. It is undone when the element ends.
  enum class Meaning {
    nothing,
    members,  ///< contains an object of the city
    building,
    part,
    boundary,
    opening,  ///< a window or a door: a semantic surface of the kind of what it is in
    installation,
    surfaces,
    geometry,
    height,
    relation,   ///< whether an installation is inside
    prototype,  ///< implicit geometry
    prototype_number,
    terrain,
  };
  /// Empty: the element is skipped with everything inside it.
  using MaybeMeaning = std::optional<Meaning>;

  [[nodiscard]] MaybeMeaning meaning_of(const XmlElement& element);
  [[nodiscard]] MaybeMeaning meaning_outside(const XmlElement& element);
  [[nodiscard]] MaybeMeaning meaning_in_relief(const XmlElement& element);
  [[nodiscard]] MaybeMeaning meaning_inside(const XmlElement& element);
  [[nodiscard]] MaybeMeaning meaning_in_surfaces(const XmlElement& element);
  [[nodiscard]] MaybeMeaning meaning_in_prototype(const XmlElement& element);
  [[nodiscard]] MaybeMeaning meaning_of_thing(const XmlElement& element, Vocabulary vocabulary);
  [[nodiscard]] MaybeMeaning meaning_of_lod_property(const XmlElement& element);
  [[nodiscard]] Meaning begin_words(Meaning meaning);
  [[nodiscard]] std::optional<SurfaceRole> role_of_lod_property(int lod, std::string_view what) const;
  [[nodiscard]] SurfaceRole role_here() const;
  void begin_building(const XmlElement& element);
  void begin_part(const XmlElement& element);
  void begin_installation(const XmlElement& element, SurfaceRole role);
  /// An object, or a semantic surface, to which all that follows belongs until the place is closed.
  void open_object(const XmlElement& element);
  void open_semantics(const XmlElement& element);
  void close_place();
  [[nodiscard]] SurfaceUse use_here(int lod, SurfaceRole role) const;
  void begin_surfaces(const SurfaceUse& use, const XmlElement& element);
  void end_building();
  void end_installation();
  void end_prototype();
  void take_height();
  void undo(Meaning meaning, std::string_view name);

  /// An installation or element: a balcony, a pylon.
  struct Installation {
    SurfaceRole role = SurfaceRole::installation;
    std::size_t first_use = 0;
    bool is_inside = false;
  };

  TakeBuilding take_;
  bool has_crs_ = false, has_unnamed_buildings_ = false, has_placed_without_crs_ = false;
  std::vector<Meaning> open_;
  std::size_t skipped_depth_ = 0;
  SkippedCount skipped_;
  CityGmlBuilding building_;
  GmlSurfaceReader reader_{building_.surfaces};
  ReliefReader relief_;
  PrototypeReader prototype_;
  bool in_building_ = false, in_surfaces_ = false, in_relief_ = false, in_prototype_ = false, in_words_ = false;
  std::vector<std::uint16_t> parts_;
  std::vector<SurfaceKind> kinds_;
  std::vector<Installation> installations_;
  std::vector<PolygonOrigin> origins_;  ///< of what is open, the innermost last
  CityGmlPlaces places_;
  std::size_t boundaries_ = 0, buildings_ = 0;
  std::string words_, srs_name_, root_;
};

/// What was read of a file.
struct CityGmlContents {
  SourceCity city;
  Report report;
  std::unordered_set<std::string> foreign_hrefs;  ///< references of buildings to what is outside of them
};

/// A file to read, and how.
struct ReadingTask {
  const InputFile& file;
  LodChoice lod;
  const GmlSurfaces& foreign;  ///< what buildings refer to outside of themselves
  std::stop_token stop;
  SegmentSizes segments;
};

/// Makes the city of a whole file, or of a segment of it that `append` adds to what comes before.
class CityGmlReading {
 public:
  /// `budget`: nothing is taken of it yet. `has_crs`: whether an earlier segment names a CRS.
  /// `forms`: those of attributes in earlier segments.
  CityGmlReading(const ReadingTask& task, const ReferenceBudget& budget, RepeatedIds repeated_ids, bool has_crs = false,
                 std::vector<package::AttributeForm> forms = {});

  /// What the file, or the segment, is passed to.
  [[nodiscard]] XmlListener& listener() { return parser_; }
  [[nodiscard]] bool has_crs() const { return !parser_.srs_name().empty(); }
  [[nodiscard]] const std::vector<package::AttributeForm>& forms() const { return parser_.forms(); }
  /// Adds the next segment. Throws CannotBeCut where the two would have been read otherwise as one.
  void append(CityGmlReading&& next);
  /// Throws InputError when there is neither a building nor terrain.
  [[nodiscard]] CityGmlContents finish();

 private:
  void take(const CityGmlBuilding& building);
  [[noreturn]] void throw_nothing_there() const;
  void report_unreadable_relief(std::size_t points);

  const ReadingTask& task_;
  bool has_places_;
  Report report_;
  ReferenceBudget budget_;
  CityModelBuilder builder_;
  CityGmlParser parser_;
  std::unordered_set<std::string> foreign_hrefs_;
};

}  // namespace farlod::ingest
