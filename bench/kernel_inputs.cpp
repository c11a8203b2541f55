#include "kernel_inputs.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>
#include <stdexcept>

#include "base/error.h"
#include "kernel_bench.h"
#include "scene/parse.h"

namespace yat::bench {

std::string room_text(LightMask lights) {
  std::string text = R"(
LookAt 0 -3.4 0.1  0 0 -0.1  0 0 1
Camera "perspective" "float fov" [45]
Film "fleximage" "integer xresolution" [128] "integer yresolution" [64]
PixelFilter "box"
Sampler "lowdiscrepancy"
SurfaceIntegrator "path" "integer maxdepth" [8]
WorldBegin
)";
  const auto has = [&](LightKind kind) { return (lights >> uint32_t(kind) & 1u) != 0; };
  if (has(LightKind::kPoint))
    text += "LightSource \"point\" \"color L\" [2 2 2] \"point from\" [0.5 -0.8 0.7]\n";
  if (has(LightKind::kDistant))
    text +=
        "LightSource \"distant\" \"color L\" [1 1 1] \"point from\" [0 -1 1] \"point to\" [0 0 "
        "0]\n";
  if (has(LightKind::kSky))
    text += "LightSource \"sunsky\" \"vector sundir\" [0 -1 1] \"float gain\" [.0001]\n";
  if (has(LightKind::kTriangle))
    text += R"(AttributeBegin
AreaLightSource "area" "color L" [8 8 8]
Shape "trianglemesh" "integer indices" [0 2 1 0 3 2]
  "point P" [-0.3 -0.3 0.98  0.3 -0.3 0.98  0.4 0.3 0.98  -0.2 0.3 0.98]
AttributeEnd
)";
  if (has(LightKind::kRectangle))
    text += R"(AttributeBegin
AreaLightSource "area" "color L" [8 8 8]
Shape "trianglemesh" "integer indices" [0 2 1 0 3 2]
  "point P" [-0.3 0.32 0.98  0.3 0.32 0.98  0.3 0.92 0.98  -0.3 0.92 0.98]
AttributeEnd
)";
  if (has(LightKind::kSphere))
    text += R"(AttributeBegin
AreaLightSource "area" "color L" [8 8 8]
Translate -0.6 -0.4 0.7
Shape "sphere" "float radius" [0.1]
AttributeEnd
)";
  // Five walls of matte and rough matte, the front open. The rough ones have bent normals: those
  // that agree with the faces would be left out.
  text += R"(
MakeNamedMaterial "wall" "string type" ["matte"] "color Kd" [0.7 0.7 0.7]
MakeNamedMaterial "rough" "string type" ["matte"] "color Kd" [0.6 0.3 0.2] "float sigma" [25]
MakeNamedMaterial "mirror" "string type" ["mirror"] "color Kr" [0.9 0.9 0.9]
MakeNamedMaterial "glass" "string type" ["glass"] "float index" [1.5]
MakeNamedMaterial "null" "string type" ["null"]
NamedMaterial "wall"
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3  4 6 5 4 7 6  3 2 6 3 6 7]
  "point P" [-1 -1 -1  1 -1 -1  1 1 -1  -1 1 -1  -1 -1 1  1 -1 1  1 1 1  -1 1 1]
