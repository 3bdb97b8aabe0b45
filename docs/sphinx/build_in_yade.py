# SPDX-License-Identifier: GPL-2.0-or-later
"""Started by scripts/build_docs inside YADE: Sphinx from DOCS_SOURCE to DOCS_OUT; warnings are errors."""
import os
import sys

from sphinx.cmd.build import main

source, out = os.environ["DOCS_SOURCE"], os.environ["DOCS_OUT"]
sys.exit(main(["-W", "--keep-going", "-q", "-b", "html", "-d", f"{out}/../doctrees", source, out]))
