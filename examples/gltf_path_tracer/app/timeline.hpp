// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace path_tracer {

/// A piece of work, on the clock of the host or that of the device. Those of one clock nest.
struct span {
  std::string name;
  std::optional<std::uint32_t> shader;    ///< by its id, where the name is "shader"
  std::optional<std::uint64_t> requests;  ///< that it ran on, or paths, where the host knows
  bool on_device = false;
  std::int64_t begin = 0, end = 0;  ///< nanoseconds since the rendering began
};

/// What a rendering did and when: the outer piece before those in it. A batch is in it whole or not
/// at all; those that are not are the last ones.
struct timeline {
  std::vector<span> spans;
  std::uint64_t batches = 0, batches_in_it = 0;
};

}  // namespace path_tracer