NamedMaterial "rough"
Shape "trianglemesh" "integer indices" [0 2 1 0 3 2  4 5 6 4 6 7]
  "point P" [-1 -1 -1  -1 -1 1  -1 1 1  -1 1 -1  1 -1 -1  1 -1 1  1 1 1  1 1 -1]
  "normal N" [1 .1 .1  1 .1 -.1  1 -.1 -.1  1 -.1 .1  -1 .1 .1  -1 .1 -.1  -1 -.1 -.1  -1 -.1 .1]
)";
  constexpr const char* kMaterials[] = {"wall", "rough", "mirror", "glass", "null"};
  // A see-through sphere that does not shine is left out of a scene: this one does.
  for (int i = 0; i < 5; ++i) {
    const bool shines = i == 4 && has(LightKind::kSphere);
    text += fmt::format(
        "AttributeBegin\nNamedMaterial \"{}\"\n{}Translate {} {} -0.6\n"
        "Shape \"sphere\" \"float radius\" [0.25]\nAttributeEnd\n",
        kMaterials[i], shines ? "AreaLightSource \"area\" \"color L\" [1 1 1]\n" : "",
        -0.8 + 0.4 * i, i % 2 ? 0.3 : -0.3);
  }
  // One smaller sphere of every other material.
  constexpr const char* kMore[] = {
      "\"metal\" \"string name\" [\"gold\"]",
      "\"metal2\" \"float fresnel\" [2]",
      "\"metal2\" \"color fresnel\" [.9 .6 .3]",
      "\"shinymetal\" \"color Ks\" [.5 .5 .5]",
      "\"roughglass\" \"float uroughness\" [.2] \"float vroughness\" [.2]",
      "\"mirror\" \"float film\" [300]",
      "\"glass\" \"float film\" [300]",
      "\"glass\" \"bool architectural\" [\"true\"]",
      "\"mattetranslucent\" \"color Kr\" [.5 .4 .3] \"color Kt\" [.3 .4 .5] \"float sigma\" [10]",
      "\"velvet\"",
      "\"scatter\" \"color g\" [.3 .3 .3]",
      "\"glossy\" \"color Ks\" [.1 .1 .1]",
      "\"glossy\" \"color Ks\" [.1 .1 .1] \"bool separable\" [\"false\"]",
      "\"glossy_lossy\" \"color Ks\" [.1 .1 .1]",
      "\"glossytranslucent\" \"color Ks\" [.1 .1 .1]",
      "\"carpaint\"",
  };
  for (size_t i = 0; i < std::size(kMore); ++i)
    text += fmt::format(
        "AttributeBegin\nMaterial {}\nTranslate {} 0.1 {}\n"
        "Shape \"sphere\" \"float radius\" [0.1]\nAttributeEnd\n",
        kMore[i], -0.84 + 0.24 * double(i % 8), -0.15 + 0.3 * double(i / 8));
  for (const char* shape : {"\"cylinder\" \"float radius\" [.5]", "\"disk\"", "\"torus\""}) {
    const int place = shape[1] == 'c' ? -1 : shape[1] == 'd' ? 0 : 1;
    text += fmt::format(
        "AttributeBegin\nNamedMaterial \"wall\"\nTranslate {} 0.6 0.1\nRotate 60 1 0 0\n"
        "Scale .2 .2 .2\nShape {}\nAttributeEnd\n",
        .6 * place, shape);
  }
  // Small triangles, so that the tree has depth: a grid of tents on the floor.
  std::string points, indices;
  constexpr int kTents = 40;
  for (int y = 0; y < kTents; ++y)
    for (int x = 0; x < kTents; ++x) {
      const double step = 2. / kTents, x0 = -1 + x * step, y0 = -1 + y * step;
      const int first = (y * kTents + x) * 4;
      points += fmt::format(
          "{:.4f} {:.4f} -0.99 {:.4f} {:.4f} -0.99 {:.4f} {:.4f} -0.99 {:.4f} {:.4f} -0.95\n", x0,
          y0, x0 + step, y0, x0 + step / 2, y0 + step, x0 + step / 2, y0 + step / 2);
      indices += fmt::format("{} {} {} {} {} {} {} {} {}\n", first, first + 1, first + 3, first + 1,
                             first + 2, first + 3, first + 2, first, first + 3);
    }
  text += fmt::format(
      "NamedMaterial \"wall\"\nShape \"trianglemesh\" \"integer indices\" [{}] \"point P\" [{}]\n"
      "AttributeBegin\nTranslate 0 0 -1.2\nShape \"plane\"\nAttributeEnd\nWorldEnd\n",
      indices, points);
  return text;
}

namespace {

/// A ball of radius 1 with waves on it, as rings of triangles.
std::string ball_text(int rings, int segments, bool normals) {
  std::string points, directions, indices;
  for (int j = 0; j <= rings; ++j)
    for (int i = 0; i < segments; ++i) {
      const double theta = std::numbers::pi * j / rings, phi = 2 * std::numbers::pi * i / segments;
      const double x = std::sin(theta) * std::cos(phi), y = std::sin(theta) * std::sin(phi),
                   z = std::cos(theta);
      const double r = 1 + 0.05 * std::sin(3 * phi) * std::sin(5 * theta) * std::sin(theta);
      points += fmt::format("{:.5f} {:.5f} {:.5f} ", r * x, r * y, r * z);
      directions += fmt::format("{:.5f} {:.5f} {:.5f} ", x, y, z);
    }
  for (int j = 0; j < rings; ++j)
    for (int i = 0; i < segments; ++i) {
      const int a = j * segments + i, b = j * segments + (i + 1) % segments;
      if (j > 0) indices += fmt::format("{} {} {} ", a, b + segments, b);
      if (j + 1 < rings) indices += fmt::format("{} {} {} ", a, a + segments, b + segments);
    }
  return "Shape \"mesh\" \"integer triindices\" [" + indices + "] \"point P\" [" + points + "]" +
         (normals ? " \"normal N\" [" + directions + "]\n" : "\n");
}

}  // namespace

