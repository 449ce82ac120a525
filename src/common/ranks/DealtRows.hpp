// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Independent rows of a table, distributed to the ranks one by one.
#pragma once

#include <functional>
#include <vector>

#include "common/Message.hpp"
#include "common/Parallel.hpp"
#include "common/ranks/RankGroups.hpp"

namespace tooljoint::parallel {

/// rows[i] = compute(i) for every i of `jobs`, which are the same on all ranks. Each rank takes the
/// next job when it is free; during it Parallel.hpp uses only this rank. At the end all ranks have
/// all rows. Collective; an Error on one rank is thrown on all.
template <class Row>
void dealRows(const std::vector<std::size_t>& jobs, std::vector<Row>& rows,
              const std::function<Row(std::size_t)>& compute) {
  std::vector<char> mine(rows.size(), 0);
  {
    RankGroups groups(1);
    groups.apart([&] {
      for (int n = groups.next(); n >= 0 && n < static_cast<int>(jobs.size()); n = groups.next()) {
        const auto i = jobs[static_cast<std::size_t>(n)];
        rows[i] = compute(i);
        mine[i] = 1;
      }
    });
  }
  for (const auto i : jobs)
    broadcast(rows[i], static_cast<int>(maximum(mine[i] != 0 ? rank() : -1)));
}

}  // namespace tooljoint::parallel
