# SPDX-License-Identifier: GPL-2.0-or-later
"""Coefficients of the diagnosis of a wooden house, each with its source.

Order: Enforcement Order of the Building Standard Law; its rules of wall quantity: wall_quantity.py. JBDPA: seismic
diagnosis of wooden houses, general diagnosis (Japan Building Disaster Prevention Association, 2012). None of them was
at hand: 'compared' names the published text that repeats the numbers, 'not verified' is from memory of the source."""
DIRECTION_NAMES = {"ew": "E-W", "ns": "N-S"}
ALLOWABLE_KN_M = 1.96
"""Allowable shear of a wall of multiplier 1. [kN/m] (Order, Article 46; compared: stmaki.com, N-value method)"""
BRACES = ((0.090, 3.0), (0.045, 2.0), (0.030, 1.5), (0.015, 1.0))
"""(least thickness [m], multiplier [-]) of a brace 90 mm wide or more. (Order, Article 46, Table 1; compared: 15 mm
kenchikuyogo.com, 30 and 45 mm what-myhome.net; 90 mm not verified)"""
BRACE_WIDTH = 0.090  # least width of a brace; 90 mm thick ones are square. [m] (Order, Article 46, Table 1)
ROOF_CLASSES = ((1.01, "very_heavy"), (0.69, "heavy"), (0.0, "light"))
"""(least weight of the roof with its ceiling [kN/m2 of its surface], class). Limits (assumed) lie halfway between the
roofs of the Order, Article 84: slates 0.34, tiles 0.64, tiles on mud 0.98, each with purlins 0.05 and ceiling 0.15."""
WALL_QUANTITY = {"light": {1: (11,), 2: (29, 15), 3: (46, 34, 18)}, "heavy": {1: (15,), 2: (33, 21), 3: (50, 39, 24)}}
"""Required wall quantity of storeys 1, 2, 3 of a house of so many storeys. [cm/m2 of floor] (Order, Article 46, Table
2, until March 2025; heavy: tiles.
compared: one and two storeys mnjk.blog, page on wall quantities; two storeys of the light row not on that excerpt: 29
and 15 in a published calculation; three storeys not verified). The Order has no addition for snow."""
REQUIRED_STRENGTH = {"light": {1: (0.28,), 2: (0.83, 0.37), 3: (1.34, 0.98, 0.43)},
                     "heavy": {1: (0.40,), 2: (1.06, 0.53), 3: (1.66, 1.25, 0.62)},
                     "very_heavy": {1: (0.64,), 2: (1.41, 0.78), 3: (2.07, 1.59, 0.91)}}
"""Required strength Qr of storeys 1, 2, 3. [kN/m2 of floor] (JBDPA, general diagnosis, zone factor Z = 1, firm soil;
not verified.
One storey: 0.2 times the roof and half of the walls that JBDPA assumes, 0.95, 1.3, 2.4 and 0.95, 1.4, 1.65 kN/m2, gives
0.285, 0.40, 0.645;
these weights: www4.kcn.ne.jp/~taharakn. A public program, kouzou, has other values: 0.40 to 0.53)"""
SNOW_STRENGTH, SNOW_DEPTHS = 0.26, (1.0, 2.0)
"""Addition to Qr for each metre of snow [kN/m2], from 1 m to 2 m of snow; beyond: that of 2 m. (JBDPA; not verified)"""
OTHER_ELEMENTS = 0.25
"""Share of Qr that walls with openings and other elements bear. [-] (JBDPA, method 1; not verified)"""
DETERIORATION, FITTINGS = 1.0, 1.0
"""dK of a sound house; factor on walls with fittings on a reinforced foundation. [-] (assumed for every house)"""
BANDS = ((1.5, "will not collapse"), (1.0, "unlikely to collapse"), (0.7, "may collapse"), (0.0, "likely to collapse"))
"""(least Iw, judgement) under a very rare earthquake. (JBDPA; compared: mokutaikyo.com)"""
VERY_RARE_PEAK = 4.0
"""Peak acceleration of a very rare earthquake: its response is 1 g (Order, Article 88), 2.5 times. [m/s2] (assumed)"""
ECCENTRICITY_LIMIT = 0.30  # [-] (Notification 1352 of 2000; compared: what-myhome.net)
ECCENTRICITY_START, ECCENTRICITY_END = 0.15, 0.45
"""Between them eKfl = 1 / (3.33 Re + 0.5), for rigid floors, as those of the model; 0.5 beyond. [-] (JBDPA; the ends
compared with the program kouzou, which is linear between them; the formula not verified)"""
QUARTER_RATIO = 0.5
"""Least ratio of opposite quarters, one of them below 1. [-] (Notification 1352 of 2000; compared: what-myhome.net)"""
UPLIFT_KN = 5.3
"""Tension of N = 1: 1.96 kN/m over 2.7 m. [kN] (Notification 1460 of 2000, N-value method; compared: stmaki.com)"""
ALLOWABLE_YIELD = 0.75
"""Allowable tension of a fitting over its mean yield force, the strength with law `slip`. [-] (docs/theory.md, 4)"""
RESTRAINT = {True: 0.8, False: 0.5}
"""B of a corner column (True) or another one. [-] (N-value method; compared: mokuzou.com)"""
VERTICAL = {"top": {True: 0.4, False: 0.6}, "lower": {True: 1.0, False: 1.6}}
"""L of corner columns (True) and others, of the top storey and below. [-] (N-value method; compared: mokuzou.com)"""
