// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pack_options.hpp"
#include "console/program_documents.hpp"

int main(int argc, char** argv) { return farlod::write_program_documents(argc, argv, farlod::describe_pack_options); }
