// SPDX-License-Identifier: GPL-2.0-or-later
// Python access to YADE's data members through the layout that this module was compiled with.
//
// The headers may be of another version than the running YADE, so the offset of a member is an assumption. For each
// member in the table host.py stores a value on one side (YADE's own Python attribute or the compiled layout) and
// expects it back on the other.
#pragma once

/// Defines the guard's functions in the module under construction.
void defineLayoutGuard();
