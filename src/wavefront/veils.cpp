// Shadow rays through surfaces that let a part of the light pass (kernels/veil.h): turn after turn,
// every ray that is under way goes on to the next veil, until none is left.

#include <algorithm>

#include "wavefront/schedule.h"

namespace yat {

void Worker::walk_veils(const ShadowRay<ConstColumn>& rays, uint32_t shadow_rays) {
  VeilRows& v = batch_.veils;
  uint32_t side = 0;
  uint32_t n = kernels_.start_veils(rays, batch_.occluded.data(), v.rays[0].columns(),
                                    v.paths[0].columns(), shadow_rays);
  // As many crossings as a path may have.
  for (uint32_t crossed = 0; n && crossed < 0xffffu; ++crossed, side ^= 1) {
    intersect_veils(side, n);
    kernels_.classify_hits(view_.geometry.prim_bin, 0, kNone, v.hits.view(),
                           v.paths[side].view().depth, v.bin.data(), n);
    kernels_.end_veils(v.bin.data(), v.paths[side].view(), batch_.sums.columns(), n);
    uint32_t begin[kMaxBins + 1];
    const uint32_t bins = uint32_t(plan_.bins.size());
    std::fill_n(begin, bins + 1, 0u);
    for (uint32_t i = 0; i < n; ++i) ++begin[v.bin[i] + 1];
    for (uint32_t b = 0; b < bins; ++b) begin[b + 1] += begin[b];
    uint32_t place[kMaxBins];
    std::copy_n(begin, bins, place);
    for (uint32_t i = 0; i < n; ++i) v.order[place[v.bin[i]]++] = i;
    uint32_t next = 0;
    for (uint32_t b = 1; b < bins; ++b)
      for (uint32_t i = begin[b]; i < begin[b + 1]; i += kChunkRows)
        next = pass_veil(plan_.bins[b], side, i, std::min(i + kChunkRows, begin[b + 1]), next);
    n = next;
  }
  const uint32_t* const slot = v.paths[side].view().slot;
  for (uint32_t i = 0; i < n; ++i) {
    const uint32_t pixel = batch_.sums.columns().pixel[slot[i]];
    const uint32_t x = scene_.film.crop_x0 + pixel % film_.width();
    const uint32_t y = scene_.film.crop_y0 + pixel / film_.width();
    counted_.drops.add(DropCause::kCrossings, y << 16 | x, batch_.slot_sample[slot[i]]);
  }
}

void Worker::intersect_veils(uint32_t side, uint32_t n) {
  VeilRows& v = batch_.veils;
  const Ray<ConstColumn> rays = v.rays[side].view();
  const Hit<Column>& hits = v.hits.columns();
  if (view_.veils.tree.node_count) {
    kernels_.intersect_closest(view_.veils.tree, rays, hits, n, batch_.scratch);
  } else {
    std::copy_n(rays.t_max, n, hits.t);
    std::fill_n(hits.prim, n, kNone);
  }
  const ShapesView& shapes = view_.veils.shapes;
  if (plan_.veil_shape_tree) {
    kernels_.intersect_shape_tree(view_.geometry, shapes.tree, rays, hits, n, batch_.scratch);
  } else {
    if (view_.veils.spheres.count)
      kernels_.intersect_spheres(view_.veils.spheres, view_.veils.first_sphere, rays, hits, n);
    const uint32_t first =
        view_.geometry.triangles.count + view_.geometry.spheres.count + view_.geometry.planes.count;
    for (uint32_t kind = 0; kind < kShapeKinds; ++kind)
      if (shapes.kinds[kind].first < shapes.kinds[kind].end)
        kernels_.intersect_shapes[kind](shapes, first, rays, hits, n);
  }
  if (view_.veils.planes.count)
    kernels_.intersect_planes(view_.veils.planes, view_.veils.first_plane, rays, hits, n);
}

uint32_t Worker::pass_veil(const BinPlan& bin, uint32_t side, uint32_t begin, uint32_t end,
                           uint32_t count) {
  VeilRows& v = batch_.veils;
  const uint32_t n = end - begin;
  kernels_.make_surfaces[uint32_t(bin.bin.geometry)](
      view_, v.order.data() + begin, v.rays[side].view(), v.hits.view(), v.paths[side].view(),
      batch_.surfaces.columns(), batch_.chunk_paths.columns(), n);
  std::fill_n(v.weight.data(), n, 1.f);
  for (AlignedArray<float>* sum : {&v.r, &v.g, &v.b}) std::fill_n(sum->data(), n, 0.f);
  add_passing(bin, bin.bin.geometry, batch_.surfaces.columns(), false, v.weight.data(), n, 0);
  return kernels_.pass_veils(batch_.surfaces.view(), batch_.chunk_paths.view(), v.r.data(),
                             v.g.data(), v.b.data(), v.rays[side ^ 1].columns(),
                             v.paths[side ^ 1].columns(), count, n);
}

void Worker::add_passing(const ShadePlan& plan, GeometryKind geometry,
                         const Surface<Column>& surfaces, bool turned, const float* weight,
                         uint32_t n, uint32_t level) {
  VeilRows& v = batch_.veils;
  const uint32_t material = uint32_t(plan.material);
  const auto veil = kernels_.veil[material];
  if (!plan.splits && !veil) return;
  const Surface<ConstColumn> seen = as_const_columns<Surface>(surfaces);
  ParameterView parameters = view_.parameters[material];
  if (plan.program != kNone)
    parameters = batch_.textures.run(
        plan.program, {view_, geometry, nullptr, nullptr, surfaces, batch_.chunk_paths.view(), n});
  if (!plan.splits) {
    veil(parameters, seen, turned, weight, v.r.data(), v.g.data(), v.b.data(), n);
    return;
  }
  SplitRows& split = batch_.splits[level];
  kernels_.split[material](parameters, seen, turned, split.share.data(), split.parameter[0].data(),
                           split.parameter[1].data(), n);
  kernels_.share_weight(weight, split.share.data(), split.weight[0].data(), split.weight[1].data(),
                        n);
  for (uint32_t c = 0; c < 2; ++c) {
    Surface<Column> own = surfaces;
    own.parameter = split.parameter[c].data();
    add_passing(plan_.children[plan.child[c]], geometry, own, turned != plan.turned[c],
                split.weight[c].data(), n, level + 1);
  }
}

}  // namespace yat
