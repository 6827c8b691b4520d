// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace farlod {

/// From now on, exceptions of the library that leave a function of the module being initialised are raised as the class of the
/// same name in farlod.errors, with the same message.
void translate_exceptions();

}  // namespace farlod
