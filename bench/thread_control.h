#pragma once
// What so many threads gain on this machine, now, at best.

#include <cstdint>

namespace yat::bench {

/// Gain by the clock of `threads` threads over one for arithmetic that stays in registers: median
/// of rounds in turn, about half a second. What a kernel gains beyond this is luck; on a machine
/// that other programs or other guests use it is less than `threads`.
double registers_gain(uint32_t threads);

}  // namespace yat::bench
