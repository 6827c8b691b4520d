// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "farlod/error.hpp"
#include "ingest/cityjson/cityjson_reader.hpp"
#include "ingest/files/file_format.hpp"

namespace farlod::ingest {

InputFile metadata_of_feature(const InputFile& feature) {
  // roofer writes objects/ID/reconstruct/ID.city.jsonl below it
  for (const char* name : {"metadata.json", "../metadata.json", "../../metadata.json", "../../../metadata.json"})
    if (InputFile metadata = feature.beside(name); find_beginning(metadata, 1) && is_cityjson(metadata)) return metadata;
  throw InputError(feature.name +
                   " holds a CityJSONFeature, which has its transform in the first line of the file, of type CityJSON, or in a "
                   "metadata.json beside it or up to three folders above: there is none of them. Put one there.");
}

}  // namespace farlod::ingest