std::string instances_text() {
  std::string text = R"(
LookAt 0 -3.4 0.1  0 0 -0.1  0 0 1
Camera "perspective" "float fov" [45]
Film "fleximage" "integer xresolution" [128] "integer yresolution" [64]
PixelFilter "box"
Sampler "lowdiscrepancy"
SurfaceIntegrator "path" "integer maxdepth" [8]
WorldBegin
AttributeBegin
AreaLightSource "area" "color L" [8 8 8]
Shape "trianglemesh" "integer indices" [0 2 1 0 3 2]
  "point P" [-0.3 -0.3 0.98  0.3 -0.3 0.98  0.3 0.3 0.98  -0.3 0.3 0.98]
AttributeEnd
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3  4 6 5 4 7 6  3 2 6 3 6 7  0 3 7 0 7 4  1 5 6 1 6 2]
  "point P" [-1 -1 -1  1 -1 -1  1 1 -1  -1 1 -1  -1 -1 1  1 -1 1  1 1 1  -1 1 1]
)";
  text += "ObjectBegin \"flat\"\n" + ball_text(11, 11, false) + "ObjectEnd\n";
  text += "ObjectBegin \"smooth\"\n" + ball_text(23, 23, true) + "ObjectEnd\n";
  int i = 0;
  for (const double z : {-0.8, -0.3, 0.3})
    for (int y = 0; y < 12; ++y)
      for (int x = 0; x < 12; ++x, ++i)
        text += fmt::format(
            "AttributeBegin\nTranslate {:.4f} {:.4f} {:.4f}\nRotate {} 1 2 3\nScale .05 .07 .06\n"
            "ObjectInstance \"{}\"\nAttributeEnd\n",
            (x - 5.5) / 6.5, (y - 5.5) / 6.5, z, i * 37 % 360, i % 2 ? "smooth" : "flat");
  return text + "WorldEnd\n";
}

