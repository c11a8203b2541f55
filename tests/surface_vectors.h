#pragma once
// Columns of surfaces as vectors of double precision, and back.

#include <glm/vec3.hpp>

#include "soa/records.h"

namespace yat {

inline void put(const glm::dvec3& v, float& x, float& y, float& z) {
  x = float(v.x), y = float(v.y), z = float(v.z);
}
inline glm::dvec3 pos_of(const Surface<Value>& s) {
  return {s.pos_x, s.pos_y, s.pos_z};
}
inline glm::dvec3 ng_of(const Surface<Value>& s) {
  return {s.ng_x, s.ng_y, s.ng_z};
}
inline glm::dvec3 ns_of(const Surface<Value>& s) {
  return {s.ns_x, s.ns_y, s.ns_z};
}
inline glm::dvec3 wo_of(const Surface<Value>& s) {
  return {s.wo_x, s.wo_y, s.wo_z};
}

}  // namespace yat
