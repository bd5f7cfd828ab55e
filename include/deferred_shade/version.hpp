// SPDX-License-Identifier: Apache-2.0
#pragma once

// The build reads the version of the package from these three lines.
#define DEFERRED_SHADE_VERSION_MAJOR 0
#define DEFERRED_SHADE_VERSION_MINOR 1
#define DEFERRED_SHADE_VERSION_PATCH 0

/// The version as one number, for comparisons: 1.2.3 is 10203.
#define DEFERRED_SHADE_VERSION                                                 \
  (DEFERRED_SHADE_VERSION_MAJOR * 10000 + DEFERRED_SHADE_VERSION_MINOR * 100 + \
   DEFERRED_SHADE_VERSION_PATCH)
