#include "soa/columns.h"

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace yat {

std::unique_ptr<std::byte[], FreeAligned> allocate_unset(size_t bytes) {
  constexpr size_t kHugePage = size_t(2) << 20;
  const size_t alignment = bytes >= kHugePage ? kHugePage : 64;
  const size_t rounded = (bytes + alignment - 1) / alignment * alignment;
  if (rounded < bytes) throw std::bad_alloc();
  void* p = std::aligned_alloc(alignment, rounded ? rounded : alignment);
  if (!p) throw std::bad_alloc();
#if defined(__linux__) && defined(MADV_HUGEPAGE)
  // Only a hint: the tables are right, if slower, on small pages.
  if (alignment == kHugePage) madvise(p, rounded, MADV_HUGEPAGE);
#endif
  return std::unique_ptr<std::byte[], FreeAligned>(static_cast<std::byte*>(p));
}

std::unique_ptr<std::byte[], FreeAligned> allocate_aligned(size_t bytes) {
  auto memory = allocate_unset(bytes);
  if (bytes) std::memset(memory.get(), 0, bytes);
  return memory;
}

}  // namespace yat
