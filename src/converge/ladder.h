#pragma once
// Which numbers of samples are measured, and by which seeds.

#include <cstdint>
#include <string>
#include <vector>

namespace yat {

/// Stands for a rung in the records of variants whose noise target decides how many samples they
/// take, which differs from run to run.
inline constexpr uint32_t kTargetRung = 0;
/// Stands for one where no run is meant: no ladder has it.
inline constexpr uint32_t kNoRung = UINT32_MAX;

/// 1, 4, 16, ... up to `most`, and `most` itself.
std::vector<uint32_t> ladder_up_to(uint32_t most);

/// Seed of a run. Runs of different rungs share no samples; those of variants do, so that what the
/// seed brings cancels out of their ratio. Below 2^31.
///
/// base  --seed; spp  the rung, or one of the above; run  from 0.
uint32_t run_seed(uint32_t base, uint32_t spp, uint32_t run);
/// Seed of a part of the reference: 2^31 and above, never that of a run.
uint32_t reference_seed(uint32_t base, uint32_t part);

/// Rungs that are no powers of two: between them the error of a Sobol sequence is up to twice as
/// large.
std::vector<uint32_t> not_powers_of_two(const std::vector<uint32_t>& ladder);

}  // namespace yat
