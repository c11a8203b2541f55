// Surfaces, emission, lights, materials, accumulation, film.

#include <array>
#include <bit>
#include <cmath>

#include "film/film.h"
#include "kernel_bench.h"
#include "kernel_inputs.h"

namespace yat::bench {

namespace {

constexpr std::array<const char*, kMaterialKinds> kMaterialNames = {
#define YAT_MATERIAL(file, Type) #file,
    YAT_MATERIALS(YAT_MATERIAL)
#undef YAT_MATERIAL
};
constexpr const char* kGeometryNames[] = {
    "triangle_flat", "triangle_vertex", "sphere", "plane", "quadric", "disk", "torus"};
static_assert(std::size(kGeometryNames) == uint32_t(GeometryKind::kCount));
constexpr const char* kLightNames[] = {"triangle",  "sphere", "point", "distant",
                                       "rectangle", "mixed",  "any"};
static_assert(std::size(kLightNames) == kLightKernels);

/// What a material is timed with: its rows in the room, or, where the room has none of it, matte's
/// rows with all of its parameters at 1/2.
struct MaterialInputs {
  const ShadingRows* rows;  ///< null: matte has none either
  ParameterView parameters;
  bool sample_lights;
  AlignedArray<uint32_t> words{};  ///< of made-up parameters

