// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <thrust/execution_policy.h>

#include "program.hpp"

// What the programs for CUDA have in common.

using device_workspace = ds::workspace<ds::cuda_allocator<std::byte>>;
