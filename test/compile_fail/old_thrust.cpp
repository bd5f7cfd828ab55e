// SPDX-License-Identifier: Apache-2.0
// Thrust of a time before the library's.
// errors: 1
// error: this Thrust is too old; take CCCL 2.8 or newer
#include <thrust/version.h>
#ifndef RIGHT
#undef THRUST_VERSION
#define THRUST_VERSION 101702
#endif
#include <deferred_shade/deferred_shade.hpp>
