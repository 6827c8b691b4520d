// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/pack_target.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <string_view>
#include <system_error>
#include <utility>

#include "farlod/error.hpp"
#include "farlod/version.hpp"
#include "ingest/files/file_format.hpp"
#include "package/file_stamp.hpp"

namespace farlod::pipeline {
namespace {

namespace fs = std::filesystem;

/// Files that formats keep beside the one that is named.
constexpr std::array<std::string_view, 16> side_endings{".prj", ".shx", ".dbf", ".cpg", ".qpj",     ".dat", ".map", ".id",
                                                        ".mid", ".tfw", ".wld", ".hdr", ".aux.xml", ".ovr", ".msk", ".gfs"};

/// Files that are read together with one.
std::vector<fs::path> files_beside(const fs::path& path) {
  std::vector<fs::path> beside;
  std::error_code unread;
  for (const std::string_view ending : side_endings) {
    fs::path replaced = path, added = path;
    replaced.replace_extension(ending);
    added += ending;
    for (const fs::path& candidate : {replaced, added})
      if (candidate != path && fs::is_regular_file(candidate, unread)) beside.push_back(candidate);
  }
  return beside;
}

/// The files of a folder that is one data set, by name.
std::vector<fs::path> files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

/// Gathers inputs with their stamps.
class Inputs {
 public:
  explicit Inputs(const std::optional<PackageOrigin>& earlier) : earlier_(earlier) {}

  /// A folder that is one data set has a name, but no bytes of its own.
  void add(const fs::path& path, bool is_beside = false) {
    std::error_code unread;
    const bool is_folder = fs::is_directory(path, unread);
    if (is_folder) {
      inputs_.push_back({path.filename().string(), {}, true, is_beside, path.string(), 0});
    } else {
      add_file(path, is_beside);
    }
    for (const fs::path& file : is_folder ? files_in(path) : files_beside(path)) add_file(file, true);
  }
  [[nodiscard]] std::vector<PackageOrigin::Input> take() { return std::move(inputs_); }

 private:
  void add_file(const fs::path& path, bool is_beside) {
    PackageOrigin::Input input{path.filename().string(), {}, true, is_beside, path.string(), 0};
    std::error_code unread;
    if (!fs::is_regular_file(path, unread)) {
      input.is_known = false;
    } else if (const FileIdentity state = identity_of(path); state != FileIdentity{}) {
      input.written_ns = state.changed_ns;
      const PackageOrigin::Input* same = unwritten(input.path, state);
      input.stamp = same != nullptr ? same->stamp : stamp_of(path);
    }
    inputs_.push_back(std::move(input));
  }

  [[nodiscard]] const PackageOrigin::Input* unwritten(const std::string& path, const FileIdentity& state) const {
    if (!earlier_) return nullptr;
    for (const PackageOrigin::Input& input : earlier_->inputs)
      if (input.path == path && input.stamp.bytes == state.bytes && input.written_ns == state.changed_ns && input.is_known)
        return &input;
    return nullptr;
  }

