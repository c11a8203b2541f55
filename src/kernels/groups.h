#pragma once
// The groups of kernels, one translation unit each. Every group fills its slots of the table.

#include "kernels/table.h"

namespace yat::YAT_ISA {}  // namespace yat::YAT_ISA
