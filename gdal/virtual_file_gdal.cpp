// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "gdal/virtual_file_gdal.hpp"

#include <cpl_minixml.h>
#include <cpl_string.h>
#include <cpl_vsi.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string_view>
#include <unordered_set>
#include <utility>
#include <vector>

#include "base/lower_case.hpp"
#include "farlod/error.hpp"

namespace farlod {
namespace {

using namespace std::string_view_literals;

using Xml = std::unique_ptr<CPLXMLNode, decltype(&CPLDestroyXMLNode)>;

/// Elements and entries of metadata that name files.
constexpr std::array file_names{"SourceFilename"sv, "SourceDataset"sv, "SrcDataSource"sv, "DEMPath"sv,
                                "RPC_DEM"sv,        "X_DATASET"sv,     "Y_DATASET"sv,     "OVERVIEW_FILE"sv};
/// Elements that hold code or queries, which may name anything, or bytes that no format describes.
constexpr std::array refused_elements{"PixelFunctionCode"sv, "PixelFunctionLanguage"sv, "SrcSQL"sv, "OpenOptions"sv};

template <std::size_t n>
bool names_entry(const std::array<std::string_view, n>& names, const char* name) {
  return std::any_of(names.begin(), names.end(), [&](std::string_view one) { return EQUAL(one.data(), name); });
}

/// The path below virtual file systems that unpack files of this computer.
std::string_view without_archives(std::string_view name) {
  for (bool is_stripped = true; is_stripped;) {
    is_stripped = false;
    for (const std::string_view system : {"/vsizip/"sv, "/vsigzip/"sv, "/vsitar/"sv})
      if (name.starts_with(system)) {
        name.remove_prefix(system.size() - 1);
        is_stripped = true;
      }
  }
  return name;
}

bool exists(const std::string& name) {
  VSIStatBufL status;
  return VSIStatExL(name.c_str(), &status, VSI_STAT_EXISTS_FLAG) == 0;
}

class VirtualFiles {
 public:
  explicit VirtualFiles(const std::function<SourceKind(const std::string&)>& kind_of) : kind_of_(kind_of) {}

  void check(const std::string& first) {
    open_.push_back(first);
    while (!open_.empty()) {
      file_ = std::move(open_.back());
      open_.pop_back();
      const Xml root(CPLParseXMLFile(file_.c_str()), &CPLDestroyXMLNode);
      if (!root) throw InputError(file_ + " cannot be read: it is no XML.");
      walk(*root);
    }
  }

 private:
  /// All nodes below a node and beside it. GDAL refuses XML that is nested more than 1,024 deep.
  void walk(const CPLXMLNode& first) {
    std::vector<const CPLXMLNode*> nodes{&first};
    while (!nodes.empty()) {
      const CPLXMLNode& node = *nodes.back();
      nodes.pop_back();
      visit(node);
      if (node.psNext != nullptr) nodes.push_back(node.psNext);
      if (node.psChild != nullptr) nodes.push_back(node.psChild);
    }
  }

  void visit(const CPLXMLNode& node) {
    if (node.eType == CXT_Text) return require_no_system(node.pszValue);
    // GDAL takes an attribute for an element of the same name
    if (node.eType != CXT_Element && node.eType != CXT_Attribute) return;
    if (names_entry(refused_elements, node.pszValue))
      throw InputError(file_ + " has an element " + node.pszValue +
                       ", which may run code or open anything: have gdal_translate or ogr2ogr write it to a file of its own.");
    const bool is_entry = EQUAL(node.pszValue, "MDI");
    if (names_entry(file_names, is_entry ? CPLGetXMLValue(&node, "key", "") : node.pszValue)) {
      const std::string name = CPLGetXMLValue(&node, nullptr, "");
      if (!name.empty()) take_source(name);
    }
  }

  /// Other texts name no file; if one did all the same, it must not be one on the network.
  void require_no_system(const std::string& text) const {
    if (lower_case(std::string(without_archives(text))).find("/vsi") != std::string::npos) require_local_name(text, file_);
  }

  /// GDAL takes the name as it is or relative to the VRT, as an attribute says. Whatever is there of the two must be data.
  void take_source(const std::string& name) {
    require_local_name(name, file_);
    bool is_any = false;
    for (const std::string& path : {name, (std::filesystem::path(file_).parent_path() / name).string()}) {
      if (!exists(path)) continue;
      is_any = true;
      if (!known_.insert(path).second) continue;
      const SourceKind kind = kind_of_(path);
      if (kind == SourceKind::unknown)
        throw InputError(file_ + " names " + path + ", which holds no data that can be read from this computer alone.");
      if (kind == SourceKind::names_others) open_.push_back(path);
    }
    if (!is_any) throw InputError(file_ + " names \"" + name + "\", which is no file on this computer: check the paths in it.");
  }

  const std::function<SourceKind(const std::string&)>& kind_of_;
  std::string file_;
  std::vector<std::string> open_;
  std::unordered_set<std::string> known_;
};

}  // namespace

void require_local_name(const std::string& name, const std::string& shown) {
  const std::string text = lower_case(std::string(without_archives(name)));
  if (text.find("/vsi") == text.npos && text.find("://") == text.npos) return;
  const std::string what = name == shown ? " leads" : " names " + name + ", which leads";
  throw InputError(shown + what + " beyond this computer: download it first, and give the file.");
}

void require_local_sources(const std::filesystem::path& file, const std::function<SourceKind(const std::string&)>& kind_of) {
  VirtualFiles(kind_of).check(file.string());
}

}  // namespace farlod
