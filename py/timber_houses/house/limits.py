# SPDX-License-Identifier: GPL-2.0-or-later
"""Limits of a house description, far above any real house: they bound the time (seconds) and memory (100 MB)."""
MAX_FILE_SIZE = 500_000  # of one YAML file. [bytes] The largest shipped house has 5 kB.
MAX_FILES = 10  # a house file and the chain of files that it extends
MAX_NODES = 20_000
"""YAML values of a house file and the files that it extends; aliases count as often as they are used."""
MAX_DEPTH = 20  # levels of nested lists and tables
MAX_NUMBER_LENGTH = 40  # characters of one number
MAX_TEXT = 1000  # characters of one text
MAX_NAME = 60  # characters of a name that the user chooses
MAX_ITEMS = 1000  # items of a list, where the schema states no smaller limit
MAX_NAMES = 200  # entries of a table whose keys the user chooses (materials, structures, joint types)
MAX_LOTS = 1000  # lots of a town
MAX_LINES = 400  # lines of one list of lines, each position of `at` counted
MAX_ELEMENTS = 1000  # elements of a house. The paper's houses have up to 187.
MAX_PAIRS = 10_000
"""Pairs of elements whose bounding boxes touch. House C has 541; more than 10 per element point to overlaps."""
