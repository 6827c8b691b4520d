# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""The wheel of farlod: `pip wheel . --no-build-isolation --no-deps` in this folder."""

import sys
from pathlib import Path

from setuptools import Extension, setup

sys.path.insert(0, str(Path(__file__).resolve().parent))

from build_with_cmake import BuildWithCMake, options_of_setup, version  # noqa: E402

setup(
    version=version(),
    ext_modules=[Extension("farlod._runtime", [])],
    cmdclass={"build_ext": BuildWithCMake},
    options=options_of_setup("runtime"),
)
