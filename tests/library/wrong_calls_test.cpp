// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "farlod/error.hpp"
#include "farlod/points.hpp"
#include "farlod/raster.hpp"
#include "farlod/surfaces.hpp"
#include "tests/library/library_calls.hpp"
#include "tests/library/packed_sample.hpp"

namespace farlod::library {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// What a caller threw from his callback.
struct Thrown : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The kind of exception that a wrong call ends with.
namespace ends {
constexpr std::string_view invalid = "InvalidArgument", invalid_point = "InvalidPoint", limit = "LimitReached",
                           cancelled = "Cancelled", with_what_was_thrown = "what was thrown";
}  // namespace ends

using Change = std::function<void(Arguments&)>;

struct WrongCall {
  std::string name;
  Call call;
  std::string_view ends;
  Change change;
};

class Cases {
 public:
  void add(const std::vector<Named>& calls, const std::string& name, std::string_view ends, const Change& change) {
    for (const Named& named : calls) list_.push_back({named.name + ": " + name, named.call, ends, change});
  }
  void add(const std::vector<Named>& calls, const std::string& name, const Change& change) {
    add(calls, name, ends::invalid, change);
  }
  [[nodiscard]] const std::vector<WrongCall>& list() const { return list_; }

 private:
  std::vector<WrongCall> list_;
};

void add_settings(Cases& cases) {
  const std::vector<Named> all{points_into, points, tiles, raster, window, surfaces};
  const auto with = [](auto member, auto value) { return [=](Arguments& a) { a.settings.*member = value; }; };
  using S = EvaluationSettings;
  cases.add(all, "no such engine", with(&S::engine, static_cast<Engine>(77)));
  cases.add(all, "engine below the first", with(&S::engine, static_cast<Engine>(-1)));
  cases.add(all, "no such weight", with(&S::weight, static_cast<SkyWeight>(2)));
  cases.add(all, "no such set of directions", with(&S::directions, static_cast<DirectionSet>(9)));
  for (const std::size_t n : {std::size_t{0}, std::size_t{3}, std::size_t{1'000'001}, std::numeric_limits<std::size_t>::max()})
    cases.add(all, "azimuths " + std::to_string(n), with(&S::azimuths, n));
  for (const std::size_t n : {std::size_t{0}, std::size_t{10'000'001}, std::numeric_limits<std::size_t>::max()})
    cases.add(all, "rays " + std::to_string(n), with(&S::rays, n));
  for (const double e : {0.0, -0.1, 0.00009, 1.1, nan, infinity})
    cases.add(all, "max_error " + std::to_string(e), with(&S::max_error, e));
  cases.add(all, "an error that so few rays cannot keep", [](Arguments& a) {
    a.settings.max_error = 0.001;
    a.settings.engine = Engine::rays;
    a.settings.rays = 10;
    a.settings.further.svf_total = true;
  });
  cases.add(all, "bounds with few azimuths", [](Arguments& a) {
    a.settings.azimuths = 7;
    a.settings.bounds = true;
  });
  cases.add(all, "bounds without the far city", [](Arguments& a) {
    a.settings.engine = Engine::near_only;
    a.settings.bounds = true;
    a.low = a.high = a.svf;
  });
  cases.add(all, "a largest error without the far city", [](Arguments& a) {
    a.settings.engine = Engine::near_only;
    a.settings.max_error = 0.01;
  });
  cases.add(all, "light to the eye of light that tells none", [](Arguments& a) {
    a.settings.further.illuminance = true;
    a.settings.further.light = Light{{LightInterval{}}};
  });
}

void add_views(Cases& cases) {
  const std::vector<Named> all{points_into, points, tiles, raster, window, surfaces};
  for (const std::size_t n : {0U, 1U, 6U, 16U})
    cases.add(all, "sectors " + std::to_string(n), [=](Arguments& a) { a.settings.further.wall_sectors = n; });
  for (const double field_deg : {0.0, 0.9, 90.1, -30.0, nan, infinity})
    cases.add(all, "a field of " + std::to_string(field_deg),
              [=](Arguments& a) { a.settings.further.eye_field_deg = field_deg; });
  for (const std::string id : {"", "no such building"})
    cases.add(all, "looking for \"" + id + "\"", [=](Arguments& a) { a.settings.further.seen_building = id; });
  cases.add(all, "faces of a cube beside solid angles", [](Arguments& a) {
    a.settings.weight = SkyWeight::solid_angle;
    a.settings.further.view_cube = true;
  });
  for (const auto member : {&Quantities::view_cube, &Quantities::view_sphere, &Quantities::view_eye})
    cases.add({surfaces}, "what is seen around a surface", [=](Arguments& a) { a.settings.further.*member = true; });
}

void add_limits(Cases& cases) {
  const std::vector<Named> all{points_into, points, tiles, raster, window, surfaces};
  cases.add(all, "too small a limit", ends::limit, [](Arguments& a) { a.run.memory_limit_mib = 1; });
  cases.add(all, "a caller who holds all there is", ends::limit, [](Arguments& a) {
    a.run.memory_limit_mib = 1ULL << 40;
    a.run.caller_bytes = std::numeric_limits<std::uint64_t>::max();
  });
  cases.add(all, "too many azimuths for the limit", ends::limit, [](Arguments& a) {
    a.settings.azimuths = 1'000'000;
    a.run.threads = 1;
    a.run.memory_limit_mib = 400;
  });
  cases.add(all, "too many rays for the limit", ends::limit, [](Arguments& a) {
    a.settings.engine = Engine::rays;
    a.settings.rays = 10'000'000;
    a.run.threads = 1;
    a.run.memory_limit_mib = 2000;
  });
  // Told before there is memory for pixels
  const auto with_40_gb = [](Arguments& a) { a.plan.rows = a.plan.columns = 100'000; };
  cases.add({raster, window}, "40 GB of pixels", ends::limit, [=](Arguments& a) {
    with_40_gb(a);
    a.run.memory_limit_mib = 1024;
  });
  cases.add({raster, window}, "40 GB of pixels of a closed package", [=](Arguments& a) {
    with_40_gb(a);
    a.package.close();
  });
}

void add_runs(Cases& cases) {
  const std::vector<Named> all{points_into, points, tiles, raster, window, surfaces, check, outlines, heights, plan_of_heights};
  cases.add(all, "too many threads", [](Arguments& a) { a.run.threads = 5000; });
  cases.add(all, "a limit of nothing", [](Arguments& a) { a.run.memory_limit_mib = 0; });
  cases.add(all, "an absurd limit", [](Arguments& a) { a.run.memory_limit_mib = 1ULL << 60; });
  cases.add(all, "stopped before it began", ends::cancelled, [](Arguments& a) {
    std::stop_source stop;
    stop.request_stop();
    a.run.stop = stop.get_token();
  });
  cases.add(all, "stopped by its progress", ends::cancelled, [](Arguments& a) {
    const auto stop = std::make_shared<std::stop_source>();
    a.run.stop = stop->get_token();
    a.settings.verify = 1000;  // so that there is work after the last cell
    a.run.on_progress = [stop](const Progress&) { stop->request_stop(); };
  });
  cases.add(all, "a progress that throws", ends::with_what_was_thrown,
            [](Arguments& a) { a.run.on_progress = [](const Progress&) { throw Thrown("progress"); }; });
}

void add_closed_packages(Cases& cases) {
  const std::vector<Named> all{points_into, points,      tiles,     raster,       window,         surfaces,
                               plan,        description, inventory, height_range, cell_contents,  geometry,
                               far_view,    check,       outlines,  heights,      plan_of_heights};
  cases.add(all, "a closed package", [](Arguments& a) { a.package.close(); });
  cases.add(all, "a package closed twice", [](Arguments& a) {
    a.package.close();
    a.package.close();
  });
  cases.add(all, "a package that was moved", [](Arguments& a) { const Package taken = std::move(a.package); });
}

void add_placings(Cases& cases) {
  const std::vector<Named> all{points_into, points, tiles, raster, window};
  for (const double h : {nan, infinity, -1.0, 10'001.0})
    cases.add(all, "height " + std::to_string(h), [h](Arguments& a) { a.placing.height_m = h; });
  cases.add(all, "above no such thing", [](Arguments& a) { a.placing.above = static_cast<HeightAbove>(3); });
}

void add_points(Cases& cases) {
  const std::vector<Named> both{points_into, points};
  cases.add(both, "one y too few", [](Arguments& a) { a.y.pop_back(); });
  cases.add(both, "one y too many", [](Arguments& a) { a.y.push_back(0.0); });
  cases.add(both, "no y at all", [](Arguments& a) { a.y.clear(); });
  cases.add(both, "one z too few", [](Arguments& a) { a.z = {1.0}; });
  cases.add(both, "one z too many", [](Arguments& a) { a.z = {1.0, 2.0, 3.0}; });
  for (const double c : {nan, infinity, -infinity, 2e8}) {
    cases.add(both, "x " + std::to_string(c), ends::invalid_point, [c](Arguments& a) { a.x[1] = c; });
    cases.add(both, "y " + std::to_string(c), ends::invalid_point, [c](Arguments& a) { a.y[1] = c; });
  }
  for (const double z : {infinity, -infinity, 2e5})
    cases.add(both, "z " + std::to_string(z), ends::invalid_point, [z](Arguments& a) { a.z = {1.0, z}; });
  const std::vector<Named> into{points_into};
  cases.add(into, "svf too short", [](Arguments& a) { a.svf.pop_back(); });
  cases.add(into, "svf too long", [](Arguments& a) { a.svf.push_back(0.0F); });
  cases.add(into, "no svf", [](Arguments& a) { a.svf.clear(); });
  cases.add(into, "heights too short", [](Arguments& a) { a.height_m = {0.0}; });
  cases.add(into, "heights too long", [](Arguments& a) { a.height_m = {0.0, 0.0, 0.0}; });
  cases.add(into, "bounds not asked for", [](Arguments& a) { a.low = a.high = a.svf; });
  cases.add(into, "bounds asked for, and no room", [](Arguments& a) { a.settings.bounds = true; });
  cases.add(into, "no room for the upper bound", [](Arguments& a) {
    a.settings.bounds = true;
    a.low = a.svf;
  });
  cases.add(into, "too little room for the lower bound", [](Arguments& a) {
    a.settings.bounds = true;
    a.low = {0.0F};
    a.high = a.svf;
  });
}

void add_normals(Cases& cases) {
  const std::vector<Named> both{points_into, points};
  const auto with = [&](const std::string& name, const std::vector<double>& azimuth_deg, const std::vector<double>& tilt_deg,
                        std::string_view ends) {
    const auto change = [=](Arguments& a) {
      for (const double d : azimuth_deg) a.azimuth.push_back(Angle::degrees(d));
      for (const double d : tilt_deg) a.tilt.push_back(Angle::degrees(d));
    };
    cases.add(both, name, ends, change);
  };
  with("azimuths without tilts", {0.0, 0.0}, {}, ends::invalid);
  with("tilts without azimuths", {}, {0.0, 0.0}, ends::invalid);
  with("one azimuth too few", {0.0}, {0.0, 0.0}, ends::invalid);
  with("one tilt too many", {0.0, 0.0}, {0.0, 0.0, 0.0}, ends::invalid);
  for (const double d : {nan, infinity, -361.0, 361.0})
    with("azimuth " + std::to_string(d), {0.0, d}, {0.0, 90.0}, ends::invalid_point);
  for (const double d : {infinity, -1.0, 181.0}) with("tilt " + std::to_string(d), {0.0, 0.0}, {0.0, d}, ends::invalid_point);
}

void add_rasters(Cases& cases) {
  const std::vector<Named> both{tiles, raster, window, heights};
  for (const double step_m : {nan, infinity, 0.0, -2.0, 0.001, 1e6})
    cases.add({tiles, raster, heights, plan}, "step " + std::to_string(step_m),
              [step_m](Arguments& a) { a.plan.step_m = step_m; });
  for (const double c : {nan, infinity, -2e8}) {
    cases.add(both, "west " + std::to_string(c), [c](Arguments& a) { a.plan.north_west_m.x = c; });
    cases.add(both, "north " + std::to_string(c), [c](Arguments& a) { a.plan.north_west_m.y = c; });
  }
  cases.add(both, "no columns", [](Arguments& a) { a.plan.columns = 0; });
  cases.add(both, "no rows", [](Arguments& a) { a.plan.rows = 0; });
  cases.add(both, "too many pixels", [](Arguments& a) { a.plan.rows = a.plan.columns = 1'000'000; });
  cases.add(both, "more pixels than can be counted",
            [](Arguments& a) { a.plan.rows = a.plan.columns = std::numeric_limits<std::size_t>::max(); });
  cases.add({tiles}, "nobody takes the tiles", [](Arguments& a) { a.on_tile = {}; });
  cases.add({tiles}, "who takes the tiles throws", ends::with_what_was_thrown,
            [](Arguments& a) { a.on_tile = [](const RasterTile&) { throw Thrown("tile"); }; });
  const auto part = [&](const std::string& name, const Box2d& box) {
    cases.add({{"plan", [box](Arguments& a) { (void)plan_raster(a.package, 1.0, box); }}}, name, [](Arguments&) {});
  };
  part("an empty part", {});
  part("a part turned round", {{10.0, 10.0}, {0.0, 0.0}});
  part("a part without width", {{5.0, 0.0}, {5.0, 10.0}});
  part("a part at no place", {{nan, 0.0}, {1.0, 1.0}});
  part("a part without end", {{0.0, 0.0}, {infinity, 1.0}});
  part("a part of too many pixels", {{-9e7, -9e7}, {9e7, 9e7}});
}

void add_surfaces(Cases& cases) {
  for (const double s : {nan, infinity, 0.0, -1.0, 0.01, 1e4})
    cases.add({surfaces, matrix}, "spacing " + std::to_string(s), [s](Arguments& a) { a.surfaces.spacing_m = s; });
  cases.add({surfaces}, "a threshold of nothing", [](Arguments& a) { a.surfaces.irradiation_threshold_kwh_m2 = 800.0; });
  for (const double t : {nan, infinity, -1.0, 100'001.0})
    cases.add({surfaces}, "threshold " + std::to_string(t), [t](Arguments& a) {
      a.settings.further.irradiation = true;
      a.settings.further.light.emplace();
      a.surfaces.irradiation_threshold_kwh_m2 = t;
    });
  cases.add({surfaces, matrix}, "no such choice", [](Arguments& a) { a.surfaces.choice = static_cast<SurfaceChoice>(3); });
  cases.add({surfaces}, "who takes the points throws", ends::with_what_was_thrown,
            [](Arguments& a) { a.on_points = [](std::size_t, std::span<const SurfacePoint>) { throw Thrown("points"); }; });
}

void add_matrix(Cases& cases) {
  for (const double t : {nan, -0.1, 1.1})
    cases.add({matrix}, "threshold " + std::to_string(t), [t](Arguments& a) { a.matrix.threshold = t; });
  cases.add({matrix}, "weighted by solid angle", [](Arguments& a) { a.settings.weight = SkyWeight::solid_angle; });
  cases.add({matrix}, "no rays", [](Arguments& a) { a.settings.rays = 0; });
  cases.add({matrix}, "too small a limit", ends::limit, [](Arguments& a) { a.run.memory_limit_mib = 1; });
  cases.add({matrix}, "too many threads", [](Arguments& a) { a.run.threads = 5000; });
  cases.add({matrix}, "a closed package", [](Arguments& a) { a.package.close(); });
  cases.add({matrix}, "stopped before it began", ends::cancelled, [](Arguments& a) {
    std::stop_source stop;
    stop.request_stop();
    a.run.stop = stop.get_token();
  });
}

void add_inspections(Cases& cases) {
  cases.add({check, outlines, heights, plan_of_heights}, "too small a limit", ends::limit,
            [](Arguments& a) { a.run.memory_limit_mib = 1; });
  const std::vector<Named> of_a_cell{cell_contents, far_view};
  cases.add(of_a_cell, "a cell to the west of all", [](Arguments& a) { --a.cell.i; });
  cases.add(of_a_cell, "a cell at no place", [](Arguments& a) { a.cell.j = std::numeric_limits<std::int32_t>::max(); });
  cases.add({geometry}, "no cells", [](Arguments& a) { a.cells.i_end = a.cells.i_begin; });
  cases.add({geometry}, "cells turned round", [](Arguments& a) { std::swap(a.cells.j_begin, a.cells.j_end); });
  cases.add({geometry}, "too many cells", [](Arguments& a) { a.cells.i_end = a.cells.i_begin + 10'001; });
  cases.add({geometry}, "more cells than can be counted", [](Arguments& a) {
    a.cells = {std::numeric_limits<std::int32_t>::min(), std::numeric_limits<std::int32_t>::min(),
               std::numeric_limits<std::int32_t>::max(), std::numeric_limits<std::int32_t>::max()};
  });
  cases.add({outlines}, "an empty part", [](Arguments& a) { a.part = {}; });
  cases.add({outlines}, "a part turned round", [](Arguments& a) { std::swap(a.part.low, a.part.high); });
  cases.add({outlines}, "a part at no place", [](Arguments& a) { a.part.low.x = nan; });
}

std::vector<WrongCall> all_wrong_calls() {
  Cases cases;
  add_inspections(cases);
  add_settings(cases);
  add_views(cases);
  add_limits(cases);
  add_runs(cases);
  add_closed_packages(cases);
  add_placings(cases);
  add_points(cases);
  add_normals(cases);
  add_rasters(cases);
  add_surfaces(cases);
  add_matrix(cases);
  return cases.list();
}

std::string_view ended_with(const WrongCall& wrong, Arguments& arguments, std::string& message) {
  try {
    wrong.call(arguments);
    return "nothing";
  } catch (const std::exception& error) {
    message = error.what();
    if (dynamic_cast<const Thrown*>(&error) != nullptr) return ends::with_what_was_thrown;
    if (const auto* point = dynamic_cast<const InvalidPoint*>(&error))
      return point->index() == 1 ? ends::invalid_point : "another point";
    if (dynamic_cast<const InvalidArgument*>(&error) != nullptr) return ends::invalid;
    if (dynamic_cast<const LimitReached*>(&error) != nullptr) return ends::limit;
    if (dynamic_cast<const Cancelled*>(&error) != nullptr) return ends::cancelled;
    return dynamic_cast<const Error*>(&error) != nullptr ? "another Error" : "an exception of nobody's";
  }
}

/// Each call is made with right arguments first, so that a case fails when it is the call that is wrong, and not its argument.
TEST(WrongCalls, RightCallsEndWithNothing) {
  const PackedSample sample;
  for (const Named& named : {points_into, points, tiles, raster, window, surfaces, plan, description, inventory, height_range,
                             cell_contents, geometry, far_view, check, outlines, heights, plan_of_heights}) {
    Arguments arguments(sample.folder());
    EXPECT_NO_THROW(named.call(arguments)) << named.name;
  }
}

TEST(WrongCalls, EndWithAnExceptionThatSaysWhatToDo) {
  const PackedSample sample;
  const std::vector<WrongCall> wrong_calls = all_wrong_calls();
  EXPECT_GE(wrong_calls.size(), 200U);
  for (const WrongCall& wrong : wrong_calls) {
    Arguments arguments(sample.folder());
    wrong.change(arguments);
    std::string message;
    EXPECT_EQ(ended_with(wrong, arguments, message), wrong.ends) << wrong.name << ": " << message;
    const bool is_of_the_caller = wrong.ends == ends::cancelled || wrong.ends == ends::with_what_was_thrown;
    EXPECT_TRUE(is_of_the_caller || message.find(": ") != std::string::npos)
        << wrong.name << " says what is wrong, but not what to do: " << message;
  }
}

/// After a call that ended badly, the same package answers as before.
TEST(WrongCalls, LeaveThePackageAsItWas) {
  const PackedSample sample;
  Arguments arguments(sample.folder());
  const PointAnswers before = evaluate_points(arguments.package, {arguments.x, arguments.y});
  for (const WrongCall& wrong : all_wrong_calls()) {
    Arguments changed(sample.folder());
    wrong.change(changed);
    if (!changed.package.is_open()) continue;
    changed.package = Package(sample.folder());
    std::swap(changed.package, arguments.package);
    std::string message;
    (void)ended_with(wrong, changed, message);
    std::swap(changed.package, arguments.package);
  }
  EXPECT_EQ(evaluate_points(arguments.package, {arguments.x, arguments.y}).svf[0], before.svf[0]);
}

TEST(WrongCalls, BoxMapsKnowNoBounds) {
  const PackedSample sample(FarMapKind::box);
  Arguments arguments(sample.folder());
  arguments.settings.bounds = true;
  EXPECT_THROW(raster.call(arguments), PackageUnusable);
  arguments.settings.engine = Engine::exact;
  EXPECT_NO_THROW(raster.call(arguments));
}

}  // namespace
}  // namespace farlod::library
