// SPDX-License-Identifier: GPL-2.0-or-later
/// Loops that YADE's threads share. What they compute does not depend on how many there are.
#pragma once

namespace yade {

/// Loops over no more bodies, pairs or joints than this run on one thread: waking another one would cost more. Islands of
/// contacts, of which each is a lot of work, are shared from two on. [-]
constexpr int smallLoop = 100;

} // namespace yade
