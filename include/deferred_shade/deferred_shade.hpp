// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deferred_shade/dispatch/explicit.hpp>
#include <deferred_shade/dispatch/implicit.hpp>
#include <deferred_shade/math.hpp>
#include <deferred_shade/observed.hpp>
#include <deferred_shade/records.hpp>
#include <deferred_shade/schedule/bucket_then_dispatch.hpp>
#include <deferred_shade/schedule/compact_then_dispatch.hpp>
#include <deferred_shade/schedule/local_sort_then_dispatch.hpp>
#include <deferred_shade/schedule/sort_then_dispatch.hpp>
#include <deferred_shade/schedule/specialized.hpp>
#include <deferred_shade/schedule/window_sort_then_dispatch.hpp>
#include <deferred_shade/shade.hpp>
#include <deferred_shade/shader_table.hpp>
#include <deferred_shade/statistics.hpp>
#include <deferred_shade/types.hpp>
#include <deferred_shade/version.hpp>
#include <deferred_shade/workspace.hpp>
