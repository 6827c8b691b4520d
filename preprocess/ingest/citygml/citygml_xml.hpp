// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ingest/citygml/xml_element.hpp"
#include "ingest/files/input_file.hpp"

namespace farlod::ingest {

/// Parses a whole XML file, and calls a listener for each element and text: UTF-8, UTF-16, and any encoding of one byte a
/// character. The only wrapper of Expat. Throws InputError, with line and column, for what is not well-formed; and for what no
/// CityGML file has, while a hostile one may: declarations in a DOCTYPE (entities that unfold without end or lead to other
/// files), elements nested deeper than 256, a tag of more than 4 MiB.
void parse_xml(const InputFile& file, XmlListener& listener);

}  // namespace farlod::ingest
