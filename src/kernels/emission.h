#pragma once
// Emission seen by a path, weighted against light sampling.

#include "kernels/accumulate.h"
#include "kernels/drop.h"
#include "kernels/light_choice.h"
#include "kernels/lights/rectangle.h"
#include "kernels/lights/shape.h"
#include "kernels/lights/sphere.h"
#include "kernels/lights/triangle.h"

namespace yat::YAT_ISA {

/// See KernelTable::add_emission, add_tree_emission. Surfaces shine on the side of their geometric
/// normal only.
template <class A, bool kByTree = false>
void add_emission(const SceneView& scene, const Surface<ConstColumn>& surfaces,
                  const PathState<ConstColumn>& paths, const SampleSum<Column>& sums, DropLog& log,
                  uint32_t n) noexcept {
  const Float<A> zero(0.f), one(1.f);
  for (uint32_t i = 0; i < n; i += kLanes<A>) {
    const UInt<A> light = load<A>(surfaces.light, i);
    const Vec3<A> ng{load<A>(surfaces.ng_x, i), load<A>(surfaces.ng_y, i),
                     load<A>(surfaces.ng_z, i)};
    const Vec3<A> wo{load<A>(surfaces.wo_x, i), load<A>(surfaces.wo_y, i),
                     load<A>(surfaces.wo_z, i)};
    const Float<A> cos = dot(ng, wo);
    // A NaN on the way counts as facing: it is dropped below, not hidden.
    Mask<A> shining = tail_mask<A>(i, n) & mask_of<A>(light != UInt<A>(kNone)) & !(cos <= zero);
    if (!any<A>(shining)) continue;

    const LightRowW<A> row = gather<A>(scene.lights.rows, only<A>(shining, light));
    const Float<A> scattered = load<A>(paths.pdf, i);
    const Float<A> distance = load<A>(surfaces.distance, i);
    const Vec3<A> pos{load<A>(surfaces.pos_x, i), load<A>(surfaces.pos_y, i),
                      load<A>(surfaces.pos_z, i)};
    const Vec3<A> receiver = pos + distance * wo;
    const SeenLight<A> seen{distance, cos};
    const Mask<A> rectangle =
        shining & mask_of<A>(row.kind == UInt<A>(uint32_t(LightKind::kRectangle)));
    const Mask<A> sphere = mask_of<A>(row.kind == UInt<A>(uint32_t(LightKind::kSphere)));
    // Camera rays and those off mirrors keep all they see, whatever the density.
    const Mask<A> weighted = shining & (scattered != zero);
    Float<A> sampled = TriangleLight<A>::pdf(row, weighted & ~rectangle, receiver, seen);
    if (any<A>(rectangle))
      sampled = select<A>(
          rectangle, RectangleLight<A>::pdf(row, weighted & rectangle, receiver, seen), sampled);
    if (any<A>(sphere & shining))
      sampled = select<A>(sphere, SphereLight<A>::pdf(row, receiver, seen), sampled);
    const Mask<A> shape = shining & mask_of<A>(row.kind == UInt<A>(uint32_t(LightKind::kShape)));
    if (any<A>(shape)) {
      const Float<A> of_shape = ShapeLight<A>::pdf(scene.geometry.shapes, row, shape, pos, seen);
      sampled = select<A>(shape, of_shape, sampled);
    }
    sampled = sampled * chance_of_light<A, kByTree>(scene.lights, light, row, receiver, shining);
    const Float<A> weight =
        select<A>(scattered == zero, one, power_heuristic<A>(scattered, sampled));

    const Float<A> r = load<A>(paths.throughput_r, i) * weight * row.radiance_r;
    const Float<A> g = load<A>(paths.throughput_g, i) * weight * row.radiance_g;
    const Float<A> b = load<A>(paths.throughput_b, i) * weight * row.radiance_b;
    drop_lanes<A>(shining, !(is_finite_positive<A>(scattered) & is_finite_positive<A>(weight)),
                  DropCause::kPdf, paths.pixel + i, paths.sample + i, log);
    drop_lanes<A>(shining,
                  !(is_finite_positive<A>(row.radiance_r) & is_finite_positive<A>(row.radiance_g) &
                    is_finite_positive<A>(row.radiance_b)),
                  DropCause::kLight, paths.pixel + i, paths.sample + i, log);
    drop_lanes<A>(shining, !(is_finite<A>(r) & is_finite<A>(g) & is_finite<A>(b)),
                  DropCause::kOther, paths.pixel + i, paths.sample + i, log);
    add_to_samples<A>(r, g, b, load<A>(paths.slot, i), shining, sums);
  }
}

}  // namespace yat::YAT_ISA
