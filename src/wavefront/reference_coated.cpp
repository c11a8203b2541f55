// Coated materials of the oracle (lxs 7.2, 7.3). Lobes without width (roughness 0) are not among
// them: kernels keep those apart, and scenes of the oracle have none.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "wavefront/reference_materials.h"

namespace yat::reference {

namespace {

constexpr double kPi = std::numbers::pi;

Vec schlick(const Vec& r0, double cos) {
  return r0 + (1. - r0) * std::pow(std::fmax(1 - cos, 0), 5);
}
Vec head_on(const Vec& ks, float index) {
  return index > 0 ? ks * std::pow((double(index) - 1) / (double(index) + 1), 2) : ks;
}
Vec absorbed(const Vec& ka, float depth, double way) {
  const auto band = [&](double a) { return std::exp(-std::fmin(a * double(depth) * way, 1e6)); };
  return {band(ka.x), band(ka.y), band(ka.z)};
}
double between(double u, double v, const Vec& wo, const Vec& wi, double spread) {
  return std::clamp(
      (1 - lobe_shadowing(u, v, wo.z) * lobe_shadowing(u, v, wi.z)) / (4 * spread * wo.z * wi.z),
      0.0, 1.0);
}
double chance_of_coat(const Vec& coat, const Vec& base) {
  const double c = largest(coat), b = largest(base), share = c + b > 0 ? c / (c + b) : 0;
  return b > 0 ? std::fmin(share, .875) : share;
}
template <class Record>
Bounce weighted(const Record& p, const LocalView& view, const Vec& wi) {
  const double density = pdf(p, view, wi);
  if (!(density > 0)) return {wi, Vec(0.0), 0};
  return {wi, evaluate(p, view, wi) * (std::fabs(wi.z) / density), density};
}

/// A coat as its record has it.
template <class Record>
struct Coat {
  Vec kd, r0, ka;
  double u, v;
  float depth;
  explicit Coat(const Record& p, float least = 0)
      : kd(p.kd_r, p.kd_g, p.kd_b),
        r0(head_on({p.ks_r, p.ks_g, p.ks_b}, p.index)),
        ka(p.ka_r, p.ka_g, p.ka_b),
        u(double(std::max(p.uroughness, least))),
        v(double(std::max(p.vroughness, least))),
        depth(p.depth) {}
  Vec absorption(double way) const { return absorbed(ka, depth, way); }
};

/// What is taken for the albedo of a lobe.
double albedo(double u, double v) {
  return 1 / (1 + 3 * u * v);
}

template <class Record>
double chance(const Record& p, const LocalView& view, float least) {
  if (!view.outside) return 0;
  const Coat coat(p, least);
  const Vec fresnel = schlick(coat.r0, view.wo.z);
  return chance_of_coat(albedo(coat.u, coat.v) * fresnel,
                        coat.absorption(1 + 1 / view.wo.z) * (1. - fresnel) * coat.kd +
                            double(p.multibounce) * fresnel);
}
double chance(const GlossyLossyParameters<Value>& p, const LocalView& view, float) {
  const Coat coat(p);
  const double cos = view.wo.z;
  return chance_of_coat(schlick(coat.r0, cos), coat.absorption(1 + 1 / cos) * (1. - coat.r0) *
                                                   coat.kd *
                                                   (28. / 23 * (1 - std::pow(1 - cos / 2, 5))));
}

template <class Record>
double pdf_of(const Record& p, const LocalView& view, const Vec& wi, float least) {
  if (wi.z <= 0 || view.wo.z <= 0) return 0;
  const Coat coat(p, least);
  const double c = chance(p, view, least);
  return c * lobe_pdf(coat.u, coat.v, view.wo, wi) + (1 - c) * wi.z / kPi;
}
template <class Record>
Bounce sample_of(const Record& p, const LocalView& view, double lobe, double u, double v,
                 float least) {
  const Coat coat(p, least);
  return weighted(p, view,
                  lobe < chance(p, view, least) ? lobe_direction(coat.u, coat.v, view.wo, u, v)
                                                : cosine_hemisphere(u, v));
}

}  // namespace

Vec evaluate(const GlossyParameters<Value>& p, const LocalView& view, const Vec& wi) {
  if (wi.z <= 0 || view.wo.z <= 0) return Vec(0.0);
  const Coat coat(p);
  const Vec base = coat.kd / kPi * oren_nayar(double(p.sigma), view.wo, wi);
  if (!view.outside) return base;
  const Vec s = schlick(coat.r0, glm::dot(wi, glm::normalize(view.wo + wi)));
  return s * (lobe_value(coat.u, coat.v, view.wo, wi) +
              double(p.multibounce) * between(coat.u, coat.v, view.wo, wi, 1)) +
         coat.absorption(1 / wi.z + 1 / view.wo.z) * (1. - s) * base;
}
double pdf(const GlossyParameters<Value>& p, const LocalView& view, const Vec& wi) {
  return pdf_of(p, view, wi, 0);
}
Bounce sample(const GlossyParameters<Value>& p, const LocalView& view, double lobe, double u,
              double v) {
  return sample_of(p, view, lobe, u, v, 0);
}

Vec evaluate(const GlossySingleParameters<Value>& p, const LocalView& view, const Vec& wi) {
  if (wi.z <= 0 || view.wo.z <= 0) return Vec(0.0);
  const Coat coat(p, .006f);
  const Vec s = schlick(coat.r0, glm::dot(wi, glm::normalize(view.wo + wi)));
  const Vec base = coat.absorption(1 / wi.z + 1 / view.wo.z) * (1. - s) * coat.kd / kPi;
  if (!view.outside) return base;
  return base + s * (lobe_value(coat.u, coat.v, view.wo, wi) +
                     double(p.multibounce) * between(coat.u, coat.v, view.wo, wi, kPi));
}
double pdf(const GlossySingleParameters<Value>& p, const LocalView& view, const Vec& wi) {
  return pdf_of(p, view, wi, .006f);
}
Bounce sample(const GlossySingleParameters<Value>& p, const LocalView& view, double lobe, double u,
              double v) {
  return sample_of(p, view, lobe, u, v, .006f);
}

Vec evaluate(const GlossyLossyParameters<Value>& p, const LocalView& view, const Vec& wi) {
  if (wi.z <= 0 || view.wo.z <= 0) return Vec(0.0);
  const Coat coat(p);
  const Vec h = glm::normalize(view.wo + wi);
  const double cos_h = glm::dot(wi, h);
  const auto rim = [](double c) { return 1 - std::pow(1 - c / 2, 5); };
  return 28 / (23 * kPi) * rim(wi.z) * rim(view.wo.z) * coat.kd * (1. - coat.r0) *
             coat.absorption(1 / wi.z + 1 / view.wo.z) +
         schlick(coat.r0, cos_h) *
             (lobe_distribution(coat.u, coat.v, h) / (4 * cos_h * std::fmax(wi.z, view.wo.z)));
}
double pdf(const GlossyLossyParameters<Value>& p, const LocalView& view, const Vec& wi) {
  return pdf_of(p, view, wi, 0);
}
Bounce sample(const GlossyLossyParameters<Value>& p, const LocalView& view, double lobe, double u,
              double v) {
  return sample_of(p, view, lobe, u, v, 0);
}

// ---- A sheet with two coats

namespace {

struct Sheet {
  struct Side {
    Vec r0, ka;
    float depth;
    double u, v, multibounce;
  };
  Side here, there;
  Vec kd, kt;
  double coat = 0, through = 0;  ///< chances
  Sheet(const GlossyTranslucentParameters<Value>& p, const LocalView& view)
      : kd(p.kd_r, p.kd_g, p.kd_b), kt(Vec(p.kt_r, p.kt_g, p.kt_b) * (1. - kd)) {
    const auto rough = [](float r) { return double(std::max(r, .006f)); };
    here = {head_on({p.ks_r, p.ks_g, p.ks_b}, p.index),
            {p.ka_r, p.ka_g, p.ka_b},
            p.depth,
            rough(p.uroughness),
            rough(p.vroughness),
            double(p.multibounce)};
    there = {head_on({p.back_ks_r, p.back_ks_g, p.back_ks_b}, p.back_index),
             {p.back_ka_r, p.back_ka_g, p.back_ka_b},
             p.back_depth,
             rough(p.back_uroughness),
             rough(p.back_vroughness),
             double(p.back_multibounce)};
    if (!view.outside) std::swap(here, there);
    const Vec fresnel = schlick(here.r0, view.wo.z);
    const Vec enters = absorbed(here.ka, here.depth, 1 + 1 / view.wo.z) * (1. - fresnel);
    const double reflected = largest(fresnel), lobe = albedo(here.u, here.v) * reflected;
    const double goes = largest(enters * kt);
    const double rest = goes + largest(enters * kd) + here.multibounce * reflected;
    coat = lobe + rest > 0 ? lobe / (lobe + rest) : 0;
    if (rest > 0) coat = std::fmin(coat, .875);
    through = rest > 0 ? (1 - coat) * goes / rest : 0;
  }
};

}  // namespace

Vec evaluate(const GlossyTranslucentParameters<Value>& p, const LocalView& view, const Vec& wi) {
  if (wi.z == 0 || view.wo.z <= 0) return Vec(0.0);
  const Sheet sheet(p, view);
  const Vec up(wi.x, wi.y, std::fabs(wi.z));
  const double cos_h = glm::dot(view.wo, glm::normalize(view.wo + up));
  const Vec s1 = schlick(sheet.here.r0, cos_h), s2 = schlick(sheet.there.r0, cos_h);
  const Sheet::Side &here = sheet.here, &there = sheet.there;
  if (wi.z < 0)
    return sheet.kt / kPi * glm::sqrt((1. - s1) * (1. - s2)) *
           absorbed(here.ka, here.depth, 1 / view.wo.z) * absorbed(there.ka, there.depth, 1 / up.z);
  return s1 * (lobe_value(here.u, here.v, view.wo, wi) +
               here.multibounce * between(here.u, here.v, view.wo, wi, kPi)) +
         absorbed(here.ka, here.depth, 1 / view.wo.z + 1 / wi.z) * (1. - s1) * sheet.kd / kPi;
}
double pdf(const GlossyTranslucentParameters<Value>& p, const LocalView& view, const Vec& wi) {
  if (view.wo.z <= 0) return 0;
  const Sheet sheet(p, view);
  if (wi.z <= 0) return sheet.through * -wi.z / kPi;
  return sheet.coat * lobe_pdf(sheet.here.u, sheet.here.v, view.wo, wi) +
         (1 - sheet.coat - sheet.through) * wi.z / kPi;
}
Bounce sample(const GlossyTranslucentParameters<Value>& p, const LocalView& view, double lobe,
              double u, double v) {
  const Sheet sheet(p, view);
  if (lobe < sheet.coat) {
    const Vec wi = lobe_direction(sheet.here.u, sheet.here.v, view.wo, u, v);
    return wi.z > 0 ? weighted(p, view, wi) : Bounce{wi, Vec(0.0), 0};
  }
  const Vec w = cosine_hemisphere(u, v);
  return weighted(p, view, lobe < sheet.coat + sheet.through ? Vec(w.x, w.y, -w.z) : w);
}

// ---- Car paint

namespace {

struct Paint {
  Vec kd, ka, ks[3];
  double r[3], m[3], chance[3];
  float depth;
  Paint(const CarPaintParameters<Value>& p, const LocalView& view)
      : kd(p.kd_r, p.kd_g, p.kd_b),
        ka(p.ka_r, p.ka_g, p.ka_b),
        ks{{p.ks1_r, p.ks1_g, p.ks1_b}, {p.ks2_r, p.ks2_g, p.ks2_b}, {p.ks3_r, p.ks3_g, p.ks3_b}},
        r{double(p.r1), double(p.r2), double(p.r3)},
        m{double(p.m1), double(p.m2), double(p.m3)},
        depth(p.depth) {
    double total = largest(absorbed(ka, depth, 1 + 1 / view.wo.z) * kd);
    for (int k = 0; k < 3; ++k) {
      if (!view.outside || m[k] <= 0) ks[k] = Vec(0.0);
      m[k] = std::fmax(m[k], double(kMirrorRoughness));
      total += chance[k] = albedo(m[k], m[k]) * largest(ks[k]) * schlick(Vec(r[k]), view.wo.z).x;
    }
    for (double& c : chance) c = total > 0 ? c / total : 0;
  }
};

}  // namespace

Vec evaluate(const CarPaintParameters<Value>& p, const LocalView& view, const Vec& wi) {
  if (wi.z <= 0 || view.wo.z <= 0) return Vec(0.0);
  const Paint paint(p, view);
  const double cos_h = glm::dot(wi, glm::normalize(view.wo + wi));
  Vec f = absorbed(paint.ka, paint.depth, 1 / wi.z + 1 / view.wo.z) * paint.kd / kPi;
  for (int k = 0; k < 3; ++k)
    f += paint.ks[k] * schlick(Vec(paint.r[k]), cos_h) *
         lobe_value(paint.m[k], paint.m[k], view.wo, wi);
  return f;
}
double pdf(const CarPaintParameters<Value>& p, const LocalView& view, const Vec& wi) {
  if (wi.z <= 0 || view.wo.z <= 0) return 0;
  const Paint paint(p, view);
  double density = 0, base = 1;
  for (int k = 0; k < 3; ++k) {
    density += paint.chance[k] * lobe_pdf(paint.m[k], paint.m[k], view.wo, wi);
    base -= paint.chance[k];
  }
  return density + std::fmax(base, 0) * wi.z / kPi;
}
Bounce sample(const CarPaintParameters<Value>& p, const LocalView& view, double lobe, double u,
              double v) {
  const Paint paint(p, view);
  double end = 0;
  for (int k = 0; k < 3; ++k) {
    end += paint.chance[k];
    if (lobe < end) return weighted(p, view, lobe_direction(paint.m[k], paint.m[k], view.wo, u, v));
  }
  return weighted(p, view, cosine_hemisphere(u, v));
}

}  // namespace yat::reference
