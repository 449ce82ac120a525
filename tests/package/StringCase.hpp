// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A hanging string, from a deck to results, with the installed libraries.
#pragma once

/// Runs the deck of ten pipes that hang in a vertical well into the folder "hanging". Throws
/// std::runtime_error when the pipes stretch by something else than rho g L^2 / 2E.
void runStringCase();
