// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/city/citygml_city.hpp"

#include <cmath>
#include <utility>

#include "results/city/citygml_building.hpp"
#include "results/city/citygml_parser.hpp"

namespace farlod {
namespace {

/// What farlod-pack takes over from outside of buildings in a file, as docs/stages/ingest.md tells.
constexpr std::size_t visits_of_each_point = 16, points_of_prototypes = 5'000'000;
/// The file is read once more for each step of a chain of references.
constexpr int most_searches = 6;

using References = std::unordered_set<std::string>;

/// Finds the surfaces with given ids anywhere in a file.
class ForeignSurfaceFinder : public XmlTextReader {
 public:
  explicit ForeignSurfaceFinder(const References& hrefs) : hrefs_(hrefs) {}

  void start(const XmlTag& tag) override {
    if (skipped_depth_ > 0) {
      ++skipped_depth_;
    } else if (wanted_depth_ > 0 || (!tag.id.empty() && hrefs_.contains("#" + std::string(tag.id)))) {
      ++(reader_.start(tag) ? wanted_depth_ : skipped_depth_);
    }
  }
  void end(std::size_t /*end*/) override {
    if (skipped_depth_ > 0) {
      --skipped_depth_;
    } else if (wanted_depth_ > 0) {
      reader_.end();
      --wanted_depth_;
    }
  }
  void text(std::string_view piece) override {
    if (wanted_depth_ > 0 && skipped_depth_ == 0) reader_.text(piece);
  }
  [[nodiscard]] CityGmlSurfaces& found() { return found_; }

 private:
  const References& hrefs_;
  CityGmlSurfaces found_;
  CityGmlSurfaceReader reader_{found_};
  std::size_t wanted_depth_ = 0, skipped_depth_ = 0;
};

/// Surfaces that are found may refer on. The search ends when nothing new is referred to.
CityGmlSurfaces surfaces_behind(References hrefs, std::string_view text) {
  if (hrefs.empty()) return {};
  for (int search = 1;; ++search) {
    ForeignSurfaceFinder finder(hrefs);
    read_xml_text(text, finder);
    const std::size_t known = hrefs.size();
    for (const CityGmlMember& member : finder.found().members)
      if (!member.polygon) hrefs.insert(member.href);
    if (hrefs.size() == known || search == most_searches) return std::move(finder.found());
  }
}

/// Adds the references of a building to what it does not contain.
void add_foreign(const CityGmlBuildingText& building, References& hrefs) {
  const CityGmlSurfaces none;
  std::size_t foreign_left = 0;
  CityGmlWalk walk(building.surfaces, none, foreign_left);
  for (const CityGmlMember& member : building.surfaces.members)
    if (!member.polygon) walk.each(member, [](const ReachedPolygon&) {});
  hrefs.insert(walk.dangling().begin(), walk.dangling().end());
}

std::size_t points_of(const CityGmlPolygon& polygon) {
  std::size_t points = 1;
  for (const FileRing& ring : polygon.rings) points += ring.size();
  return points;
}

bool has_degrees_alone(const CityGmlSurfaces& surfaces) {
  for (const CityGmlPolygon& polygon : surfaces.polygons)
    for (const FileRing& ring : polygon.rings)
      for (const Point3d& p : ring)
        if (std::abs(p.x) > 360.0 || std::abs(p.y) > 360.0) return false;
  return true;
}

}  // namespace

CityGmlCity::CityGmlCity(std::string text) : text_(std::move(text)) {
  References hrefs;
  std::unordered_set<std::string> ids;
  CityGmlTextParser parser([&](CityGmlBuildingText&& read) {
    if (!ids.insert(read.building.id).second) repeated_ids_.insert(read.building.id);
    has_degrees_ = has_degrees_ && has_degrees_alone(read.surfaces);
    add_foreign(read, hrefs);
  });
  read_xml_text(text_, parser);
  if (parser.root() != "CityModel") throw XmlTextError("it begins with <" + parser.root() + ">");
  forms_ = parser.forms();
  foreign_ = surfaces_behind(std::move(hrefs), text_);
  for (const CityGmlPolygon& polygon : foreign_.polygons) foreign_points_ += points_of(polygon);
}

std::size_t CityGmlCity::bytes() const {
  return text_.size() + foreign_points_ * sizeof(Point3d) + foreign_.members.size() * sizeof(CityGmlMember);
}

void CityGmlCity::for_each_building(PackedLod lod, const std::function<void(const FileBuilding&)>& on) const {
  std::size_t foreign_left = points_of_prototypes + visits_of_each_point * foreign_points_;
  CityGmlTextParser parser([&](CityGmlBuildingText&& read) { on(numbered(std::move(read), foreign_, lod, foreign_left)); });
  read_xml_text(text_, parser);
}

std::string CityGmlCity::text_of(const CityAttributes& attributes, std::size_t form) const {
  const GenericAttributeForm& around = forms_[form];
  std::string text;
  for (const auto& [name, value] : attributes)
    text.append(around.before_name).append(name).append(around.before_value).append(value).append(around.behind_value);
  return text;
}

}  // namespace farlod
