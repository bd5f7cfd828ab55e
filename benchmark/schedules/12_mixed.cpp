// SPDX-License-Identifier: Apache-2.0
#include "rows_of.hpp"

template bench::row_list bench::rows_of<bench::shader_set<2, 6, 4>>();
