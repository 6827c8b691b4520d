// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

namespace farlod {

/// The beginning of an XML element, with the attributes that matter in CityGML. Valid only while it is being handled.
struct XmlElement {
  std::string_view space;  ///< the namespace's URI
  std::string_view name;   ///< without prefix
  std::string_view id;     ///< gml:id
  std::string_view href;   ///< xlink:href
  std::string_view srs_name, srs_dimension, orientation;
};

}  // namespace farlod