  MaterialInputs(const KernelInputs& in, MaterialKind kind)
      : rows(in.rows_of(kind)), parameters(in.view.parameters[uint32_t(kind)]) {
    sample_lights = !material_traits(kind).delta;
    if (rows) return;
    rows = in.lit_rows();
    words.resize(parameters_size(kind).row_words);
    for (uint32_t i = 0; i < words.size(); ++i) words[i] = std::bit_cast<uint32_t>(.5f);
    parameters = {words.data(), 1};
  }
};

void add_surfaces(const KernelTable& table) {
  for (uint32_t kind = 0; kind < uint32_t(GeometryKind::kCount); ++kind) {
    const std::string name = std::string("make_surfaces/") + kGeometryNames[kind];
    const auto kernel = table.make_surfaces[kind];
    if (!kernel) {
      add_missing(name, table);
      continue;
    }
    add_share_benchmarks(
        name, table, [&table, kernel, kind](benchmark::State& state, uint32_t share) {
          const KernelInputs& in = inputs_for(table, kAllLights);
          const ShadingRows* rows = in.rows_of(GeometryKind(kind));
          if (!rows) return no_rows(state);
          uint32_t n = 0;
          const AlignedArray<uint32_t> order = sparse_order(*rows, share, n);
          Table<Surface> surfaces(kRows);
          Table<PathState> paths(kRows);
          time_rows(state, n, [&] {
            kernel(in.view, order.data(), in.camera_rays.view(), in.camera_hits.view(),
                   in.camera_paths.view(), surfaces.columns(), paths.columns(), n);
          });
        });
  }
}

void add_emission_benchmark(const KernelTable& table) {
  const auto kernel = table.add_emission;
  if (!kernel) return add_missing("add_emission", table);
  add_benchmark("add_emission", table, [&table, kernel](benchmark::State& state) {
    const KernelInputs& in = inputs_for(table, kAllLights);
    const ShadingRows* rows = in.emissive_rows();
    if (!rows) return no_rows(state);
    Table<SampleSum> sums(kRows);
    DropLog drops;
    time_rows(state, kRows, [&] {
      kernel(in.view, rows->surfaces.view(), rows->paths.view(), sums.columns(), drops, kRows);
    });
  });
}

/// Rays that have scattered and all of which miss, under sun and sky.
void add_environment_benchmark(const KernelTable& table) {
  const auto kernel = table.add_environment;
  if (!kernel) return add_missing("add_environment", table);
  add_benchmark("add_environment", table, [&table, kernel](benchmark::State& state) {
    const KernelInputs& in = inputs_for(table, kAllLights | kSkyLights);
    const uint32_t n = in.bounce_count;
    if (!n) return no_rows(state);
    Table<Hit> hits(n);
    Table<PathState> paths(n);
    Table<SampleSum> sums(n);
    AlignedArray<uint32_t> order(n);
    for (uint32_t i = 0; i < n; ++i) {
      order[i] = i;
      Hit<Value> hit{};
      hit.prim = kNone;
      hits.set(i, hit);
      PathState<Value> path{};
      path.throughput_r = path.throughput_g = path.throughput_b = path.pdf = .5f;
      path.slot = i;
      paths.set(i, path);
    }
    DropLog drops;
    time_rows(state, n, [&] {
      kernel(in.view, order.data(), in.bounce_rays.view(), hits.view(), paths.view(),
             in.plan.transport, sums.columns(), drops, n);
    });
  });
}

void add_lights(const KernelTable& table) {
  for (uint32_t kind = 0; kind < kLightKernels; ++kind) {
    const std::string name = std::string("sample_lights/") + kLightNames[kind];
    const auto kernel = table.sample_lights[kind];
    if (!kernel) {
      add_missing(name, table);
      continue;
    }
    add_benchmark(name, table, [&table, kernel, kind](benchmark::State& state) {
      const LightMask mask = kind == kAnyLights     ? kAllLights | kSkyLights
                             : kind == kPlainLights ? kAllLights
                                                    : 1u << kind;
      const KernelInputs& in = inputs_for(table, mask);
      const ShadingRows* rows = in.lit_rows();
      if (!rows) return no_rows(state);
      Table<LightSample> lights(kRows);
      time_rows(state, kRows, [&] {
        kernel(in.view, rows->surfaces.view(), rows->randoms.view(), lights.columns(), kRows);
      });
    });
  }
}

/// Direct light alone, as where a surface asks several lights.
void add_connect(const KernelTable& table) {
  for (uint32_t kind = 0; kind < kMaterialKinds; ++kind) {
    const auto kernel = table.connect[kind];
    if (!kernel) continue;  // it has no use for light samples
    add_benchmark(
        std::string("connect/") + kMaterialNames[kind], table,
        [&table, kernel, kind](benchmark::State& state) {
          const KernelInputs& in = inputs_for(table, kAllLights);
          const MaterialInputs own(in, MaterialKind(kind));
          const ShadingRows* rows = own.rows;
          if (!rows) return no_rows(state);
          const ShadeInput input{
              rows->surfaces.view(), rows->paths.view(), {}, rows->lights.view(), own.parameters};
          Table<ShadowRay> shadow(kRows);
          ShadeOutput output;
          output.shadow_rays = shadow.columns();
          DropLog drops;
          time_rows(
              state, kRows, [&] { output.shadow_count = 0; },
              [&] { kernel(input, in.plan.transport, output, drops, kRows); });
        });
  }
}

void add_shade(const KernelTable& table) {
  for (uint32_t kind = 0; kind < kMaterialKinds; ++kind) {
    if (material_traits(MaterialKind(kind)).splits) continue;  // add_split
    const std::string name = std::string("shade/") + kMaterialNames[kind];
    const auto kernel = table.shade[kind];
    if (!kernel) {
      add_missing(name, table);
      continue;
    }
    // Active rows are those that the light reaches: the others write no shadow ray.
    add_share_benchmarks(
        name, table, [&table, kernel, kind](benchmark::State& state, uint32_t share) {
          const KernelInputs& in = inputs_for(table, kAllLights);
          const MaterialInputs own(in, MaterialKind(kind));
          const ShadingRows* rows = own.rows;
          if (!rows) return no_rows(state);
          Table<LightSample> lights(kRows);
          for (uint32_t i = 0; i < kRows; ++i) {
            LightSample<Value> light = rows->lights.row(i);
            if (!is_active(i, share)) light.weight_r = light.weight_g = light.weight_b = 0;
            lights.set(i, light);
          }
          ShadeInput input{rows->surfaces.view(), rows->paths.view(), rows->randoms.view(),
                           lights.view(), own.parameters};
          if (!own.sample_lights) input.lights = {};
          Table<Ray> rays(kRows);
          Table<PathState> paths(kRows);
          Table<ShadowRay> shadow(kRows);
          AlignedArray<uint32_t> finished(kRows);
          ShadeOutput output;
          output.rays = rays.columns();
          output.paths = paths.columns();
          output.shadow_rays = shadow.columns();
          output.finished = finished.data();
          DropLog drops;
          time_rows(
              state, kRows,
              [&] { output.path_count = output.shadow_count = output.finished_count = 0; },
              [&] { kernel(input, in.plan.transport, output, drops, kRows); });
        });
  }
}

/// Materials made of others: matte's rows on their way to both children, which are shaded as what
/// they are.
void add_split(const KernelTable& table) {
  for (uint32_t kind = 0; kind < kMaterialKinds; ++kind) {
    if (!material_traits(MaterialKind(kind)).splits) continue;
    const std::string name = std::string("split/") + kMaterialNames[kind];
    if (!table.split[kind]) {
      add_missing(name, table);
      continue;
    }
    add_benchmark(name, table, [&table, kind](benchmark::State& state) {
      const KernelInputs& in = inputs_for(table, kAllLights);
      const MaterialInputs own(in, MaterialKind(kind));
      if (!own.rows) return no_rows(state);
      const Surface<ConstColumn> surfaces = own.rows->surfaces.view();
      const PathState<ConstColumn> paths = own.rows->paths.view();
      AlignedArray<float> share(kRows), left(kRows), u(kRows);
      AlignedArray<uint32_t> first(kRows), second(kRows), child(kRows), order[2];
      for (AlignedArray<uint32_t>& rows : order) rows.resize(kRows);
      Table<Surface> surfaces_out(kRows);
      Table<PathState> paths_out(kRows);
      Table<Coat> coats(kRows), coats_out(kRows);
      const bool coating = MaterialKind(kind) == MaterialKind::kCoating;
      // A mixture whose children are unlike, which is the dearer way.
      const bool mixture = MaterialKind(kind) == MaterialKind::kMix;
      AlignedArray<float> chance(kRows);
      time_rows(state, kRows, [&] {
        table.split[kind](own.parameters, surfaces, false, share.data(), first.data(),
                          second.data(), kRows);
        if (mixture) table.chances(own.parameters, surfaces, share.data(), chance.data(), kRows);
        const float* const chosen_by = mixture ? chance.data() : share.data();
        table.choose_child(chosen_by, own.rows->randoms.view().lobe, child.data(), left.data(),
                           kRows);
        if (coating) table.coats(own.parameters, surfaces, coats.columns(), kRows);
        uint32_t taken[2] = {};
        for (uint32_t i = 0; i < kRows; ++i) {
          const uint32_t c = child[i];
          order[c][taken[c]++] = i;
        }
        for (uint32_t c = 0; c < 2; ++c) {
          table.take_rows(surfaces, paths, left.data(), order[c].data(), false,
                          surfaces_out.columns(), paths_out.columns(), u.data(), taken[c]);
          if (coating || mixture)
            table.weigh_child(mixture ? share.data() : nullptr, chosen_by, order[c].data(), c,
                              paths_out.columns(), taken[c]);
          if (coating && c)
            table.take_coats(coats.view(), order[c].data(), coats_out.columns(), taken[c]);
        }
      });
    });
  }
}

void add_accumulate(const KernelTable& table) {
  const auto kernel = table.add_unoccluded;
  if (!kernel) return add_missing("add_unoccluded", table);
  add_share_benchmarks(
      "add_unoccluded", table, [&table, kernel](benchmark::State& state, uint32_t share) {
        const KernelInputs& in = inputs_for(table, kAllLights);
        const uint32_t n = std::min(in.shadow_count, kRows);
        if (!n) return no_rows(state);
        AlignedArray<uint32_t> occluded(n);
        for (uint32_t i = 0; i < n; ++i) occluded[i] = is_active(i, share) ? 0 : 1;
        Table<SampleSum> sums(kRows * 2);
        time_rows(state, n,
                  [&] { kernel(in.shadow_rays.view(), occluded.data(), sums.columns(), n); });
      });
}

/// Unit vectors and random numbers for BSDF calls; row 0 of the parameters for all.
struct BsdfRows {
  std::array<AlignedArray<float>, 13> columns;
  AlignedArray<uint32_t> parameter{kRows};
  KernelTable::BsdfBatch batch{};

