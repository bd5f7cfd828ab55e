// SPDX-License-Identifier: Apache-2.0
// What a tool that attaches to NVTX sees. Needs NVTX's headers, but neither a GPU nor nvcc.
// Covers nvtx.hpp.
#include <deferred_shade/nvtx.hpp>

#include <stdlib.h>  // unsetenv

#include <cstdint>
#include <deferred_shade/deferred_shade.hpp>
#include <string>
#include <vector>

#include "catch.hpp"
#include "support/backends.hpp"

namespace ds = deferred_shade;

namespace {

// A tool as small as it can be: writes the ranges of the library's domain down.
std::string ranges;
int domain;  // its address is the handle

nvtxDomainHandle_t create(char const* name) {
  bool const ours = std::string(name) == "deferred_shade";
  return ours ? reinterpret_cast<nvtxDomainHandle_t>(&domain) : nullptr;
}
int push(nvtxDomainHandle_t where, nvtxEventAttributes_t const* what) {
  if (where == create("deferred_shade")) ranges += what->message.ascii + std::string("{");
  return 0;
}
int pop(nvtxDomainHandle_t where) {
  if (where == create("deferred_shade")) ranges += '}';
  return 0;
}

int attach(NvtxGetExportTableFunc_t table) {
  auto const* const callbacks =
      static_cast<NvtxExportTableCallbacks const*>(table(NVTX_ETID_CALLBACKS));
  NvtxFunctionTable functions = nullptr;
  unsigned size = 0;
  if (callbacks->GetModuleFunctionTable(NVTX_CB_MODULE_CORE2, &functions, &size) == 0) return 0;
  *functions[NVTX_CBID_CORE2_DomainCreateA] = reinterpret_cast<NvtxFunctionPointer>(&create);
  *functions[NVTX_CBID_CORE2_DomainRangePushEx] = reinterpret_cast<NvtxFunctionPointer>(&push);
  *functions[NVTX_CBID_CORE2_DomainRangePop] = reinterpret_cast<NvtxFunctionPointer>(&pop);
  return 1;
}
[[maybe_unused]] bool const attached = [] {
  unsetenv("NVTX_INJECTION64_PATH");  // another tool's, which compute-sanitizer sets: it would win
  InitializeInjectionNvtx2_fnptr = &attach;
  return true;
}();

struct nothing {
  DEFERRED_SHADE_HOST_DEVICE void operator()(ds::request_index) const {}
};

}  // namespace

TEMPLATE_LIST_TEST_CASE("a tool sees the phases as ranges of the library's domain", "[nvtx]",
                        test::host_backends) {
  std::vector<std::uint8_t> const ids{2, 0, 255, 2};
  ds::workspace scratch{TestType::policy()};
  ds::observed seen{scratch, ds::nvtx_ranges{}};
  ranges.clear();
  ds::shade(TestType::policy(), ds::bucket_then_dispatch<>{}, ids.size(), ids.data(),
            ds::shader_table{nothing{}, nothing{}, nothing{}}, seen);
  CHECK(ranges == "group{}dispatch{shader 0{}shader 2{}}");
}