  const std::optional<PackageOrigin>& earlier_;
  std::vector<PackageOrigin::Input> inputs_;
};

using Values = std::vector<std::pair<std::string, std::string>>;

std::string box_text(const Box2d& box) { return fmt::format("{},{},{},{}", box.low.x, box.low.y, box.high.x, box.high.y); }

void add_input_settings(const StageSettings& s, Values& values) {
  const auto add_if = [&](const char* name, const std::optional<std::string>& value) {
    if (value && !value->empty()) values.emplace_back(name, *value);
  };
  add_if("crs", s.georeference.crs);
  add_if("out-crs", s.georeference.out_crs);
  const FootprintSettings& f = s.ingest.footprints;
  add_if("height-field", f.height_field);
  add_if("base-field", f.base_field);
  add_if("roof-field", f.roof_field);
  add_if("storeys-field", f.storeys_field);
  add_if("layer", f.layer);
  add_if("encoding", f.encoding);
  values.emplace_back("floor-height", fmt::format("{}", f.floor_height_m));
  if (f.default_height_m) values.emplace_back("default-height", fmt::format("{}", *f.default_height_m));
  if (!f.unknown_heights.empty()) values.emplace_back("unknown-height", fmt::format("{}", fmt::join(f.unknown_heights, ",")));
  if (const auto& o = s.ingest.obj_origin) values.emplace_back("origin", fmt::format("{},{},{}", o->x, o->y, o->z));
  if (s.ingest.up) values.emplace_back("up", *s.ingest.up == UpAxis::y ? "y" : "z");
  if (!s.ingest.ground_names.empty())
    values.emplace_back("ground-names", fmt::format("{}", fmt::join(s.ingest.ground_names, ",")));
  values.emplace_back("lod", s.ingest.lod.exactly ? std::to_string(*s.ingest.lod.exactly) : "best");
  for (const fs::path& tile : s.terrain) values.emplace_back("terrain", tile.filename().string());
  for (const fs::path& file : s.far_terrains) values.emplace_back("far-terrain", file.filename().string());
  if (s.surface == SurfaceReading::tin) values.emplace_back("surface", "tin");
  if (s.terrain_offset_m != 0.0) values.emplace_back("terrain-offset", fmt::format("{}", s.terrain_offset_m));
}

void add_tree_settings(const TreeSettings& trees, Values& values) {
  if (!trees.any()) return;
  const auto add_if = [&](const char* name, const std::optional<std::string>& value) {
    if (value) values.emplace_back(name, *value);
  };
  for (const fs::path& file : trees.files) values.emplace_back("trees", file.filename().string());
  add_if("tree-height-field", trees.height_field);
  add_if("crown-field", trees.crown_field);
  add_if("trunk-field", trees.trunk_field);
  add_if("trees-layer", trees.layer);
  if (trees.canopy) values.emplace_back("canopy", trees.canopy->filename().string());
  if (trees.trunks) values.emplace_back("trunk", trees.trunks->filename().string());
  if (trees.canopy) values.emplace_back("canopy-absolute", trees.heights == CanopyHeights::elevations ? "yes" : "no");
  values.emplace_back("trunk-ratio", fmt::format("{}", trees.trunk_ratio));
}

std::string align_text(const align::GridSettings& grid) {
  if (grid.align == AlignMode::fixed) return fmt::format("{}", grid.fixed_bearing.degrees());
  return grid.align == AlignMode::none ? "none" : "auto";
}

void add_grid_settings(const StageSettings& s, Values& values) {
  const auto numbers = [](const auto& list) {
    std::string text;
    for (const auto& number : list) text += (text.empty() ? "" : " ") + fmt::format("{}", number);
    return text;
  };
  if (s.choice) {
    values.emplace_back("max-error", fmt::format("{}", 2.0 * s.choice->max_far_error));
    values.emplace_back("cell", numbers(s.choice->cell_edges_m));
    values.emplace_back("neighborhood", numbers(s.choice->neighborhoods));
  } else {
    values.emplace_back("cell", fmt::format("{}", s.grid.cell_edge_m));
    values.emplace_back("neighborhood", std::to_string(s.grid.neighborhood));
  }
  values.emplace_back("align", align_text(s.grid));
  values.emplace_back("assign", s.assign == Assign::clip ? "clip" : "whole");
  const HorizonMapSettings& h = s.far_map.horizon;
  values.emplace_back("far-map", s.far_map.kind == FarMapKind::box
                                     ? fmt::format("box {} {}", s.far_map.box.side_columns, s.far_map.box.rows)
                                     : fmt::format("horizon {} {} {} {} {}", h.azimuth_bins, h.squares_per_edge, h.layers,
                                                   h.tolerance, h.weak_share));
  values.emplace_back("blocks", std::to_string(s.grid.block_edge));
  if (!s.area) return;
  const auto* file = std::get_if<std::filesystem::path>(&*s.area);
  values.emplace_back("area", file != nullptr ? file->filename().string() : box_text(std::get<Box2d>(*s.area)));
}

}  // namespace

PackageOrigin origin_of(const StageSettings& settings, const CityFiles& files, const std::optional<PackageOrigin>& earlier) {
  Inputs inputs(earlier);
  for (const fs::path& file : files.on_disk) inputs.add(file);
  for (const fs::path& file : files.terrain.on_disk) inputs.add(file);
  for (const fs::path& file : files.far_terrain.on_disk) inputs.add(file);
  for (const fs::path& file : settings.trees.files) inputs.add(file);
  if (settings.trees.canopy) inputs.add(*settings.trees.canopy);
  if (settings.trees.trunks) inputs.add(*settings.trees.trunks);
  if (settings.area && std::holds_alternative<fs::path>(*settings.area)) inputs.add(std::get<fs::path>(*settings.area), true);
  PackageOrigin origin{std::string("farlod-pack ") + software_version, inputs.take(), {}};
  add_input_settings(settings, origin.settings);
  add_tree_settings(settings.trees, origin.settings);
  add_grid_settings(settings, origin.settings);
  return origin;
}

std::vector<package::InputFile> inputs_of(const PackageOrigin& origin) {
  std::vector<package::InputFile> inputs;
  for (const PackageOrigin::Input& input : origin.inputs)
    if (!input.is_beside) inputs.push_back({input.name, input.stamp});
  return inputs;
}

std::vector<std::optional<SourceOfPackage>> sources_of(const PackageOrigin& origin,
                                                       std::vector<std::optional<PlacedFile>> placed) {
  std::map<std::string, std::uint32_t> inputs;  // by path: the first that has it
  std::uint32_t number = 0;
  for (const PackageOrigin::Input& input : origin.inputs) {
    if (input.is_beside) continue;
    if (input.is_known) inputs.try_emplace(input.path, number);
    ++number;
  }
  std::vector<std::optional<SourceOfPackage>> sources(placed.size());
  for (std::size_t n = 0; n < placed.size(); ++n) {
    if (!placed[n]) continue;
    const auto input = inputs.find(placed[n]->path.string());
    if (input != inputs.end()) sources[n] = SourceOfPackage{input->second, placed[n]->format, std::move(placed[n]->forms)};
  }
  return sources;
}

void require_unchanged(const PackageOrigin& origin) {
  for (const PackageOrigin::Input& input : origin.inputs) {
    if (!input.is_known || input.written_ns == 0) continue;
    const FileIdentity state = identity_of(input.path);
    if (state == FileIdentity{}) throw InputError(input.path + " has vanished while it was read: nothing was packed.");
    if (state.bytes != input.stamp.bytes || state.changed_ns != input.written_ns)
      throw InputError(input.path + " was written while it was read: pack it again when it is whole.");
  }
}

}  // namespace farlod::pipeline

namespace farlod {

InputFormatNames input_format_names() {
  using ingest::InputFormat, ingest::names_where;
  return {names_where([](const InputFormat&) { return true; }, " and ", true),
          names_where([](const InputFormat& format) { return format.is_mesh; }),
          names_where([](const InputFormat& format) { return format.is_piped; })};
}

}  // namespace farlod
