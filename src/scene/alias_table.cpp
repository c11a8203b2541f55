#include "scene/alias_table.h"

#include <algorithm>

namespace yat {

AliasTable make_alias_table(std::span<const double> weights) {
  const auto n = uint32_t(weights.size());
  AliasTable table;
  table.choice.resize(n);
  table.probability.resize(n);
  if (n == 0) return table;

  // Weights may span more than the range of a double: scale by the largest before adding up.
  const double largest = *std::max_element(weights.begin(), weights.end());
  std::vector<double> share(n);  // n times the probability
  double total = 0;
  for (uint32_t i = 0; i < n; ++i) total += share[i] = weights[i] / largest;
  double raised_total = 0;
  for (uint32_t i = 0; i < n; ++i) {
    share[i] = weights[i] > 0 ? std::max(share[i] * n / total, 1. / 1024) : 0;
    raised_total += share[i];
  }
  for (double& s : share) s *= n / raised_total;

  std::vector<uint32_t> small, large;
  for (uint32_t i = 0; i < n; ++i) (share[i] < 1 ? small : large).push_back(i);
  while (!small.empty() && !large.empty()) {
    const uint32_t s = small.back(), l = large.back();
    small.pop_back();
    table.choice[s] = {float(share[s]), l};
    share[l] -= 1 - share[s];
    if (share[l] < 1) {
      large.pop_back();
      small.push_back(l);
    }
  }
  // What is left has a share of 1 up to rounding - except rows of weight 0 that rounding left
  // without a partner: they pass everything on to the likeliest row.
  const auto likeliest =
      uint32_t(std::max_element(weights.begin(), weights.end()) - weights.begin());
  for (const auto& rest : {small, large})
    for (uint32_t i : rest)
      table.choice[i] =
          weights[i] > 0 ? LightChoice<Value>{1.f, i} : LightChoice<Value>{0.f, likeliest};

  std::vector<double> chosen(n, 0.);
  for (uint32_t i = 0; i < n; ++i) {
    const auto t = double(table.choice[i].threshold);
    chosen[i] += t;
    chosen[table.choice[i].other] += 1 - t;
  }
  for (uint32_t i = 0; i < n; ++i) table.probability[i] = float(chosen[i] / n);
  return table;
}

}  // namespace yat
