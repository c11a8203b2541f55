#pragma once
// Shape statements by family: parameters -> object space. compile_shape() chooses by the type.
// Each returns whether there is something to render; if not, the reason has been reported.

#include "scene/compile_parts.h"

namespace yat {

// ---- Meshes (read_meshes.cpp; lxs 5.1, 5.2, 12.4) ----------------------------------------------

/// `mesh` and its other names. to_world: where quads are split along the shorter diagonal.
bool read_mesh(Parameters& p, const Matrix& to_world, Dialect dialect, Mesh& mesh);
bool read_plymesh(Parameters& p, const Description& description, Mesh& mesh);
bool read_stlmesh(Parameters& p, const Description& description, Mesh& mesh);
/// A grid over the unit square.
bool read_heightfield(Parameters& p, Mesh& mesh);
/// The axis-aligned box [-w,w] x [-h,h] x [-d,d], outward, flat.
void make_box(const glm::dvec3& half, Mesh& mesh);

/// Torus with exact normals as 128 rings of 256 quads, for those with minor > major: rays to the
/// part behind the axis are beyond the analytic one. Angles in radians.
Mesh make_torus_mesh(double major, double minor, double theta_min, double theta_sweep,
                     double phi_max);

// ---- Analytic shapes (read_analytic.cpp; lxs 5.3) ----------------------------------------------

/// sphere, disk, cylinder, cone, paraboloid, hyperboloid, torus; false also for another type.
bool read_analytic(Parameters& p, std::string_view type, CompiledShape& shape);
/// Whether read_analytic() knows the type.
bool is_analytic(std::string_view type);

}  // namespace yat
