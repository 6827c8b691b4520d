// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/citygml/gml_references.hpp"

namespace farlod::ingest {
namespace {

constexpr std::size_t points_of_prototypes = 5'000'000;
/// Two or three buildings share a wall, and each visits it three times.
constexpr std::size_t visits_of_each_point = 16;

}  // namespace

ReferenceBudget::ReferenceBudget(const GmlSurfaces& foreign) : most_points_(points_of_prototypes) {
  for (const GmlPolygon& polygon : foreign.polygons) most_points_ += visits_of_each_point * polygon.point_count();
  left_ = most_points_;
}

bool ReferenceBudget::take(std::size_t points) {
  if (points > left_) left_ = 0;
  if (left_ == 0) {
    ++refusals_;
    return false;
  }
  left_ -= points;
  return true;
}

bool ReferenceBudget::append(const ReferenceBudget& other) {
  const std::size_t given = other.most_points_ - other.left_;
  if (other.refusals_ > 0 || given > left_) return false;
  left_ -= given;
  return true;
}

void ReferenceWalk::each(const GmlMember& member, const std::function<void(const ResolvedPolygon&)>& visit) {
  walk(member, [&](const ResolvedPolygon& p) {
    if (reached_.insert(p.polygon).second) visit(p);
    return false;
  });
}

bool ReferenceWalk::any(const GmlMember& member, const std::function<bool(const GmlPolygon&)>& is_it) {
  return walk(member, [&](const ResolvedPolygon& p) { return is_it(*p.polygon); });
}

bool ReferenceWalk::walk(const GmlMember& member, const IsEnough& is_enough) {
  levels_.clear();
  bool is_found = step(own_, member, false, is_enough);
  while (!is_found && !levels_.empty()) {
    Level& level = levels_.back();
    if (level.next == level.end)
      levels_.pop_back();
    else
      is_found = step(*level.home, level.home->members[level.next++], level.is_reversed, is_enough);
  }
  if (is_found)
    for (const Level& level : levels_) *level.ends_walks = true;
  return is_found;
}

bool ReferenceWalk::step(const GmlSurfaces& home, const GmlMember& member, bool is_reversed, const IsEnough& is_enough) {
  const bool turned = is_reversed != member.is_reversed;
  if (&home == &foreign_ && !budget_.take(member.polygon ? home.polygons[*member.polygon].point_count() : 1)) return false;
  if (!member.polygon) return enter(member.href, turned);
  return is_enough({&home.polygons[*member.polygon], turned, &home == &foreign_});
}

bool ReferenceWalk::enter(const std::string& href, bool is_reversed) {
  const std::string id = href.starts_with('#') ? href.substr(1) : std::string();
  for (const GmlSurfaces* there : {&own_, &foreign_})
    if (const auto found = there->ranges.find(id); !id.empty() && found != there->ranges.end()) {
      const auto [entry, is_new] = entered_.try_emplace(id, false);
      if (!is_new) return entry->second;
      const GmlRange& range = found->second;
      levels_.push_back({there, range.begin, range.end, is_reversed != range.was_reversed, &entry->second});
      return false;
    }
  dangling_.push_back(href);
  return false;
}

}  // namespace farlod::ingest
