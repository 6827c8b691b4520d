// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "package/sources_file.hpp"

#include <utility>

#include "farlod/error.hpp"
#include "package/file_stamp.hpp"

namespace farlod {

using package::SourcesCursor;
using package::SourcesHeader;

SourcesFile::SourcesFile(const PackageFolder& folder, const package::Manifest& manifest)
    : name_(folder.file(package::sources_file).name), mapped_(folder.plain_file(package::sources_file)) {
  check_stamp(folder.file(package::sources_file), mapped_, *manifest.sources);
  check_header(manifest);
  const std::span<const std::byte> contents = mapped_.bytes().subspan(sizeof(SourcesHeader));
  SourcesCursor cursor({reinterpret_cast<const std::uint8_t*>(contents.data()), contents.size()});
  for (std::uint32_t n = 0; n < header().file_count; ++n) read_file(cursor, manifest);
  for (std::uint64_t n = 0; n < header().building_count; ++n) read_building(cursor);
  require(cursor.at_end() && !cursor.failed(), "its length is not that of its contents");
}

const SourcesHeader& SourcesFile::header() const { return *reinterpret_cast<const SourcesHeader*>(mapped_.bytes().data()); }

void SourcesFile::check_header(const package::Manifest& manifest) const {
  const std::span<const std::byte> bytes = mapped_.bytes();
  require(bytes.size() >= sizeof(SourcesHeader), "it has no header");
  require(header().magic == package::sources_magic, "it does not begin as sources.bin does");
  require_readable_version(name_, header().version, package::sources_version, package::sources_version_with_ids);
  require(header().file_bytes == bytes.size(), "its length is another one than it says");
  require(header().building_count == manifest.buildings, "it does not have the buildings that the manifest counts");
}

void SourcesFile::read_file(SourcesCursor& cursor, const package::Manifest& manifest) {
  const std::uint64_t input = cursor.number(), format = cursor.number();
  require(!cursor.failed() && input < manifest.inputs.size(), "a file is no input of the manifest");
  require(format >= 1 && format <= static_cast<std::uint64_t>(CityFileFormat::cityjsonseq),
          "a file is of a format that does not exist");
  const package::InputFile& packed = manifest.inputs[input];
  PackedCityFile file{{packed.name, packed.stamp.bytes, packed.stamp.xxh3}, static_cast<CityFileFormat>(format), {}};
  const std::size_t forms = cursor.count();
  for (std::size_t n = 0; n < forms && !cursor.failed(); ++n) {
    AttributeForm& form = file.forms.emplace_back();
    for (std::string* text :
         {&form.before_all, &form.before_name, &form.before_value, &form.behind_value, &form.between, &form.behind_all})
      *text = cursor.text();
  }
  require(!cursor.failed(), "it ends within its files");
  files_.push_back(std::move(file));
}

void SourcesFile::read_building(SourcesCursor& cursor) {
  Row row{cursor.number32(), {}};
  require(!cursor.failed() && row.file <= files_.size(), "a building is of a file that does not exist");
  const bool has_ids = header().version >= package::sources_version_with_ids;
  if (row.file > 0 || has_ids) {
    row.bytes = cursor.take(cursor.count());
    require(!cursor.failed(), "it ends within its buildings");
  }
  if (row.file > 0 || !row.bytes.empty()) {
    const std::optional<BuildingOrigin> origin = package::origin_from(row.bytes);
    require(origin.has_value(), "a building has surfaces of what does not exist");
    require(has_ids || origin->ids.empty(), "its version has no ids");
    if (row.file > 0) check(*origin, files_[row.file - 1]);
  }
  buildings_.push_back(row);
}

void SourcesFile::check(const BuildingOrigin& origin, const PackedCityFile& file) const {
  for (const auto* places : {&origin.objects, &origin.semantics})
    for (const AttributePlace& place : *places)
      require(place.form <= file.forms.size() && place.at <= file.input.bytes, "a place is not in its file");
}

BuildingOrigin SourcesFile::origin_of(std::size_t building) const {
  std::optional<BuildingOrigin> origin = package::origin_from(buildings_[building].bytes);
  require(origin.has_value(), "it has changed since it was opened");
  return std::move(*origin);
}

}  // namespace farlod
