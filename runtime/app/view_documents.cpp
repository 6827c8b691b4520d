// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "app/view_options.hpp"
#include "console/program_documents.hpp"

int main(int argc, char** argv) { return farlod::write_program_documents(argc, argv, farlod::describe_view_options); }
