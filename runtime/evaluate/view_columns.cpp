// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "evaluate/view_columns.hpp"

#include <cstdio>
#include <string>
#include <utility>

#include "base/expects.hpp"

namespace farlod {
namespace {

/// What is seen, by the word of its column.
using ViewWords = std::vector<std::pair<std::string, std::string>>;

/// "30" or "22.5".
std::string degrees_text(double degrees) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%g", degrees);
  return text.data();
}

ViewWords view_words(std::size_t wall_sectors) {
  constexpr std::array<std::pair<const char*, const char*>, 8> eighths{{{"n", "north"},
                                                                        {"ne", "north-east"},
                                                                        {"e", "east"},
                                                                        {"se", "south-east"},
                                                                        {"s", "south"},
                                                                        {"sw", "south-west"},
                                                                        {"w", "west"},
                                                                        {"nw", "north-west"}}};
  ViewWords words{{"sky", "sky"}, {"ground", "ground"}, {"roof", "roofs"}};
  const std::string within =
      ", within " + degrees_text(180.0 / static_cast<double>(wall_sectors)) + " degrees of its true azimuth";
  for (std::size_t n = 0; n < eighths.size(); n += eighths.size() / wall_sectors) {
    const auto& [word, azimuth] = eighths.at(n);
    words.emplace_back(std::string("wall_") + word, std::string("walls that face ") + azimuth + within);
  }
  words.emplace_back("crown", "crowns of trees, as if nothing passed them");
  words.emplace_back("other", "undersides");
  return words;
}

/// The columns of a view: their names end in `ending`, and `what` is the view that they are shares of.
void describe_view(const Quantities& quantities, const std::string& ending, const std::string& what,
                   std::vector<ColumnDescription>& columns) {
  for (const auto& [word, meaning] : view_words(quantities.wall_sectors))
    columns.push_back({"view_" + (word + ending), "1", "share of " + what + ": " + meaning});
}

}  // namespace

ViewLayout::ViewLayout(std::size_t wall_sectors) : wall_sectors_(wall_sectors) {
  FARLOD_EXPECTS(wall_sectors == 4 || wall_sectors == 8);
  constexpr auto first_wall = static_cast<std::size_t>(ViewClass::first_wall);
  for (std::size_t n = 0; n < first_wall; ++n) columns_[n] = n;
  // A sector is centred at its azimuth: half of its slices lie before it
  const std::size_t slices = wall_slices / wall_sectors;
  for (std::size_t n = 0; n < wall_slices; ++n) columns_[first_wall + n] = first_wall + (n + slices / 2) / slices % wall_sectors;
  for (std::size_t n = first_wall + wall_slices; n < view_class_count; ++n) columns_[n] = n - wall_slices + wall_sectors;
}

void describe_views(const Quantities& quantities, std::vector<ColumnDescription>& columns) {
  describe_view(quantities, "", "the view, weighted as svf is", columns);
}

void describe_views_below(const Quantities& quantities, std::vector<ColumnDescription>& columns) {
  std::vector<ColumnDescription> below;
  describe_view(quantities, "_below", "the view, weighted as svf is, below the horizontal", below);
  columns.insert(columns.end(), below.begin() + 1, below.end());
}

void describe_views_of_cube(const Quantities& quantities, std::vector<ColumnDescription>& columns) {
  for (const FaceOfCube& face : faces_of_cube)
    describe_view(quantities, std::string("_") + face.word,
                  std::string("the view of the ") + face.meaning + " face of a cube, weighted by the cosine", columns);
}

void describe_views_of_sphere(const Quantities& quantities, std::vector<ColumnDescription>& columns) {
  describe_view(quantities, "_sphere", "the solid angle of all directions around", columns);
}

void describe_views_of_eye(const Quantities& quantities, std::vector<ColumnDescription>& columns) {
  const std::string field = degrees_text(quantities.eye_field_deg);
  describe_view(quantities, "_eye", "the solid angle within " + field + " degrees of the horizontal, at all azimuths", columns);
}

void describe_view_of_building(const Quantities& quantities, std::vector<ColumnDescription>& columns) {
  const std::string building = "building " + quantities.seen_building.value_or("");
  columns.push_back({"view_building", "1", "share of the view, weighted as svf is: " + building});
  columns.push_back({"sees_building", "1", "1 where anything is seen of " + building + ", else 0"});
}

}  // namespace farlod
