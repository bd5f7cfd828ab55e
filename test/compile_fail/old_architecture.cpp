// SPDX-License-Identifier: Apache-2.0
// A GPU of a time before the library's.
// errors: 1
// error: this GPU architecture is too old
#ifndef RIGHT
#define __CUDA_ARCH__ 700
#endif
#include <deferred_shade/config.hpp>
