// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deferred_shade/observer.hpp>
#include <deferred_shade/types.hpp>
#include <deferred_shade/workspace.hpp>

namespace deferred_shade::detail {

/// The workspace for a table whose shader k has another id, `ids[k]`, in the renderer's table: that
/// is the one which an observer is told.
template <class Allocator>
workspace<Allocator>& renumbered(workspace<Allocator>& scratch, shader_id const*) {
  return scratch;
}
template <class Allocator, class Observer>
auto renumbered(observed<Allocator, Observer> const& seen, shader_id const* ids) {
  return observed{seen.scratch, [observer = seen.observer, ids](phase p) {
                    if (p.shader) p.shader = ids[*p.shader];
                    return observer(p);
                  }};
}

}  // namespace deferred_shade::detail