  explicit BsdfRows(const ShadingRows& rows) {
    for (auto& column : columns) column.resize(kRows);
    for (uint32_t i = 0; i < kRows; ++i) {
      const Randoms<Value> random = rows.randoms.row(i);
      set_direction(i, 0, random.light_u, random.light_v);
      set_direction(i, 3, random.bsdf_u, random.bsdf_v);
      columns[6][i] = random.lobe;
      columns[7][i] = random.bsdf_v;
      columns[8][i] = random.light_u;
    }
    const auto at = [this](size_t i) { return columns[i].data(); };
    batch = {at(0), at(1),  at(2),  at(3), at(4), at(5), at(6), at(7), at(8), parameter.data(),
             at(9), at(10), at(11), at(12)};
  }

 private:
  /// Uniform over the upper hemisphere.
  void set_direction(uint32_t row, size_t column, float u, float v) {
    const double z = double(u), r = std::sqrt(std::max(0., 1 - z * z)),
                 phi = 6.283185307179586 * double(v);
    columns[column][row] = float(r * std::cos(phi));
    columns[column + 1][row] = float(r * std::sin(phi));
    columns[column + 2][row] = float(z);
  }
};

}  // namespace

void add_shading_benchmarks(const KernelTable& table) {
  add_surfaces(table);
  add_emission_benchmark(table);
  add_environment_benchmark(table);
  add_lights(table);
  add_connect(table);
  add_shade(table);
  add_split(table);
  add_accumulate(table);
}

void add_bsdf_benchmarks(const KernelTable& table) {
  for (const bool sample : {false, true})
    for (uint32_t kind = 0; kind < kMaterialKinds; ++kind) {
      if (material_traits(MaterialKind(kind)).splits) continue;
      const std::string name =
          std::string(sample ? "bsdf_sample/" : "bsdf_evaluate/") + kMaterialNames[kind];
      const auto kernel = sample ? table.bsdf_sample[kind] : table.bsdf_evaluate[kind];
      if (!kernel) {
        add_missing(name, table);
        continue;
      }
      add_benchmark(name, table, [&table, kernel, kind](benchmark::State& state) {
        const KernelInputs& in = inputs_for(table, kAllLights);
        const MaterialInputs own(in, MaterialKind(kind));
        if (!own.rows) return no_rows(state);
        const BsdfRows columns(*in.lit_rows());
        time_rows(state, kRows, [&] { kernel(own.parameters, columns.batch, kRows); });
      });
    }
}

void add_film_benchmarks() {
  benchmark::RegisterBenchmark("film_add", [](benchmark::State& state) {
    constexpr uint32_t kSide = 64;
    Film film(kSide, kSide);
    std::vector<float> values(kRows);
    for (uint32_t i = 0; i < kRows; ++i) values[i] = float(i % 977) * 1e-3f;
    time_rows(state, kRows, [&] {
      FilmPixel* pixels = film.data();
      for (uint32_t i = 0; i < kRows; ++i) {
        FilmPixel& pixel = pixels[i % (kSide * kSide)];
        const Fixed value = to_fixed(values[i]);
        pixel.r += value;
        pixel.g += value;
        pixel.b += value;
        ++pixel.samples;
      }
    });
  })->UseManualTime();
}

}  // namespace yat::bench
