// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/architecture/rules.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <regex>
#include <set>
#include <string_view>
#include <utility>

namespace farlod {
namespace {

/// What the files of a room must not include. All four are regular expressions or words for people.
struct Wall {
  const char* room;       ///< paths that the row is about
  const char* exempt;     ///< paths among them that it is not about
  const char* forbidden;  ///< what stands between the brackets or quotes
  const char* reason;
};

#define CGAL_HEADERS "CGAL/|gmpxx?\\.h|mpfr\\.h"
#define GDAL_HEADERS "gdal|cpl_|ogr|vrtdataset"
#define PROJ_HEADERS "proj(\\.h|_|/)"
#define EXPAT_HEADERS "expat\\.h"
#define XML_HEADERS EXPAT_HEADERS "|libxml|citygml/"
#define EMBREE_HEADERS "embree|occlusion/[a-z_]+_embree\\.hpp"
#define EXR_HEADERS "OpenEXR/|Imf|Imath|half\\.h"
#define MAPPING_HEADERS "boost/(interprocess|iostreams)|sys/mman"
#define NOWHERE "^$"

constexpr Wall walls[] = {
    {"^include/", NOWHERE, "^(?!farlod/|[a-z_0-9]+$)", "what users include knows the standard library only"},
    {"^base/.*\\.hpp$", NOWHERE, "^(?!farlod/|base/|[a-z_0-9]+$)", "the base knows the standard library only"},
    {"^base/.*\\.cpp$", NOWHERE, "^(?!farlod/|base/|[a-z_0-9]+$|(fcntl|unistd|dlfcn|malloc|sys/[a-z_]+)\\.h$)",
     "the base knows the system, and nothing of packages"},
    {"^package/.*\\.hpp$", NOWHERE, "^(?!farlod/|base/|package/|[a-z_0-9]+$)", "headers name no foreign library"},
    {"^package/", "_openexr\\.cpp$", "^(" EXR_HEADERS ")", "OpenEXR's wrappers are *_openexr.cpp"},
    {"^package/", "_boost\\.cpp$", "^(" MAPPING_HEADERS ")", "files are mapped by one wrapper"},
    {"^runtime/", NOWHERE, "^(" CGAL_HEADERS "|" PROJ_HEADERS "|libxml|citygml/|GeographicLib/)",
     "the runtime ships without the geometry stack"},
    {"^runtime/", NOWHERE, "^" EXPAT_HEADERS, "the runtime never needs Expat"},
    {"^runtime/", "^runtime/(inputs|results)/[a-z_/]+_gdal\\.cpp$", "^(" GDAL_HEADERS ")",
     "the runtime library never needs GDAL; *_gdal.cpp of inputs and results are a library apart"},
    {"^runtime/(app|inputs|results|sun|view|weather)/", NOWHERE,
     "^(package|occlusion|scene|horizon|canopy|rays|receivers|evaluate|run|base/"
     "(?!durable_file|expects|lower_case|nearest_word|point_columns|unread_file))",
     "a program is a user of the library"},
    {"^preprocess/app/", NOWHERE, "^(city|ingest|georeference|align|tiles|farmap|package|trial|pipeline|occlusion|base)/",
     "a program is a user of the library"},
    {"^runtime/canopy/", NOWHERE, "^(?!farlod/|base/|package/|horizon/|canopy/|[a-z_0-9]+$)",
     "crowns are seen above horizons, and know no more"},
    {"^runtime/", "^runtime/occlusion/[a-z_]+_embree\\.[hc]pp$", "^(" EMBREE_HEADERS ")",
     "occlusion is the only wrapper of Embree"},
    {"^(preprocess|runtime)/", NOWHERE, "^(" EXR_HEADERS "|" MAPPING_HEADERS ")",
     "only the package room knows how far maps and tiles lie on disk"},

    {"^python/", NOWHERE, "^(?!farlod/|python/|pybind11/|[a-z_0-9]+$|unistd\\.h$)",
     "a module of Python is a user of the libraries"},
    {"^python/(binding|runtime_module)/", NOWHERE, "^(farlod/(pack|problem)\\.hpp|python/preprocess/)",
     "farlod._runtime is under Apache-2.0, and packs nothing"},
    {"^(?!python/)", NOWHERE, "^(pybind11/|Python\\.h)", "python/ is the only wrapper of Python"},

    {"^console/", NOWHERE,
     "^(" CGAL_HEADERS "|" GDAL_HEADERS "|" PROJ_HEADERS "|" XML_HEADERS "|" EXR_HEADERS "|" EMBREE_HEADERS "|GeographicLib/)",
     "the console knows how to talk, not what about"},

    {"^preprocess/", NOWHERE, "^(" EMBREE_HEADERS ")", "rays are asked through runtime/occlusion"},
    {"^preprocess/", "_cgal\\.[hc]pp$", "^(" CGAL_HEADERS ")", "CGAL's wrapper is *_cgal.*"},
    {"^preprocess/", "_(gdal|ogr)\\.cpp$", "^(" GDAL_HEADERS ")", "GDAL's wrappers are *_gdal.cpp and *_ogr.cpp"},
    {"^preprocess/", "_proj\\.cpp$", "^" PROJ_HEADERS, "PROJ's wrapper is *_proj.cpp"},
    {"^preprocess/", "_geographiclib\\.cpp$", "^GeographicLib/", "GeographicLib's wrapper is *_geographiclib.cpp"},
    {"^preprocess/", "_expat\\.cpp$", "^(" XML_HEADERS ")", "Expat's wrapper is *_expat.cpp"},
    {"^(package|preprocess)/", "_nlohmann\\.cpp$", "^nlohmann/", "nlohmann-json's wrapper is *_nlohmann.cpp"},
    {"^preprocess/(?!farmap/)", NOWHERE, "^occlusion/", "only farmap casts rays"},

    {"^(benchmark|validation)/", NOWHERE, "^tests/(?!scenes/)", "what measures shares the scenes of the tests, and no test"},

    {"^(preprocess|runtime)/", "_netcdf\\.cpp$", "^netcdf", "the wrapper of netCDF is *_netcdf.cpp"},
    {"^(package|preprocess|runtime)/", "_xxhash\\.cpp$|^package/", "^xxhash", "the wrappers of xxHash are *_xxhash.cpp"},
    {"^(preprocess|runtime)/", "_cairo\\.cpp$", "^(cairo|pango/|png\\.h)", "the wrapper of Cairo and Pango is *_cairo.cpp"},
    {"^runtime/", "^runtime/results/module_dlopen\\.cpp$", "^dlfcn", "one file loads modules"},
    {"^(preprocess|runtime)/", "_beast\\.cpp$", "^boost/(asio|beast)", "the wrapper of Boost.Beast is *_beast.cpp"},
    {"^(preprocess|runtime)/", "_zlib\\.cpp$", "^zlib", "the wrapper of zlib is *_zlib.cpp"},
    {"^(preprocess|runtime)/", "_erfa\\.cpp$", "^erfa", "ERFA's wrapper is *_erfa.cpp"},
    {"^(preprocess|runtime)/", "/app/", "^(CLI/|spdlog/|iostream$|print$)", "libraries neither print nor read command lines"},
    {"^(preprocess|runtime)/.*\\.hpp$", "/app/|_(cgal|embree)\\.hpp$", "^(?![a-z_0-9]+$|[a-z_]+/[a-z_0-9/]+\\.hpp$)",
     "headers name no foreign library"},
    {"^(preprocess|runtime)/.*\\.hpp$", NOWHERE, "^(boost|tbb|nlohmann|fmt|oneapi)/", "headers name no foreign library"},
};

/// In the order in which the data goes through them.
constexpr std::array<std::string_view, 9> stages{"city",   "ingest", "georeference", "align", "tiles",
                                                 "farmap", "trial",  "pipeline",     "app"};

/// A header of the runtime that a room of preprocess may include.
struct SharedHeader {
  std::string_view room, header;
  bool operator==(const SharedHeader&) const = default;
};

/// The stage `trial` measures far maps with the evaluator that users will run: it has nothing of its own that could differ from
/// it.
constexpr SharedHeader shared_headers[] = {{"preprocess/trial", "evaluate/sky_evaluator.hpp"},
                                           {"preprocess/trial", "receivers/receiver.hpp"}};

std::size_t stage_of(std::string_view path_in_preprocess) {
  const std::string_view folder = path_in_preprocess.substr(0, path_in_preprocess.find('/'));
  return static_cast<std::size_t>(std::find(stages.begin(), stages.end(), folder) - stages.begin());
}

std::string sentence(const SourceFile& file, const Include& include, std::string_view reason) {
  std::string text = file.path;
  return text.append(":")
      .append(std::to_string(include.line))
      .append(" includes ")
      .append(include.target)
      .append(": ")
      .append(reason);
}

void check_walls(const SourceFile& file, std::vector<std::string>& breaches) {
  for (const Wall& wall : walls) {
    if (!std::regex_search(file.path, std::regex(wall.room)) || std::regex_search(file.path, std::regex(wall.exempt))) continue;
    const std::regex forbidden(wall.forbidden);
    for (const Include& include : includes_of(file))
      if (std::regex_search(include.target, forbidden)) breaches.push_back(sentence(file, include, wall.reason));
  }
}

void check_stage_order(const SourceFile& file, std::vector<std::string>& breaches) {
  constexpr std::string_view side = "preprocess/";
  if (!file.path.starts_with(side)) return;
  const std::size_t own = stage_of(std::string_view(file.path).substr(side.size()));
  for (const Include& include : includes_of(file)) {
    const std::size_t other = stage_of(include.target);
    if (include.quoted && other < stages.size() && other > own)
      breaches.push_back(sentence(file, include, "data goes one way; that stage is later"));
  }
}

std::string_view room_of(const SourceFile& file) { return std::string_view(file.path).substr(0, file.path.rfind('/')); }

/// What a file may name in quotes besides the base: the headers of its own side (both sides have a room `app`, so that the name
/// alone does not say whose header is meant), packages, the console from a program, the errors of GDAL, rays from preprocess, and
/// the evaluator from one of its stages.
bool may_quote(const SourceFile& file, const std::string& target, const std::set<std::string>& paths) {
  const std::string side = file.path.substr(0, file.path.find('/'));
  if (target.starts_with("farlod/") || target.starts_with("base/") || paths.contains(side + "/" + target)) return true;
  if (side == "datasets" && paths.contains("datasets/generator/" + target)) return true;
  if (target.starts_with("console/")) return side == "console" || file.path.find("/app/") != std::string::npos;
  // The walls above let only the wrappers of GDAL through
  if (target.starts_with("gdal/")) return side == "gdal" || side == "preprocess" || side == "runtime";
  if (target.starts_with("package/")) return side == "package" || side == "preprocess" || side == "runtime";
  if (std::ranges::count(shared_headers, SharedHeader{room_of(file), target}) > 0) return true;
  return side == "preprocess" && target.starts_with("occlusion/");
}

void check_side(const SourceFile& file, const std::set<std::string>& paths, std::vector<std::string>& breaches) {
  static const std::regex walled("^(base|console|gdal|package|preprocess|runtime|datasets)/");
  if (!std::regex_search(file.path, walled)) return;
  for (const Include& include : includes_of(file))
    if (include.quoted && !may_quote(file, include.target, paths))
      breaches.push_back(sentence(file, include, "quotes are for the base and the headers of the own side"));
}

bool has_forbidden_include(const SourceFile& file, const Wall& wall) {
  const std::regex forbidden(wall.forbidden);
  return std::ranges::any_of(includes_of(file),
                             [&](const Include& include) { return std::regex_search(include.target, forbidden); });
}

bool is_used(const SharedHeader& shared, const std::vector<SourceFile>& tree) {
  return std::ranges::any_of(tree, [&](const SourceFile& file) {
    return room_of(file) == shared.room && std::ranges::count(includes_of(file), shared.header, &Include::target) > 0;
  });
}

}  // namespace

std::vector<std::string> useless_exemptions(const std::vector<SourceFile>& tree) {
  std::vector<std::string> found;
  for (const Wall& wall : walls) {
    const std::regex room(wall.room), exempt(wall.exempt);
    const auto is_exempt = [&](const SourceFile& file) {
      return is_cpp(file) && std::regex_search(file.path, room) && std::regex_search(file.path, exempt) &&
             has_forbidden_include(file, wall);
    };
    if (std::string_view(wall.exempt) != NOWHERE && std::ranges::none_of(tree, is_exempt))
      found.push_back(std::string(wall.exempt) + ": " + wall.reason);
  }
  for (const SharedHeader& shared : shared_headers)
    if (!is_used(shared, tree)) found.push_back(std::string(shared.room) + ": " + std::string(shared.header));
  return found;
}

std::vector<std::string> breaches_of_include_walls(const std::vector<SourceFile>& tree) {
  std::set<std::string> paths;
  for (const SourceFile& file : tree) paths.insert(file.path);
  std::vector<std::string> breaches;
  for (const SourceFile& file : tree) {
    if (!is_cpp(file)) continue;
    check_walls(file, breaches);
    check_stage_order(file, breaches);
    check_side(file, paths, breaches);
  }
  return breaches;
}

namespace {

/// The folders that a folder points to, and the first include that makes it do so.
using FolderGraph = std::map<std::string, std::map<std::string, std::string>>;

std::string folder_of(std::string_view path) { return std::string(path.substr(0, path.rfind('/'))); }

FolderGraph folder_graph(const std::vector<SourceFile>& tree, std::string_view side) {
  std::set<std::string> paths;
  for (const SourceFile& file : tree) paths.insert(file.path);
  FolderGraph graph;
  for (const SourceFile& file : tree) {
    if (!is_cpp(file) || !file.path.starts_with(side)) continue;
    const std::string from = folder_of(file.path);
    for (const Include& include : includes_of(file)) {
      const std::string target = std::string(side).append(include.target);
      if (!include.quoted || !paths.contains(target) || folder_of(target) == from) continue;
      graph[from].try_emplace(folder_of(target), file.path + " includes " + include.target);
    }
  }
  return graph;
}

/// Depth-first search: a folder that leads back to one on the way closes a circle.
class CircleSearch {
 public:
  explicit CircleSearch(const FolderGraph& graph) : graph_(graph) {
    for (const auto& [folder, targets] : graph_) visit(folder);
  }
  std::vector<std::string> circles;