namespace {

bool draw(const KernelInputs& in, Dimension dimension, const PathState<ConstColumn>& paths,
          float* first, float* second, uint32_t n) {
  const auto kernel = in.kernels->draw[uint32_t(SamplerKind::kSobol)];
  if (!kernel) return false;
  kernel(0, dimension, paths.pixel, paths.sample, paths.depth, first, second, n);
  return true;
}

void record_camera(KernelInputs& in) {
  const uint32_t width = in.scene.film.width, height = in.scene.film.height;
  in.camera_samples.resize(kRows);
  in.camera_rays.resize(kRows);
  in.camera_paths.resize(kRows);
  in.camera_hits.resize(kRows);
  in.bounce_rays.resize(kRows * 2);
  in.shadow_rays.resize(kRows * 2);
  for (auto* column : {&in.film_u, &in.film_v, &in.lens_u, &in.lens_v}) column->resize(kRows);
  in.bin.resize(kRows);
  in.instance.resize(kRows);
  in.occluded.resize(kRows * 2);
  for (uint32_t i = 0; i < kRows; ++i)
    in.camera_samples.set(i, {(i / width % height) << 16 | i % width, i / (width * height), i});
  const CameraSample<ConstColumn> samples = in.camera_samples.view();
  const auto kernel = in.kernels->draw[uint32_t(SamplerKind::kSobol)];
  const auto generate = in.kernels->generate_camera_rays[0];
  if (!kernel || !generate) return;
  kernel(0, Dimension::kFilm, samples.pixel, samples.sample, nullptr, in.film_u.data(),
         in.film_v.data(), kRows);
  kernel(0, Dimension::kLens, samples.pixel, samples.sample, nullptr, in.lens_u.data(),
         in.lens_v.data(), kRows);
  generate(in.view, samples, in.film_u.data(), in.film_v.data(), nullptr, nullptr,
           in.camera_rays.columns(), in.camera_paths.columns(), kRows);
  in.camera_count = kRows;
}

bool record_hits(KernelInputs& in) {
  const KernelTable& k = *in.kernels;
  if (in.camera_count == 0 || !k.intersect_closest || !k.intersect_spheres || !k.intersect_planes ||
      !k.classify_hits)
    return false;
  const Ray<ConstColumn> rays = in.camera_rays.view();
  const GeometryView& geometry = in.view.geometry;
  k.intersect_closest(geometry.tree, rays, in.camera_hits.columns(), kRows, scratch_for(in));
  k.intersect_spheres(geometry.spheres, geometry.triangles.count, rays, in.camera_hits.columns(),
                      kRows);
  k.intersect_planes(geometry.planes, geometry.triangles.count + geometry.spheres.count, rays,
                     in.camera_hits.columns(), kRows);
  for (uint32_t kind = 0; kind < kShapeKinds; ++kind)
    k.intersect_shapes[kind](
        geometry.shapes, geometry.triangles.count + geometry.spheres.count + geometry.planes.count,
        rays, in.camera_hits.columns(), kRows);
  const uint32_t* const depth = in.camera_paths.view().depth;
  if (in.plan.instances) {
    if (!k.intersect_instances || !k.classify_instance_hits) return false;
    k.intersect_instances(in.view.instances, rays, in.camera_hits.columns(), in.instance.data(),
                          kRows, scratch_for(in));
    k.classify_instance_hits(in.view.instances, geometry.prim_bin, in.plan.first_lasting_bin,
                             in.plan.transport.max_depth, in.camera_hits.view(), in.instance.data(),
                             depth, in.bin.data(), kRows);
  } else {
    k.classify_hits(geometry.prim_bin, in.plan.first_lasting_bin, in.plan.transport.max_depth,
                    in.camera_hits.view(), depth, in.bin.data(), kRows);
  }
  return true;
}

/// Surfaces, random numbers, light samples of one bin, filled up to kRows by repeating its rows.
bool record_bin(KernelInputs& in, uint32_t bin) {
  ShadingRows rows;
  rows.bin = in.scene.bins[bin];
  rows.sample_lights = in.plan.bins[bin].sample_lights;
  rows.order.resize(kRows);
  for (uint32_t i = 0; i < kRows; ++i)
    if (in.bin[i] == bin) rows.order[rows.count++] = i;
  if (rows.count == 0) return false;
  const uint32_t found = rows.count;
  for (; rows.count < kRows; ++rows.count) rows.order[rows.count] = rows.order[rows.count % found];
  rows.surfaces.resize(kRows);
  rows.paths.resize(kRows);
  rows.randoms.resize(kRows);
  rows.lights.resize(kRows);
  if (rows.bin.instanced) {
    const auto make_surfaces =
        in.kernels->make_instance_surfaces[rows.bin.geometry == GeometryKind::kTriangleVertex];
    if (!make_surfaces) return false;
    make_surfaces(in.view, rows.order.data(), in.camera_rays.view(), in.camera_hits.view(),
                  in.instance.data(), in.camera_paths.view(), rows.surfaces.columns(),
                  rows.paths.columns(), kRows);
  } else {
    const auto make_surfaces = in.kernels->make_surfaces[uint32_t(rows.bin.geometry)];
    if (!make_surfaces) return false;
    make_surfaces(in.view, rows.order.data(), in.camera_rays.view(), in.camera_hits.view(),
                  in.camera_paths.view(), rows.surfaces.columns(), rows.paths.columns(), kRows);
  }
  // A repeated row is another sample, and every row has its own slot.
  for (uint32_t i = 0; i < kRows; ++i) {
    rows.paths.columns().sample[i] = i / found;
    rows.paths.columns().slot[i] = i;
  }
  const Randoms<Column>& randoms = rows.randoms.columns();
  const PathState<ConstColumn> paths = rows.paths.view();
  draw(in, Dimension::kLight, paths, randoms.light_u, randoms.light_v, kRows);
  draw(in, Dimension::kChoice, paths, randoms.light_choice, randoms.lobe, kRows);
  draw(in, Dimension::kBsdf, paths, randoms.bsdf_u, randoms.bsdf_v, kRows);
  draw(in, Dimension::kRoulette, paths, randoms.roulette, nullptr, kRows);
  if (rows.sample_lights)
    if (const LightGroup& group = in.plan.light_groups[0]; !group.tree)
      in.kernels->sample_lights[group.kernel](in.view, rows.surfaces.view(), rows.randoms.view(),
                                              rows.lights.columns(), kRows);
  in.bins.push_back(std::move(rows));
  return true;
}

/// The rays that leave the surfaces, of all bins mixed as a turn would.
void record_next_rays(KernelInputs& in) {
  AlignedArray<uint32_t> finished(kRows);
  for (const ShadingRows& rows : in.bins) {
    const auto shade = in.kernels->shade[uint32_t(rows.bin.material)];
    if (!shade) continue;
    Table<Ray> rays(kRows);
    Table<PathState> paths(kRows);
    Table<ShadowRay> shadow(kRows);
    ShadeOutput output;
    output.rays = rays.columns();
    output.paths = paths.columns();
    output.shadow_rays = shadow.columns();
    output.finished = finished.data();
    ShadeInput input{rows.surfaces.view(), rows.paths.view(), rows.randoms.view(),
                     rows.lights.view(), in.view.parameters[uint32_t(rows.bin.material)]};
    if (!rows.sample_lights) input.lights = {};
    DropLog drops;
    const uint32_t share = kRows / uint32_t(in.bins.size());
    shade(input, in.plan.transport, output, drops, share);
    for (uint32_t i = 0; i < output.path_count; ++i)
      in.bounce_rays.set(in.bounce_count++, rays.row(i));
    for (uint32_t i = 0; i < output.shadow_count; ++i) {
      ShadowRay<Value> ray = shadow.row(i);
      ray.slot = in.shadow_count;
      in.shadow_rays.set(in.shadow_count++, ray);
    }
  }
}

std::unique_ptr<KernelInputs> record(const KernelTable& kernels, const std::string& text) {
  auto in = std::make_unique<KernelInputs>();
  in->kernels = &kernels;
  ThreadPool pool(1);
  Diagnostics diagnostics([](Severity severity, std::string_view line) {
    if (severity != Severity::kNote) std::fprintf(stderr, "%.*s\n", int(line.size()), line.data());
  });
  CompileOptions options;
  options.block_width = kernels.lanes;
  options.instances = InstanceMode::kShare;
  options.light_choice = LightChoosing::kPower;  // Rows of each kind of light.
  in->scene =
      compile_scene(parse_scene(text, "bench room", ".", diagnostics), options, pool, diagnostics);
  in->view = in->scene.view();
  in->plan = make_plan(in->scene, kernels, PlanOptions{});
  record_camera(*in);
  if (!record_hits(*in)) return in;
  for (uint32_t bin = 1; bin < in->scene.bins.size(); ++bin) record_bin(*in, bin);
  if (!in->bins.empty()) record_next_rays(*in);
  return in;
}

}  // namespace

