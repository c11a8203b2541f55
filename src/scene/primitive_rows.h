#pragma once
// Primitives as kernels read them: a row each (part of scene/compiled.h).

#include <cstdint>

#include "soa/fields.h"

namespace yat {

/// A triangle as shading reads it: one cache line. Vertex order makes (p1-p0)x(p2-p0) the outside.
template <template <class> class Of>
struct TriangleRow {
  Of<float> p0_x, p0_y, p0_z, p1_x, p1_y, p1_z, p2_x, p2_y, p2_z;  ///< scene space [m]
  Of<float> extent;        ///< largest |coordinate| of the three vertices [m]: scale of rounding
  Of<uint32_t> parameter;  ///< row of its material kind's parameter table
  Of<uint32_t> light;      ///< row of the light table, or kNone
  YAT_FIELDS(p0_x, p0_y, p0_z, p1_x, p1_y, p1_z, p2_x, p2_y, p2_z, extent, parameter, light)
};
static_assert(all_fields_listed<TriangleRow>);

/// Vertex normals and texture coordinates of a triangle; read only in bins that have them.
template <template <class> class Of>
struct TriangleVertexRow {
  Of<float> n0_x, n0_y, n0_z, n1_x, n1_y, n1_z, n2_x, n2_y, n2_z;  ///< unit, on the outside's side
  Of<float> u0, v0, u1, v1, u2, v2;
  YAT_FIELDS(n0_x, n0_y, n0_z, n1_x, n1_y, n1_z, n2_x, n2_y, n2_z, u0, v0, u1, v1, u2, v2)
};
static_assert(all_fields_listed<TriangleVertexRow>);

/// A whole sphere. Normals point away from the centre, or towards it where `inward` is 1.
template <template <class> class Of>
struct SphereRow {
  Of<float> center_x, center_y, center_z, radius;  ///< scene space [m], radius > 0
  Of<uint32_t> inward;
  Of<uint32_t> parameter, light;
  Of<uint32_t> occludes;  ///< 1: stops shadow rays; 0: see-through (null material)
  /// The sphere's own x and z axes, unit, in scene space; y = hand * (z cross x), hand 1 or -1.
  Of<float> x_x, x_y, x_z, z_x, z_y, z_z, hand;
  YAT_FIELDS(center_x, center_y, center_z, radius, inward, parameter, light, occludes, x_x, x_y,
             x_z, z_x, z_y, z_z, hand)
};
static_assert(all_fields_listed<SphereRow>);

/// An infinite plane: points p with dot(normal, p) = distance. Never a light.
template <template <class> class Of>
struct PlaneRow {
  Of<float> normal_x, normal_y, normal_z, distance;  ///< unit normal; scene space [m]
  Of<uint32_t> parameter;
  Of<uint32_t> occludes;
  /// u = dot(u_xyz, p) + u_0, v likewise: lengths of object space along two axes of the plane.
  Of<float> u_x, u_y, u_z, u_0, v_x, v_y, v_z, v_0;
  YAT_FIELDS(normal_x, normal_y, normal_z, distance, parameter, occludes, u_x, u_y, u_z, u_0, v_x,
             v_y, v_z, v_0)
};
static_assert(all_fields_listed<PlaneRow>);

/// The other analytic shapes, each in a space of its own of about unit size, its axis of revolution
/// along z, phi from x towards y:
///   quadric  x^2 + y^2 = |g(z)|^2 + e z + s z^2 with g = (a + b z, c + d z): what is left where a
///            line or parabola goes round. Sphere: a = 1, s = -1. Cylinder: a = 1. Cone: a, b.
///            Paraboloid: a = e = 1. Hyperboloid: a, b, c, d, the line that goes round, phi counted
///            from it. z in [z_min, z_max]
///   disk     z = 0, x^2 + y^2 in [a, 1]
///   torus    major radius a, minor radius b, a >= b > 0, a + b = 1; theta, the angle in the tube,
///            0 outermost and growing towards +z, from the angle with cosine c and sine d on by the
///            angle with cosine e and sine s
enum class ShapeKind : uint32_t { kQuadric, kDisk, kTorus, kCount };
inline constexpr uint32_t kShapeKinds = uint32_t(ShapeKind::kCount);

/// An analytic shape and where it is. Rays go by o: p = o * (x - org), exactly as stored; w is the
/// inverse of o, rounded.
///
/// Angles end where the point (cos, sin) of their end says: with a sine below 0 (also of a whole
/// turn, which has a tiny one) the range is more than a half turn.
template <template <class> class Of>
struct ShapeRow {
  Of<float> o_xx, o_xy, o_xz, o_yx, o_yy, o_yz, o_zx, o_zy, o_zz;
  Of<float> org_x, org_y, org_z;  ///< scene space [m]
  Of<float> radius;               ///< of a sphere about org that holds the shape [m]
  Of<float> a, b, c, d, e, s;     ///< see ShapeKind
  Of<float> z_min, z_max;         ///< beyond the surface where it closes by itself
  Of<float> phi_cos, phi_sin;     ///< end of phi
  Of<uint32_t> kind;              ///< ShapeKind
  Of<uint32_t> occludes;          ///< as in SphereRow
  Of<float> w_xx, w_xy, w_xz, w_yx, w_yy, w_yz, w_zx, w_zy, w_zz;
  Of<float> extent;                     ///< largest |coordinate| of the shape, scene space [m]
  Of<float> inner_x, inner_y, inner_z;  ///< scale of rounding along each axis of its own space
  Of<float> u_scale;                    ///< u = phi in turns * u_scale
  Of<float> v_scale, v_offset;          ///< v = what grows along the profile * v_scale + v_offset
  Of<float> z_first, z_last;            ///< quadric: ends of the surface
  Of<float> stretch;                    ///< cube root of |determinant of w|
  Of<uint32_t> inward;                  ///< 1: the normal points to the other side than usual
  Of<uint32_t> parameter, light;
  YAT_FIELDS(o_xx, o_xy, o_xz, o_yx, o_yy, o_yz, o_zx, o_zy, o_zz, org_x, org_y, org_z, radius, a,
             b, c, d, e, s, z_min, z_max, phi_cos, phi_sin, kind, occludes, w_xx, w_xy, w_xz, w_yx,
             w_yy, w_yz, w_zx, w_zy, w_zz, extent, inner_x, inner_y, inner_z, u_scale, v_scale,
             v_offset, z_first, z_last, stretch, inward, parameter, light)
};
static_assert(all_fields_listed<ShapeRow>);

}  // namespace yat
