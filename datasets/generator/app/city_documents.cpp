// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "console/program_documents.hpp"
#include "generator/app/city_options.hpp"

int main(int argc, char** argv) { return farlod::write_program_documents(argc, argv, farlod::describe_city_options); }
