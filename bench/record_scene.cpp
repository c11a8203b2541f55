#include "record_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "kernels/materials/all.h"
#include "scene/compile.h"
#include "scene/parse.h"
#include "wavefront/plan.h"
#include "wavefront/work.h"

namespace yat::bench {
namespace {

constexpr uint32_t kMaxRays = 1u << 26;

/// White in every row.
RowTable<MatteParameters> white() {
  RowTable<MatteParameters> table(1);
  table.set(0, {1, 1, 1});
  return table;
}

BenchScene triangles_of(const Scene& scene, const std::string& path) {
  std::vector<float> corners(size_t(scene.triangles.size()) * 9);
  for (uint32_t i = 0; i < scene.triangles.size(); ++i) {
    const TriangleRow<Value> row = scene.triangles.row(i);
    std::copy_n(&row.p0_x, 9, corners.data() + size_t(i) * 9);
  }
  return scene_of(std::filesystem::path(path).stem().string(), std::move(corners));
}

/// The paths under way, and what a stage hands to the next; one row per camera ray.
class Recorder {
 public:
  Recorder(const Scene& scene, const KernelTable& kernels, const RecordOptions& options, uint32_t n)
      : scene_(scene),
        view_(scene.view()),
        kernels_(kernels),
        options_(options),
        white_(white()),
        rays_(n),
        next_rays_(n),
        paths_(n),
        next_paths_(n),
        bin_paths_(n),
        hits_(n),
        surfaces_(n),
        randoms_(n),
        lights_(n),
        shadow_(n),
        bin_(n),
        order_(n),
        finished_(n),
        scratch_(std::max(kernels.traversal_scratch_bytes(view_.geometry.tree, n),
                          scene.shape_tree.view.node_count
                              ? kernels.shape_scratch_bytes(scene.shape_tree.view, n)
                              : 0)) {
    PlanOptions plan;
    plan.max_depth = 0x7fff;
    plan.seed = options.seed;
    plan_ = make_plan(scene, kernels, plan);
    plan_.transport.roulette_depth = 0xffff;
  }

  /// Camera rays of `samples` samples per pixel, n in all.
  void generate(uint32_t samples) {
    // One worker's tiles, in the order in which a render lists their paths.
    Table<CameraSample> camera(rays_.capacity());
    WorkList work(scene_.film, 0, samples, 64, 1);
    WorkCursor cursor;
    while (const WorkUnit* unit = work.claim()) {
      cursor.start(*unit);
      count_ += cursor.take(rays_.capacity() - count_, camera.columns().pixel + count_,
                            camera.columns().sample + count_);
    }
    for (uint32_t i = 0; i < count_; ++i) camera.columns().slot[i] = i;
    AlignedArray<float> film_u(count_), film_v(count_), lens_u(count_), lens_v(count_);
    const auto draw_camera = [&](Dimension dimension, float* u, float* v) {
      kernels_.draw[uint32_t(plan_.sampler)](options_.seed, dimension, camera.view().pixel,
                                             camera.view().sample, nullptr, u, v, count_);
    };
    draw_camera(Dimension::kFilm, film_u.data(), film_v.data());
    if (has_lens(plan_.camera)) draw_camera(Dimension::kLens, lens_u.data(), lens_v.data());
    kernels_.generate_camera_rays[uint32_t(plan_.camera)](
        view_, camera.view(), film_u.data(), film_v.data(),
        has_lens(plan_.camera) ? lens_u.data() : nullptr,
        has_lens(plan_.camera) ? lens_v.data() : nullptr, rays_.columns(), paths_.columns(),
        count_);
  }

  RaySet set_of(std::string name) const {
    RaySet set{std::move(name), false, {}};
    for (uint32_t i = 0; i < count_; ++i) set.rays.push_back(rays_.row(i));
    return set;
  }

