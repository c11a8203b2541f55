#include "converge/ladder.h"

#include <bit>

namespace yat {

namespace {

/// A mixing step of MurmurHash3 (Appleby 2011).
uint32_t mix(uint32_t h) {
  h = (h ^ (h >> 16)) * 0x85ebca6bu;
  h = (h ^ (h >> 13)) * 0xc2b2ae35u;
  return h ^ (h >> 16);
}

constexpr uint32_t kReferenceBit = 0x80000000u;

}  // namespace

std::vector<uint32_t> ladder_up_to(uint32_t most) {
  std::vector<uint32_t> ladder;
  for (uint64_t spp = 1; spp < most; spp *= 4) ladder.push_back(uint32_t(spp));
  ladder.push_back(most);
  return ladder;
}

uint32_t run_seed(uint32_t base, uint32_t spp, uint32_t run) {
  return mix(mix(mix(base) + spp) + run) & ~kReferenceBit;
}

uint32_t reference_seed(uint32_t base, uint32_t part) {
  return mix(mix(base) + part) | kReferenceBit;
}

std::vector<uint32_t> not_powers_of_two(const std::vector<uint32_t>& ladder) {
  std::vector<uint32_t> odd;
  for (const uint32_t spp : ladder)
    if (!std::has_single_bit(spp)) odd.push_back(spp);
  return odd;
}

}  // namespace yat
