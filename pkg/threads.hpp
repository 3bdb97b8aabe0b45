// SPDX-License-Identifier: GPL-2.0-or-later
/// Loops that YADE's threads share. What they compute does not depend on how many there are.
#pragma once

namespace yade {

/// Loops over no more bodies, pairs or joints than this run on one thread: waking another one would cost more. [-]
constexpr int smallLoop = 150;

} // namespace yade
