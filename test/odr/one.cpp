// SPDX-License-Identifier: Apache-2.0
#include <thrust/execution_policy.h>

#include "shade_sum.hpp"

int first_unit() { return shade_sum(thrust::device, deferred_shade::explicit_serialization{}); }
