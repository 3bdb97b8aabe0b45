# SPDX-License-Identifier: GPL-2.0-or-later
"""Limits of a house description, far above any real house: they bound the time (seconds) and memory (100 MB)."""
MAX_FILE_SIZE = 500_000
"""Of one YAML file. [bytes] The largest shipped house has 5 kB."""
MAX_FILES = 10
"""A house file and the chain of files that it extends."""
MAX_NODES = 20_000
"""YAML values of a house file and the files that it extends; aliases count as often as they are used."""
MAX_DEPTH = 20
"""Levels of nested lists and tables."""
MAX_NUMBER_LENGTH = 40
"""Characters of one number."""
MAX_TEXT = 1000
"""Characters of one text."""
MAX_NAME = 60
"""Characters of a name that the user chooses."""
MAX_ITEMS = 1000
"""Items of a list, where the schema states no smaller limit."""
MAX_NAMES = 200
"""Entries of a table whose keys the user chooses (materials, structures, joint types)."""
MAX_LOTS = 1000
"""Lots of a town."""
MAX_LINES = 400
"""Lines of one list of lines, each position of `at` counted."""
MAX_ELEMENTS = 1000
"""Elements of a house. The paper's houses have up to 187."""
MAX_PAIRS = 10_000
"""Pairs of elements whose bounding boxes touch. House C has 541; more than 10 per element point to overlaps."""
