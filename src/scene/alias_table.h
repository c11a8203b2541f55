#pragma once
// Alias tables (Walker 1977; Vose 1991): choose one of n rows with given probabilities in O(1).

#include <span>
#include <vector>

#include "scene/compiled.h"

namespace yat {

struct AliasTable {
  /// u * n falls into interval i = floor(u * n); with f = u * n - i in [0, 1), row i is chosen
  /// where f < threshold, row `other` elsewhere.
  std::vector<LightChoice<Value>> choice;
  /// With which each row is chosen, computed from the thresholds as stored (floats): exactly what
  /// the table does, whatever the rounding of its making. 0 only for weights of 0.
  std::vector<float> probability;
};

/// weights: finite, >= 0, at least one > 0. Rows of weight 0 are never chosen. A row whose weight
/// is below 2^-10 of the mean gets that: it must be reachable with random numbers of 24 bits, and
/// choosing it a little too often costs nothing, because what is sampled is divided by what is in
/// `probability`.
AliasTable make_alias_table(std::span<const double> weights);

}  // namespace yat