  /// Follows all paths over one vertex; appends the sets of what leaves it.
  void follow(uint32_t vertex, std::vector<RaySet>& sets) {
    intersect();
    ShadeOutput out;
    out.rays = next_rays_.columns();
    out.paths = next_paths_.columns();
    out.shadow_rays = shadow_.columns();
    out.finished = finished_.data();
    RaySet mirror{"mirror", false, {}};
    for (uint32_t bin = 1; bin < scene_.bins.size(); ++bin) {
      const uint32_t n = make_surfaces(bin);
      if (!n) continue;
      if (vertex == 1) append_mirrored(n, mirror.rays);
      shade(bin, n, out);
    }
    std::swap(rays_, next_rays_);
    std::swap(paths_, next_paths_);
    count_ = out.path_count;
    RaySet shadow{fmt::format("shadow {}", vertex), true, {}};
    if (vertex < options_.vertices)
      for (uint32_t i = 0; i < out.shadow_count; ++i) {
        const ShadowRay<Value> r = shadow_.row(i);
        shadow.rays.push_back({r.org_x, r.org_y, r.org_z, r.dir_x, r.dir_y, r.dir_z, 1});
      }
    const bool matte = options_.materials == RecordMaterials::kMatte;
    RaySet next = set_of(fmt::format("{} {}", matte ? "diffuse" : "path", vertex));
    for (RaySet* set : {&mirror, &shadow, &next})
      if (!set->rays.empty()) sets.push_back(std::move(*set));
  }

 private:
  void intersect() {
    const GeometryView& geometry = view_.geometry;
    const uint32_t triangles = geometry.triangles.count;
    kernels_.intersect_closest(geometry.tree, rays_.view(), hits_.columns(), count_,
                               {scratch_.data(), scratch_.size()});
    if (plan_.spheres)
      kernels_.intersect_spheres(geometry.spheres, triangles, rays_.view(), hits_.columns(),
                                 count_);
    if (plan_.planes)
      kernels_.intersect_planes(geometry.planes, triangles + geometry.spheres.count, rays_.view(),
                                hits_.columns(), count_);
    const uint32_t first_shape = triangles + geometry.spheres.count + geometry.planes.count;
    for (uint32_t kind = 0; kind < kShapeKinds; ++kind)
      if (plan_.shapes[kind])
        kernels_.intersect_shapes[kind](geometry.shapes, first_shape, rays_.view(), hits_.columns(),
                                        count_);
    if (plan_.shape_tree)
      kernels_.intersect_shape_tree(geometry, geometry.shapes.tree, rays_.view(), hits_.columns(),
                                    count_, {scratch_.data(), scratch_.size()});
    kernels_.classify_hits(geometry.prim_bin, plan_.first_lasting_bin, plan_.transport.max_depth,
                           hits_.view(), paths_.view().depth, bin_.data(), count_);
  }

  /// Surfaces and path states of one bin's rows; how many.
  uint32_t make_surfaces(uint32_t bin) {
    uint32_t n = 0;
    for (uint32_t i = 0; i < count_; ++i)
      if (bin_[i] == bin) order_[n++] = i;
    if (n)
      kernels_.make_surfaces[uint32_t(scene_.bins[bin].geometry)](
          view_, order_.data(), rays_.view(), hits_.view(), paths_.view(), surfaces_.columns(),
          bin_paths_.columns(), n);
    return n;
  }

  void append_mirrored(uint32_t n, std::vector<Ray<Value>>& rays) const {
    for (uint32_t i = 0; i < n; ++i) {
      const Surface<Value> s = surfaces_.row(i);
      const glm::dvec3 wo{s.wo_x, s.wo_y, s.wo_z};
      glm::dvec3 ng{s.ng_x, s.ng_y, s.ng_z};
      if (glm::dot(ng, wo) < 0) ng = -ng;
      const glm::dvec3 p = glm::dvec3{s.pos_x, s.pos_y, s.pos_z} + ng * double(s.offset);
      const glm::dvec3 d = glm::normalize(ng * (2 * glm::dot(ng, wo)) - wo);
      rays.push_back(
          {float(p.x), float(p.y), float(p.z), float(d.x), float(d.y), float(d.z), kRayFar});
    }
  }

  void draw(Dimension dimension, float* first, float* second, uint32_t n) const {
    const PathState<ConstColumn> paths = bin_paths_.view();
    kernels_.draw[uint32_t(plan_.sampler)](options_.seed, dimension, paths.pixel, paths.sample,
                                           paths.depth, first, second, n);
  }

