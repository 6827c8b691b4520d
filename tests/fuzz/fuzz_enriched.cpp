// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <initializer_list>

#include "contract/expects.hpp"
#include "results/city/city_format.hpp"
#include "tests/fuzz/fuzzed_package.hpp"
#include "tests/fuzz/scratch_folder.hpp"

namespace farlod {
namespace {

void expect_place(const CityFile& file, const std::optional<AttributePlace>& place) {
  if (!place) return;
  FARLOD_EXPECTS(place->at <= file.text().size());
  FARLOD_EXPECTS(!file.text_of({{"svf", "0.5"}}, place->form).empty());
}

void expect_promises_kept(const CityFile& file, const FileBuilding& building) {
  for (const auto& place : building.objects) expect_place(file, place);
  for (const FileSemantics& semantics : building.semantics) expect_place(file, semantics.place);
  for (const NumberedPolygon& polygon : building.polygons) {
    FARLOD_EXPECTS(building.objects.empty() || polygon.object < building.objects.size());
    FARLOD_EXPECTS(!polygon.semantics || *polygon.semantics < building.semantics.size());
  }
}

}  // namespace
}  // namespace farlod

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace farlod;
  static const ScratchFolder folder;
  const std::filesystem::path path = folder.write({data, size}, "city");
  expect_answer_or_refusal([&] {
    const ReadCity city = read_city(path);
    for (const PackedLod lod : {PackedLod{}, PackedLod{1}, PackedLod{2}})
      telling_file(
          path, [&] { city.file->for_each_building(lod, [&](const FileBuilding& b) { expect_promises_kept(*city.file, b); }); });
  });
  return 0;
}
