# SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
# SPDX-License-Identifier: Zlib

"""python3 -m bullet_elastic_plastic SCENE.json ... is ep-run, which comes with the package."""

import os
import sys

from .sweeps import RUNNER

os.execv(RUNNER, ["ep-run", *sys.argv[1:]])