  void shade(uint32_t bin, uint32_t n, ShadeOutput& out) {
    const BinPlan& plan = plan_.bins[bin];
    // What is made of others counts as matte too: rays are what is recorded, not light.
    const bool matte = options_.materials == RecordMaterials::kMatte || plan.splits;
    const Randoms<Column>& randoms = randoms_.columns();
    draw(Dimension::kLight, randoms.light_u, randoms.light_v, n);
    draw(Dimension::kChoice, randoms.light_choice, randoms.lobe, n);
    draw(Dimension::kBsdf, randoms.bsdf_u, randoms.bsdf_v, n);
    // No roulette: without that column there is none.
    Randoms<ConstColumn> drawn = randoms_.view();
    drawn.roulette = nullptr;
    LightSample<ConstColumn> lights{};
    if (matte ? plan_.lights : plan.sample_lights) {
      kernels_.sample_lights[plan_.light_groups[0].kernel](view_, surfaces_.view(), drawn,
                                                           lights_.columns(), n);
      lights = lights_.view();
    }
    const MaterialKind kind = matte ? MaterialKind::kMatte : plan.bin.material;
    ParameterView parameters = view_.parameters[uint32_t(kind)];
    // Textures are not evaluated: what the material is without them will do for the next rays.
    if (plan.bin.program != kNone) {
      const TextureProgram& program = scene_.programs[plan.bin.program];
      parameters = {program.parameters.data(), program.rows, nullptr};
    }
    if (matte) {
      parameters = {white_.view().words, 1, nullptr};
      std::fill_n(surfaces_.columns().parameter, n, 0u);
    }
    DropLog drops;
    kernels_.shade[uint32_t(kind)]({surfaces_.view(), bin_paths_.view(), drawn, lights, parameters},
                                   plan_.transport, out, drops, n);
  }

  const Scene& scene_;
  const SceneView view_;
  const KernelTable& kernels_;
  const RecordOptions options_;
  Plan plan_;
  RowTable<MatteParameters> white_;
  uint32_t count_ = 0;
  Table<Ray> rays_, next_rays_;
  Table<PathState> paths_, next_paths_, bin_paths_;
  Table<Hit> hits_;
  Table<Surface> surfaces_;
  Table<Randoms> randoms_;
  Table<LightSample> lights_;
  Table<ShadowRay> shadow_;
  AlignedArray<uint32_t> bin_, order_, finished_;
  AlignedArray<std::byte> scratch_;
};

}  // namespace

Recording record_scene(const std::string& path, const KernelTable& kernels,
                       const RecordOptions& options, Diagnostics& diagnostics) {
  ThreadPool pool;
  CompileOptions compile;
  compile.instances = InstanceMode::kCopy;       // Embree and the judge get one list of triangles.
  compile.light_choice = LightChoosing::kPower;  // One kernel for all scenes.
  compile.block_width = std::max(4u, kernels.lanes);
  compile.width = options.width;
  compile.height = options.height;
  const Scene scene = compile_scene(read_scene(path, diagnostics), compile, pool, diagnostics);
  if (scene.triangles.size() == 0)
    throw Error(path +
                ": error: no triangles, so no rays to trace through a tree; take a scene "
                "that has a mesh");
  const uint64_t pixels = uint64_t(scene.film.crop_width()) * scene.film.crop_height();
  const uint64_t samples =
      options.samples
          ? options.samples
          : std::max<uint64_t>(
                1, uint64_t(std::llround(double(options.camera_rays) / double(pixels))));
  if (pixels * samples > kMaxRays)
    throw Error(
        fmt::format("{}: error: {} camera rays are more than {}; take fewer pixels or "
                    "samples",
                    path, pixels * samples, kMaxRays));
  Recorder recorder(scene, kernels, options, uint32_t(pixels * samples));
  Recording out;
  out.scene = triangles_of(scene, path);
  recorder.generate(uint32_t(samples));
  out.sets.push_back(recorder.set_of("camera"));
  for (uint32_t vertex = 1; vertex <= options.vertices; ++vertex) recorder.follow(vertex, out.sets);
  return out;
}

}  // namespace yat::bench
