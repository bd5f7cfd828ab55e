// SPDX-License-Identifier: Apache-2.0
// A variant of a larger table.
// error: a variant must list ids of the table
#include "program.hpp"

#include <deferred_shade/specialized.hpp>

#ifdef RIGHT
using some = ds::variants<ds::ids<0, 1>>;
#else
using some = ds::variants<ds::ids<0, 2>>;
#endif
auto f() { return some::covering(std::bitset<2>(1)); }
