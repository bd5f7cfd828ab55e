// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "batch.hpp"

namespace bench {

/// One way to run the requests of a batch through their shaders.
struct row {
  std::string shaders;   ///< "index" or "record"
  std::string schedule;  ///< as the report calls it
  bool sorted;           ///< of requests that already lie sorted
  void (*shade)(view const&);
};

/// All rows of a set of shaders, and the loop that says what the answer is: on one thread of the
/// host, over memory of the host.
struct row_list {
  ds::shader_id shaders;
  std::vector<row> rows;
  void (*plain_loop)(view const&);
};

/// The rows of a shader_set. Each set has a translation unit of its own, in schedules/, since their
/// kernels take a while to compile.
template <class Set>
row_list rows_of();

}  // namespace bench
