#pragma once
// What a material is tried with in test_materials.cpp. A new material does not compile there
// without a function cases(NAMEParameters<Value>).

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "soa/fields.h"

namespace yat {

/// The unit vector of this z and azimuth.
inline glm::dvec3 at_cosine(double cos, double phi) {
  const double sin = std::sqrt(std::max(0., 1 - cos * cos));
  return {sin * std::cos(phi), sin * std::sin(phi), cos};
}

/// f in double precision at local directions, wo.z > 0.
using Formula = std::function<glm::dvec3(const glm::dvec3& wo, const glm::dvec3& wi)>;

template <template <template <class> class> class Record>
struct Case {
  std::string name;
  Record<Value> parameters;
  Formula f;                ///< null for delta materials
  double albedo = 1;        ///< the model's own bound where its reflectances are 1
  bool reciprocal = true;   ///< f(a, b) = f(b, a)
  Formula inside{nullptr};  ///< seen from the inside, where that is another formula
  double tolerance = 0;     ///< relative error of f that rounding explains
  int grid = 6;             ///< points a side in a cell of the quadratures; 0: too narrow for them
  /// What single directions bring beside f, by the cosine of wo (negative: inside).
  std::function<glm::dvec3(double cos)> mirror{nullptr};
  const Formula& seen_from(double side) const { return side < 0 && inside ? inside : f; }
};

}  // namespace yat
