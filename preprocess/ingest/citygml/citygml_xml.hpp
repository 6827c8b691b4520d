// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ingest/citygml/xml_element.hpp"
#include "ingest/files/input_file.hpp"

namespace farlod::ingest {

/// Parses a whole XML file in UTF-8, UTF-16 or any encoding of one byte a character, and calls a listener for each element and
/// text. The only wrapper of Expat. Throws InputError, with line and column, for a file that is not well-formed. It also refuses
/// what attacks use and no CityGML file needs: declarations in a DOCTYPE (entities that expand without limit or refer to other
/// files), elements nested deeper than 256, and tags of more than 4 MiB.
void parse_xml(const InputFile& file, XmlListener& listener);

}  // namespace farlod::ingest
