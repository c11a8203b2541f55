// Every material of the registry that is made of others, on every instruction set, as a whole: the
// formula, sampling against density, energy and reciprocity. Rows go the way of
// Worker::shade_split.
//
// Single directions (mirror, glass, null) have no density: they take no part in chi-square and f,
// but in the furnace; their own reciprocity is test_materials.cpp's.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "chi2.h"
#include "composite_cases.h"
#include "kernel_columns.h"
#include "kernels/rng_scalar.h"
#include "render_scenes.h"

namespace yat {
namespace {

constexpr double kPi = std::numbers::pi;

/// Rows of one material among others: what a chunk has on the way to its leaves.
struct PartRows {
  uint32_t n;
  Table<Surface> surfaces;
  Table<PathState> paths;
  Table<Coat> coats;
  bool coated = false;
  AlignedArray<float> u;       ///< what decides next
  std::vector<double> chance;  ///< with which the row came here
  explicit PartRows(uint32_t rows)
      : n(rows), surfaces(n), paths(n), coats(n), u(n), chance(n, 1.) {}
};

/// A material that is made of others.
class Whole {
 public:
  Whole(const Composite& composite, const KernelTable& kernels)
      : k_(kernels),
        scene_(compile_text("Camera \"perspective\"\nWorldBegin\nLightSource \"point\"\n" +
                                kCompositeParts + composite.text + "NamedMaterial \"m\"\n" +
                                quad_text("-1 -1 0", "1 -1 0", "1 1 0", "-1 1 0") + "WorldEnd\n",
                            kernels, ColourMode::kRgb)),
        view_(scene_.view()) {
    const Bin& bin = scene_.bins[scene_.prim_bin[0]];
    form_ = {bin.material, bin.split, bin.program};
    TriangleRow<Value> triangle = scene_.triangles.row(0);
    parameter_ = triangle.parameter;
  }
  MaterialKind kind() const { return form_.kind; }
  ParameterView parameters(MaterialKind kind) const { return view_.parameters[uint32_t(kind)]; }

  /// Rows at the origin, outside +z; slot i is row i.
  PartRows rows(const std::vector<glm::dvec3>& wo) const {
    PartRows out(uint32_t(wo.size()));
    for (uint32_t i = 0; i < out.n; ++i) {
      Surface<Value> s{};
      s.ng_z = s.ns_z = s.distance = 1;
      s.wo_x = float(wo[i].x), s.wo_y = float(wo[i].y), s.wo_z = float(wo[i].z);
      s.parameter = parameter_;
      s.light = kNone;
      out.surfaces.set(i, s);
      PathState<Value> p{};
      p.throughput_r = p.throughput_g = p.throughput_b = 1;
      p.slot = i;
      out.paths.set(i, p);
    }
    return out;
  }
  /// visit(kind, rows, turned) for every leaf. everywhere: all rows that may come there, with their
  /// chance; else those that their numbers take there.
  template <class Visit>
  void part(const PartRows& rows, bool everywhere, Visit&& visit) const {
    part(form_, rows, everywhere, false, visit);
  }

 private:
  template <class Visit>
  void part(const MaterialForm& form, const PartRows& rows, bool everywhere, bool turned,
            Visit& visit) const {
    if (!material_traits(form.kind).splits) return visit(form.kind, rows, turned);
    const bool coating = form.kind == MaterialKind::kCoating;
    const uint32_t n = rows.n;
    AlignedArray<float> share(n), weighted(n), left(n);
    AlignedArray<uint32_t> child(n), first(n), second(n), order(n);
    const ParameterView view = parameters(form.kind);
    k_.split[uint32_t(form.kind)](view, rows.surfaces.view(), false, share.data(), first.data(),
                                  second.data(), n);
    const MaterialSplit& split = scene_.splits[form.split];
    if (split.unequal) k_.chances(view, rows.surfaces.view(), share.data(), weighted.data(), n);
    const float* chances = split.unequal ? weighted.data() : share.data();
    k_.choose_child(chances, rows.u.data(), child.data(), left.data(), n);
    Table<Coat> own(n);
    if (coating) k_.coats(view, rows.surfaces.view(), own.columns(), n);
    for (uint32_t c = 0; c < 2; ++c) {
      std::vector<double> chance;
      for (uint32_t i = 0; i < n; ++i) {
        const double here = double(c ? chances[i] : 1 - chances[i]);
        if (everywhere ? here == 0 : child[i] != c) continue;
        order[uint32_t(chance.size())] = i;
        chance.push_back(rows.chance[i] * here);
      }
      PartRows next(uint32_t(chance.size()));
      if (!next.n) continue;
      next.chance = chance;
      Surface<ConstColumn> from = rows.surfaces.view();
      from.parameter = c ? second.data() : first.data();
      k_.take_rows(from, rows.paths.view(), left.data(), order.data(), split.turned[c],
                   next.surfaces.columns(), next.paths.columns(), next.u.data(), next.n);
      if (coating || split.unequal)
        k_.weigh_child(coating ? nullptr : share.data(), chances, order.data(), c,
                       next.paths.columns(), next.n);
      next.coated = rows.coated || (coating && c);
      if (next.coated)
        k_.take_coats(coating && c ? own.view() : rows.coats.view(), order.data(),
                      next.coats.columns(), next.n);
      part(split.child[c], next, everywhere, turned != split.turned[c], visit);
    }
  }

