// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deferred_shade/config.hpp>  // first: it refuses what is too old

#include <deferred_shade/dispatch.hpp>
#include <deferred_shade/gather.hpp>
#include <deferred_shade/grouping.hpp>
#include <deferred_shade/items.hpp>
#include <deferred_shade/loop.hpp>
#include <deferred_shade/observer.hpp>
#include <deferred_shade/record_shaders.hpp>
#include <deferred_shade/run.hpp>
#include <deferred_shade/schedule.hpp>
#include <deferred_shade/shade.hpp>
#include <deferred_shade/shader_table.hpp>
#include <deferred_shade/shader_traits.hpp>
#include <deferred_shade/statistics.hpp>
#include <deferred_shade/tuning.hpp>
#include <deferred_shade/types.hpp>
#include <deferred_shade/version.hpp>
#include <deferred_shade/workspace.hpp>
