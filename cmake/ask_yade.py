# SPDX-License-Identifier: GPL-2.0-or-later
"""Run inside `yade -n -x`: print what the installed YADE says of itself, as `key=value` lines (lists joined by ;)."""
import site
import sys
import sysconfig

import yade.config

facts = {
    "VERSION": yade.config.version,
    "FEATURES": ";".join(sorted(set(yade.config.features))),
    "LIB_DIR": yade.config.libDir,
    "REAL_BITS": yade.config.highPrecisionBits,
    "REAL_DIGITS": yade.config.highPrecisionDecimalPlaces,
    "PYTHON": sys.executable,
    "PYTHON_VERSION": "%d.%d" % sys.version_info[:2],
    "PYTHON_INCLUDE": sysconfig.get_path("include"),
    "SITE_DIR": next((p for p in site.getsitepackages() if p.startswith("/usr/local")), site.getsitepackages()[0]),
}
for key, value in facts.items():
    print(f"\n@{key}={value}", end="")
print("\n@END=", flush=True)