  const KernelTable& k_;
  Scene scene_;
  SceneView view_;
  MaterialForm form_;
  uint32_t parameter_ = 0;
};

class Composites : public PerIsa {
 protected:
  /// visit(composite, whole) for every composite of every material that is made of others.
  template <class Visit>
  void for_every_composite(Visit&& visit) {
    // As templates, so that only materials that are made of others need a list.
    const auto of_kind = [&](MaterialKind kind, auto traits, auto parameters) {
      if constexpr (traits().splits) {
        const std::vector<Composite> all = composites(parameters);
        EXPECT_FALSE(all.empty());
        for (const Composite& c : all) {
          SCOPED_TRACE(std::string(traits().name) + ", " + c.name);
          const Whole whole(c, kernels());
          ASSERT_EQ(whole.kind(), kind);
          visit(c, whole);
        }
      }
    };
#define YAT_MATERIAL(file, Type) \
  of_kind(MaterialKind::k##Type, [] { return k##Type##Traits; }, Type##Parameters<Value>{});
    YAT_MATERIALS(YAT_MATERIAL)
#undef YAT_MATERIAL
  }

  /// The shade kernel's outputs for a leaf's rows.
  struct Shaded {
    Table<Ray> rays;
    Table<PathState> paths;
    Table<ShadowRay> shadow;
    AlignedArray<uint32_t> finished;
    ShadeOutput out;
    explicit Shaded(uint32_t n) : rays(n), paths(n), shadow(n), finished(n) {
      out.rays = rays.columns();
      out.paths = paths.columns();
      out.shadow_rays = shadow.columns();
      out.finished = finished.data();
    }
  };
  Shaded shade(const Whole& whole, MaterialKind kind, const PartRows& rows,
               const Randoms<ConstColumn>& randoms, const LightSample<ConstColumn>& lights) {
    Shaded made(rows.n);
    ShadeInput in{rows.surfaces.view(), rows.paths.view(), randoms, lights, whole.parameters(kind)};
    if (rows.coated) in.coats = rows.coats.view();
    DropLog drops;
    kernels().shade[uint32_t(kind)](in, {}, made.out, drops, rows.n);
    for (const uint64_t dropped : drops.count) EXPECT_EQ(dropped, 0u);
    return made;
  }

  /// f by both children of every split, each with its chance.
  std::vector<glm::dvec3> evaluate(const Whole& whole, const std::vector<glm::dvec3>& wo,
                                   const std::vector<glm::dvec3>& wi) {
    std::vector<glm::dvec3> f(wo.size(), glm::dvec3(0));
    whole.part(whole.rows(wo), true, [&](MaterialKind kind, const PartRows& rows, bool) {
      Table<Randoms> randoms(rows.n);
      Table<LightSample> lights(rows.n);
      for (uint32_t i = 0; i < rows.n; ++i) {
        const glm::dvec3& w = wi[rows.paths.view().slot[i]];
        LightSample<Value> light{};
        light.wi_x = float(w.x), light.wi_y = float(w.y), light.wi_z = float(w.z);
        light.to_x = light.wi_x, light.to_y = light.wi_y, light.to_z = light.wi_z;
        light.weight_r = light.weight_g = light.weight_b = 1;
        lights.set(i, light);
        randoms.set(i, {});
      }
      Randoms<ConstColumn> drawn = randoms.view();
      drawn.roulette = nullptr;
      const Shaded made = shade(whole, kind, rows, drawn, lights.view());
      std::vector<double> chance(wo.size());
      for (uint32_t i = 0; i < rows.n; ++i) chance[rows.paths.view().slot[i]] = rows.chance[i];
      for (uint32_t i = 0; i < made.out.shadow_count; ++i) {
        const ShadowRay<Value> ray = made.shadow.row(i);
        const double cos = std::abs(double(float(wi[ray.slot].z)));
        f[ray.slot] += glm::dvec3(ray.add_r, ray.add_g, ray.add_b) * (chance[ray.slot] / cos);
      }
    });
    return f;
  }

  /// A direction for every row; weight 0 where nothing was chosen.
  struct Chosen {
    glm::dvec3 wi{0.0}, weight{0.0};
    double pdf = 0;
  };
  std::vector<Chosen> sample(const Whole& whole, const glm::dvec3& wo, uint32_t n, uint32_t seed) {
    PartRows all = whole.rows(std::vector<glm::dvec3>(n, wo));
    Table<Randoms> numbers(n);
    for (uint32_t i = 0; i < n; ++i) {
      const auto draw = [&](Dimension dimension) {
        return random_pair(SamplerKind::kIndependent, seed, dimension, 1, i, 0);
      };
      Randoms<Value> r{};
      all.u[i] = draw(Dimension::kChild).first;
      r.lobe = draw(Dimension::kChoice).second;
      std::tie(r.bsdf_u, r.bsdf_v) = draw(Dimension::kBsdf);
      numbers.set(i, r);
    }
    std::vector<Chosen> chosen(n);
    whole.part(all, false, [&](MaterialKind kind, const PartRows& rows, bool) {
      Table<Randoms> own(rows.n);
      for (uint32_t i = 0; i < rows.n; ++i) own.set(i, numbers.row(rows.paths.view().slot[i]));
      Randoms<ConstColumn> drawn = own.view();
      drawn.roulette = nullptr;
      const Shaded made = shade(whole, kind, rows, drawn, {});
      for (uint32_t i = 0; i < made.out.path_count; ++i) {
        const Ray<Value> ray = made.rays.row(i);
        const PathState<Value> path = made.paths.row(i);
        chosen[path.slot] = {{ray.dir_x, ray.dir_y, ray.dir_z},
                             {path.throughput_r, path.throughput_g, path.throughput_b},
                             double(path.pdf)};
      }
    });
    return chosen;
  }
};
YAT_INSTANTIATE_PER_ISA(Composites);

TEST_P(Composites, EvaluateIsTheFormula) {
  Random random(1);
  std::vector<glm::dvec3> wo, wi;
  for (int i = 0; i < 4000; ++i) {
    wo.push_back(rounded(random.direction()));
    wi.push_back(rounded(random.direction()));
  }
  for_every_composite([&](const Composite& c, const Whole& whole) {
    const std::vector<glm::dvec3> found = evaluate(whole, wo, wi);
    for (uint32_t i = 0; i < wo.size(); ++i) {
      const glm::dvec3 turn(1, 1, wo[i].z > 0 ? 1 : -1);
      const glm::dvec3 f = c.seen_from(turn.z)(wo[i] * turn, wi[i] * turn);
      const double near_horizon = 1e-6 / std::abs(wi[i].z * wo[i].z);
      expect_near(found[i], f, (5e-5 + near_horizon) * glm::length(f) + 2e-6, "f", i);
    }
  });
}

TEST_P(Composites, ScatteringIsReciprocal) {
  Random random(3);
  std::vector<glm::dvec3> a, b;
  for (int i = 0; i < 4000; ++i) {
    a.push_back(rounded(random.direction()));
    b.push_back(i % 8 ? rounded(random.direction()) : a.back());
  }
  for_every_composite([&](const Composite&, const Whole& whole) {
    const std::vector<glm::dvec3> there = evaluate(whole, a, b), back = evaluate(whole, b, a);
    for (uint32_t i = 0; i < a.size(); ++i)
      expect_near(there[i], back[i], 1e-4 * glm::length(back[i]) + 2e-6, "f reversed", i);
  });
}

// The part is chosen by its share, then the direction by the part's density: directions come as the
// sum of shares times densities, and each row's own pdf, which its MIS weights go by, is the
// part's.
TEST_P(Composites, SamplesFollowTheSumOfTheirPartsDensities) {
  constexpr int kRows = 21, kColumns = 40, kSide = 8;
  constexpr uint32_t n = 1 << 15;
  // Points of a grid, dense around the poles; their solid angles.
  std::vector<glm::dvec3> points;
  std::vector<double> area;
  for (int y = 0; y < kRows * kSide; ++y) {
    const int row = y / kSide;
    const double height = 2. / kRows, s = (y % kSide + .5) / kSide;
    double z = (row + s) * height - 1, dz = height / kSide;
    if (row == 0) z = height * s * s - 1, dz *= 2 * s;
    if (row == kRows - 1) z = 1 - height * (1 - s) * (1 - s), dz *= 2 * (1 - s);
    for (int x = 0; x < kColumns * kSide; ++x) {
      points.push_back(rounded(at_cosine(z, (x + .5) / (kColumns * kSide) * 2 * kPi)));
      area.push_back(dz * 2 * kPi / (kColumns * kSide));
    }
  }
  const uint32_t m = uint32_t(points.size());
  size_t tests = 0;
  for_every_composite([&](const Composite&, const Whole&) { tests += 4; });
  for_every_composite([&](const Composite& c, const Whole& whole) {
    for (const double cos : {1., .6, .2, -.5}) {
      SCOPED_TRACE("cos " + std::to_string(cos));
      const glm::dvec3 wo = rounded(at_cosine(cos, 2));
      const std::vector<Chosen> chosen = sample(whole, wo, n, 4);
      std::vector<double> seen(kRows * kColumns), wanted(kRows * kColumns);
      double without = 0;  // single directions, and rows for which nothing was chosen
      for (const Chosen& row : chosen) {
        if (row.pdf == 0) {
          ++without;
          continue;
        }
        double turn = std::atan2(row.wi.y, row.wi.x) / (2 * kPi);
        if (turn < 0) turn += 1;
        const int y = std::clamp(int((row.wi.z + 1) / 2 * kRows), 0, kRows - 1);
        ++seen[size_t(y * kColumns + std::clamp(int(turn * kColumns), 0, kColumns - 1))];
      }
      // The densities of all parts over the grid.
      double integral = 0;
      whole.part(whole.rows({wo}), true, [&](MaterialKind kind, const PartRows& rows, bool turned) {
        const double side = turned ? -1 : 1;  // a part that is turned sees everything upside down
        std::array<AlignedArray<float>, 13> columns;
        for (auto& column : columns) column.resize(m);
        AlignedArray<uint32_t> parameter(m);
        for (uint32_t i = 0; i < m; ++i) {
          columns[0][i] = float(wo.x), columns[1][i] = float(wo.y);
          columns[2][i] = float(side * wo.z);
          columns[3][i] = float(points[i].x), columns[4][i] = float(points[i].y);
          columns[5][i] = float(side * points[i].z);
          parameter[i] = rows.surfaces.view().parameter[0];
        }
        const auto at = [&](size_t column) { return columns[column].data(); };
        kernels().bsdf_evaluate[uint32_t(kind)](
            whole.parameters(kind),
            {at(0), at(1), at(2), at(3), at(4), at(5), at(6), at(7), at(8), parameter.data(), at(9),
             at(10), at(11), at(12)},
            m);
        for (uint32_t i = 0; i < m; ++i) {
          const double part = rows.chance[0] * double(columns[12][i]) * area[i];
          integral += part;
          const uint32_t y = i / (kColumns * kSide * kSide), x = i / kSide % kColumns;
          wanted[y * kColumns + x] += part * n;
        }
      });
      const double share = without / n, chance = 4 * std::sqrt(share * (1 - share) / n);
      EXPECT_NEAR(integral + share, 1, 3e-3 + chance) << c.name;
      EXPECT_GE(chi2_p_value(seen, wanted), sidak_level(tests)) << c.name;
    }
  });
}

// The mean of what sampled rows bring is the formula's albedo, and no more than all.
TEST_P(Composites, FurnaceIsTheFormulasAndNeverBrighter) {
  constexpr uint32_t kRuns = 8, kRun = 4096;
  for_every_composite([&](const Composite& c, const Whole& whole) {
    for (const double cos : {1., .5, .15, -.4}) {
      const glm::dvec3 wo = rounded(at_cosine(cos, 1));
      const std::vector<Chosen> chosen = sample(whole, wo, kRuns * kRun, 7);
      // Radiance changes by n^2 where light is bent, energy does not.
      const double bent = cos > 0 ? c.index * c.index : 1 / (c.index * c.index);
      std::vector<glm::dvec3> means(kRuns, glm::dvec3(0));
      for (uint32_t i = 0; i < kRuns * kRun; ++i) {
        const bool through = chosen[i].pdf == 0 && chosen[i].wi.z * wo.z < 0;
        means[i / kRun] += chosen[i].weight * ((through ? bent : 1) / kRun);
      }
      glm::dvec3 albedo(0);
      for (const glm::dvec3& mean : means) albedo += mean / double(kRuns);
      double squares = 0;
      for (const glm::dvec3& mean : means) squares += glm::dot(mean - albedo, mean - albedo);
      const double error = std::sqrt(squares / (kRuns * (kRuns - 1)));
      // LuxRender's rough lobe itself brings more than all near the horizon (docs/decisions.md).
      if (std::abs(cos) >= .4) {
        EXPECT_LE(std::max({albedo.x, albedo.y, albedo.z}), 1 + 1e-6 + 3 * error) << "cos " << cos;
      }
      glm::dvec3 wanted(0);
      for (int i = -64; i < 64; ++i)
        for (int j = 0; j < 128; ++j) {
          const double s = (i + .5) / 64, z = std::copysign(1 - s * s, s);
          wanted += c.seen_from(cos)(at_cosine(std::abs(cos), 1),
                                     at_cosine(z, 1 + 2 * kPi * (j + .5) / 128)) *
                    (std::abs(z) * 2 * std::abs(s) / 64 * 2 * kPi / 128);
        }
      if (c.single) wanted += c.single(std::abs(cos), cos > 0);
      // 6 errors of 8 runs are met by chance once in a thousand; the seed is fixed.
      expect_near(albedo, wanted, 6 * error + 3e-3, "albedo", 0);
      EXPECT_LE(error, 8e-3) << "too noisy to say anything";
    }
  });
}

// The same by whole renders: a ball of the material in a room that shines evenly, seen by its
// middle, from outside and turned inside out. Paths go in and out of it as often as they like.
TEST_P(Composites, BallsInAFurnaceAreNeverBrighter) {
  for_every_composite([&](const Composite& c, const Whole&) {
    for (const std::string turn : {"", "ReverseOrientation\n"}) {
      // A bent ray sees the inside of an inverted ball of glass brighter by n^2.
      if (c.index != 1 && !turn.empty()) continue;
      const Scene scene = compile_text(
          view_text("0 -2 0", "0 0 0", 30, 8, 8) + kCompositeParts + c.text + "AttributeBegin\n" +
              light_text("1 1 1") + matte_text("0 0 0") + room_text(3) +
              "AttributeEnd\nNamedMaterial \"m\"\n" + turn + sphere_text("0 0 0", 1) + "WorldEnd\n",
          kernels(), ColourMode::kRgb);
      PlanOptions options;
      options.max_depth = 64;
      std::vector<double> means[3];
      for (options.seed = 0; options.seed < 8; ++options.seed) {
        const std::vector<float> rgb =
            render_film(scene, make_plan(scene, kernels(), options), 0, 32).resolve();
        glm::dvec3 sum(0.0);
        for (size_t i = 0; i < rgb.size(); ++i) sum[int(i % 3)] += double(rgb[i]) * 3;
        for (int k = 0; k < 3; ++k) means[k].push_back(sum[k] / double(rgb.size()));
      }
      for (const std::vector<double>& channel : means) {
        const Estimate e = estimate(channel);
        // 4 errors of 8 seeds: once in 200 by chance where the light is all there is; fixed seeds.
        EXPECT_LE(e.mean, 1 + 4 * e.error + 1e-5) << c.name << " " << turn;
        EXPECT_LE(e.error, .01) << "too noisy to say anything";
      }
    }
  });
}

}  // namespace
}  // namespace yat
