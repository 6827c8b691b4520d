# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The wheel of farlod-preprocess: `pip wheel . --no-build-isolation --no-deps` in this folder."""

import sys
from pathlib import Path

from setuptools import Extension, setup

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from build_with_cmake import BuildWithCMake, options_of_setup, version  # noqa: E402

setup(
    version=version(),
    install_requires=[f"farlod=={version()}"],
    ext_modules=[Extension("farlod_preprocess._preprocess", [])],
    cmdclass={"build_ext": BuildWithCMake},
    options=options_of_setup("preprocess"),
)
