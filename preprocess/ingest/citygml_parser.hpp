// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "ingest/citygml_building.hpp"
#include "ingest/xml_element.hpp"

namespace farlod {

/// What listens to the elements of an XML file.
class XmlListener {
 public:
  virtual ~XmlListener() = default;
  virtual void start(const XmlElement& element) = 0;
  virtual void end(std::string_view name) = 0;
  virtual void text(std::string_view piece) = 0;
};

/// Understands CityGML 1.0, 2.0 and 3.0, building by building; holds one building at a time. Bridges are buildings to it.
/// Elements of vocabularies that it does not know are passed over with all they hold.
class CityGmlParser : public XmlListener {
 public:
  using TakeBuilding = std::function<void(const CityGmlBuilding&)>;
  explicit CityGmlParser(TakeBuilding take) : take_(std::move(take)) {}

  void start(const XmlElement& element) override;
  void end(std::string_view name) override;
  void text(std::string_view piece) override;

  [[nodiscard]] const std::string& srs_name() const { return srs_name_; }
  [[nodiscard]] const std::string& root() const { return root_; }

 private:
  /// What an open element is to us; it is undone when the element ends.
  enum class Meaning { nothing, building, part, boundary, installation, surfaces, geometry, height };

  [[nodiscard]] Meaning meaning_outside(const XmlElement& element);
  [[nodiscard]] bool is_passed_over(const XmlElement& element) const;
  [[nodiscard]] Meaning meaning_inside(const XmlElement& element);
  [[nodiscard]] bool start_surfaces(const XmlElement& element);
  void begin_building(const XmlElement& element);
  void begin_part();
  void end_building();
  void undo(Meaning meaning, std::string_view name);
  void take_height();

  TakeBuilding take_;
  std::vector<Meaning> open_;
  std::size_t passed_over_ = 0;  ///< depth inside an element that is passed over
  CityGmlBuilding building_;
  GmlSurfaceReader reader_{building_.surfaces};
  bool in_building_ = false, in_surfaces_ = false, in_height_ = false;
  std::vector<std::uint16_t> parts_;
  std::vector<SurfaceKind> kinds_;
  std::size_t boundaries_ = 0, installations_ = 0, buildings_ = 0;
  std::string height_text_, srs_name_, root_;
};

/// Finds the surfaces with certain ids anywhere in a file, for buildings that refer to what is not their own.
class GmlSurfaceFinder : public XmlListener {
 public:
  explicit GmlSurfaceFinder(const std::unordered_set<std::string>& hrefs) : hrefs_(hrefs) {}

  void start(const XmlElement& element) override;
  void end(std::string_view name) override;
  void text(std::string_view piece) override;

  [[nodiscard]] const GmlSurfaces& found() const { return found_; }

 private:
  const std::unordered_set<std::string>& hrefs_;
  GmlSurfaces found_;
  GmlSurfaceReader reader_{found_};
  std::size_t wanted_depth_ = 0, passed_over_ = 0;
};

}  // namespace farlod
