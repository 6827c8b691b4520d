// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
// Has no content: it is what the headers of all test programs are precompiled for (tests/CMakeLists.txt).
