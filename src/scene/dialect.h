#pragma once
// Whose rules a scene is read by. The two share their grammar and differ in what statements mean:
// docs/scene-format.md, "YART's rules", has the list.

#include <cstdint>

namespace yat {

enum class Dialect : uint8_t { kLuxRender, kYart };

}  // namespace yat
