# SPDX-License-Identifier: GPL-2.0-or-later
"""Versions of YADE and of the package."""
import json

from .. import host
from ..plugin import compiled


def versions():
    """{'yade': version of the running YADE, 'package': version with which the module was built}."""
    build = json.loads(compiled.build_record()[len(host.RECORD_MARK):])
    return {"yade": host.host_facts()["yade"], "package": build["package"]}
