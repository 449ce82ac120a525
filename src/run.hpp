// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A deck run in this process: `tooljoint::runDeck("deck.xml")`. Installed as tooljoint/run.hpp.
#pragma once

#include "cases/run/RunDeck.hpp"
