// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <filesystem>
#include <string_view>

#include "base/expects.hpp"
#include "farlod/error.hpp"
#include "ingest/files/file_format.hpp"
#include "ingest/trees/tree_reader.hpp"
#include "tests/fuzz/fuzz_target.hpp"
#include "tests/fuzz/scratch_folder.hpp"

namespace farlod {
namespace {

void expect_trees(const SourceTrees& source) {
  FARLOD_EXPECTS(!source.trees.empty());
  for (const Tree& tree : source.trees) {
    FARLOD_EXPECTS(std::isfinite(tree.place.x) && std::isfinite(tree.place.y));
    FARLOD_EXPECTS(tree.height_m > 0.0F && tree.height_m <= static_cast<float>(highest_tree_m));
    FARLOD_EXPECTS(tree.crown_diameter_m > 0.0F && std::isfinite(tree.crown_diameter_m));
    FARLOD_EXPECTS(tree.trunk_height_m >= 0.0F && tree.trunk_height_m < tree.height_m);
  }
}

void read(const std::filesystem::path& file, const TreeSettings& settings) {
  Report report;
  try {
    expect_trees(ingest::read_trees(file, settings, report));
  } catch (const InputError& refusal) {
    FARLOD_EXPECTS(!std::string_view(refusal.what()).empty());
  }
}

}  // namespace
}  // namespace farlod

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace farlod;
  if (size == 0) return 0;
  const bool is_json = data[0] == '{', is_xml = data[0] == '<';
  static const ScratchFolder folder;
  const std::filesystem::path file = folder.write({data, size}, is_json ? "trees.json" : is_xml ? "trees.gml" : "trees.csv");
  // What is no city goes to GDAL's reader of GML, which is not ours to fuzz
  if (is_xml && ingest::format_by_content(ingest::InputFile(file)) != ingest::FileFormat::citygml) return 0;
  read(file, {});
  TreeSettings named;
  named.height_field = "a";
  named.crown_field = "crown_area";
  named.trunk_field = "c";
  read(file, named);
  return 0;
}