const ShadingRows* KernelInputs::rows_of(MaterialKind material) const {
  const ShadingRows* emissive = nullptr;
  for (const ShadingRows& rows : bins) {
    if (rows.bin.material != material) continue;
    if (!rows.bin.emissive) return &rows;
    emissive = &rows;
  }
  return emissive;
}
const ShadingRows* KernelInputs::emissive_rows() const {
  for (const ShadingRows& rows : bins)
    if (rows.bin.emissive) return &rows;
  return nullptr;
}
const ShadingRows* KernelInputs::rows_of(GeometryKind geometry, bool instanced) const {
  for (const ShadingRows& rows : bins)
    if (rows.bin.geometry == geometry && rows.bin.instanced == instanced) return &rows;
  return nullptr;
}
const ShadingRows* KernelInputs::lit_rows() const {
  return rows_of(MaterialKind::kMatte);
}

const KernelInputs& inputs_for(const KernelTable& kernels, LightMask lights) {
  static std::map<std::pair<const KernelTable*, LightMask>, std::unique_ptr<KernelInputs>> known;
  auto& entry = known[{&kernels, lights}];
  if (!entry) entry = record(kernels, room_text(lights));
  return *entry;
}
const KernelInputs& instance_inputs_for(const KernelTable& kernels) {
  static std::map<const KernelTable*, std::unique_ptr<KernelInputs>> known;
  auto& entry = known[&kernels];
  if (!entry) entry = record(kernels, instances_text());
  return *entry;
}

AlignedArray<uint32_t> sparse_order(const ShadingRows& rows, uint32_t share, uint32_t& n) {
  AlignedArray<uint32_t> order(kRows);
  n = 0;
  for (uint32_t i = 0; i < kRows; ++i)
    if (is_active(i, share)) order[n++] = rows.order[i];
  return order;
}

Scratch scratch_for(const KernelInputs& inputs) {
  static AlignedArray<std::byte> memory;
  const KernelTable& k = *inputs.kernels;
  size_t bytes =
      k.traversal_scratch_bytes ? k.traversal_scratch_bytes(inputs.view.geometry.tree, kRows) : 0;
  if (inputs.plan.instances && k.instance_scratch_bytes)
    bytes = std::max(bytes, k.instance_scratch_bytes(inputs.view.instances, kRows));
  if (memory.size() < bytes) memory.resize(bytes);
  return {memory.data(), memory.size()};
}

}  // namespace yat::bench
