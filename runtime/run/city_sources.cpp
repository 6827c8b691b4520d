// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "farlod/city_sources.hpp"

#include <optional>

#include "package/sources_file.hpp"
#include "run/package_contents.hpp"

namespace farlod {
namespace {

std::optional<SourcesFile> sources_of(const PackageInUse& in_use) {
  std::optional<SourcesFile> sources;
  const package::Manifest& manifest = in_use.reader().manifest();
  if (manifest.sources) sources.emplace(in_use.reader().folder(), manifest);
  return sources;
}

}  // namespace

std::vector<PackedCityFile> city_files_of(const Package& package) {
  const PackageInUse in_use(package);
  const std::optional<SourcesFile> sources = sources_of(in_use);
  return sources ? sources->files() : std::vector<PackedCityFile>();
}

void visit_origins(const Package& package,
                   const std::function<void(std::uint32_t building, std::size_t file, const BuildingOrigin& origin)>& visit) {
  const PackageInUse in_use(package);
  if (const std::optional<SourcesFile> sources = sources_of(in_use)) sources->visit(visit);
}

}  // namespace farlod