 private:
  void visit(const std::string& folder) {
    if (done_.contains(folder)) return;
    if (const auto begin = std::find(way_.begin(), way_.end(), folder); begin != way_.end()) {
      circles.push_back(sentence(begin));
      return;
    }
    way_.push_back(folder);
    if (const auto found = graph_.find(folder); found != graph_.end())
      for (const auto& [target, include] : found->second) visit(target);
    way_.pop_back();
    done_.insert(folder);
  }

  [[nodiscard]] std::string sentence(std::vector<std::string>::const_iterator begin) const {
    std::string folders, includes;
    for (auto folder = begin; folder != way_.end(); ++folder) {
      const std::string& next = folder + 1 == way_.end() ? *begin : *(folder + 1);
      folders.append(*folder).append(" -> ");
      includes.append(includes.empty() ? "" : "; ").append(graph_.at(*folder).at(next));
    }
    return folders + *begin + ": " + includes;
  }

  const FolderGraph& graph_;
  std::vector<std::string> way_;
  std::set<std::string> done_;
};

}  // namespace

std::vector<std::string> include_circles(const std::vector<SourceFile>& tree, std::string_view side) {
  const FolderGraph graph = folder_graph(tree, side);
  return CircleSearch(graph).circles;
}

}  // namespace farlod
