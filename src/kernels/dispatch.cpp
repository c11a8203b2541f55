#include "kernels/dispatch.h"

#include <array>
#include <cstdlib>

#include "base/error.h"

namespace yat {

// The generated list has one YAT_ISA_ENTRY(name, condition) per yat_add_isa call.
#define YAT_ISA_ENTRY(name, condition) \
  namespace name {                     \
  const KernelTable* kernel_table();   \
  }
#include "isa_list.inc"
#undef YAT_ISA_ENTRY

std::span<const IsaEntry> built_isas() {
  static const std::array entries = {
#define YAT_ISA_ENTRY(name, condition) IsaEntry{#name, bool(condition), &name::kernel_table},
#include "isa_list.inc"
#undef YAT_ISA_ENTRY
  };
  return entries;
}

const KernelTable& select_kernels(std::string_view wanted) {
  std::string_view from = "--isa";
  if (wanted.empty()) {
    const char* variable = std::getenv("YAT_ISA");
    if (variable && *variable) {
      wanted = variable;
      from = "YAT_ISA";
    }
  }
  const IsaEntry* best = nullptr;
  std::string runnable;
  for (const IsaEntry& entry : built_isas()) {
    if (!entry.here) continue;
    runnable += (runnable.empty() ? "" : ", ") + std::string(entry.name);
    if (wanted.empty() || wanted == entry.name) best = &entry;
  }
  if (!best) {
    bool known = false;
    for (const IsaEntry& entry : built_isas()) known = known || wanted == entry.name;
    throw UsageError(
        std::string(from) + " " + std::string(wanted) + ": " +
        (known ? "this CPU does not run it" : "no such instruction set in this build") +
        "; choose from " + runnable);
  }
  return *best->table();
}

}  // namespace yat
