// Diffuse materials of the oracle (lxs 7.2, 7.5).

#include <algorithm>
#include <cmath>
#include <numbers>

#include "wavefront/reference_materials.h"

namespace yat::reference {

namespace {

constexpr double kPi = std::numbers::pi;

template <class Record>
Vec kd(const Record& p) {
  return {p.kd_r, p.kd_g, p.kd_b};
}

/// A sample with weight f |cos| / pdf, black where there is no density.
template <class Record>
Bounce weighted(const Record& p, const LocalView& view, const Vec& wi) {
  const double density = pdf(p, view, wi);
  if (!(density > 0) || wi.z == 0) return {wi, Vec(0.0), 0};
  return {wi, evaluate(p, view, wi) * (std::fabs(wi.z) / density), density};
}

}  // namespace

double oren_nayar(double sigma, const Vec& wo, const Vec& wi) {
  const double s = std::clamp(sigma, 0.0, 90.0) * kPi / 180, s2 = s * s;
  const double a = 1 - s2 / (2 * (s2 + .33)), b = .45 * s2 / (s2 + .09);
  const double theta_o = std::acos(std::clamp(wo.z, 0.0, 1.0));
  const double theta_i = std::acos(std::clamp(wi.z, 0.0, 1.0));
  const double phi = std::atan2(wo.y, wo.x) - std::atan2(wi.y, wi.x);
  return a + b * std::fmax(0, std::cos(phi)) * std::sin(std::fmax(theta_o, theta_i)) *
                 std::tan(std::fmin(theta_o, theta_i));
}

// ---- Matte

Vec evaluate(const MatteParameters<Value>& p, const LocalView&, const Vec& wi) {
  return wi.z > 0 ? kd(p) / kPi : Vec(0.0);
}
double pdf(const MatteParameters<Value>&, const LocalView&, const Vec& wi) {
  return std::fmax(wi.z, 0) / kPi;
}
Bounce sample(const MatteParameters<Value>& p, const LocalView& view, double, double u, double v) {
  return weighted(p, view, cosine_hemisphere(u, v));
}

Vec evaluate(const OrenNayarParameters<Value>& p, const LocalView& view, const Vec& wi) {
  return wi.z > 0 ? kd(p) / kPi * oren_nayar(double(p.sigma), view.wo, wi) : Vec(0.0);
}
double pdf(const OrenNayarParameters<Value>&, const LocalView&, const Vec& wi) {
  return std::fmax(wi.z, 0) / kPi;
}
Bounce sample(const OrenNayarParameters<Value>& p, const LocalView& view, double, double u,
              double v) {
  return weighted(p, view, cosine_hemisphere(u, v));
}

// ---- A sheet: reflection and transmission

namespace {

struct Sheet {
  Vec reflected, transmitted;
  double chance;  ///< of reflection
  explicit Sheet(const MatteTranslucentParameters<Value>& p)
      : reflected(p.kr_r, p.kr_g, p.kr_b), transmitted(p.kt_r, p.kt_g, p.kt_b) {
    if (p.conserve != 0) transmitted *= Vec(1.0) - reflected;
    const double total = largest(reflected) + largest(transmitted);
    chance = total > 0 ? largest(reflected) / total : 1;
  }
};

}  // namespace

Vec evaluate(const MatteTranslucentParameters<Value>& p, const LocalView& view, const Vec& wi) {
  if (wi.z == 0) return Vec(0.0);
  const Sheet sheet(p);
  const double rough = oren_nayar(double(p.sigma), view.wo, {wi.x, wi.y, std::fabs(wi.z)});
  return (wi.z > 0 ? sheet.reflected : sheet.transmitted) / kPi * rough;
}
double pdf(const MatteTranslucentParameters<Value>& p, const LocalView&, const Vec& wi) {
  const double chance = Sheet(p).chance;
  return (wi.z > 0 ? chance : 1 - chance) * std::fabs(wi.z) / kPi;
}
Bounce sample(const MatteTranslucentParameters<Value>& p, const LocalView& view, double lobe,
              double u, double v) {
  const Vec w = cosine_hemisphere(u, v);
  return weighted(p, view, lobe < Sheet(p).chance ? w : Vec(w.x, w.y, -w.z));
}

// ---- Velvet

Vec evaluate(const VelvetParameters<Value>& p, const LocalView& view, const Vec& wi) {
  if (wi.z <= 0) return Vec(0.0);
  const double c = -glm::dot(view.wo, wi);
  const double phase = (1 + double(p.p1) * c + double(p.p2) * .5 * (3 * c * c - 1) +
                        double(p.p3) * .5 * (5 * c * c * c - 3 * c)) /
                       (4 * kPi);
  return kd(p) * (std::clamp(phase * double(p.thickness) / view.wo.z, 0.0, 1.0) / wi.z);
}
double pdf(const VelvetParameters<Value>&, const LocalView&, const Vec& wi) {
  return wi.z > 0 ? 1 / (2 * kPi) : 0;
}
Bounce sample(const VelvetParameters<Value>& p, const LocalView& view, double, double u, double v) {
  return weighted(p, view, cone(1, u, v));
}

// ---- Scatter

namespace {

double schlick_k(double g) {
  return 1.55 * g - .55 * g * g * g;
}

}  // namespace

double pdf(const ScatterParameters<Value>& p, const LocalView& view, const Vec& wi) {
  const double k = schlick_k(std::clamp(double(p.g), -.999, .999));
  return (1 - k * k) / (4 * kPi * std::pow(1 - k * glm::dot(-view.wo, wi), 2));
}
Vec evaluate(const ScatterParameters<Value>& p, const LocalView& view, const Vec& wi) {
  return wi.z == 0 ? Vec(0.0) : kd(p) * (pdf(p, view, wi) / std::fabs(wi.z));
}
Bounce sample(const ScatterParameters<Value>& p, const LocalView& view, double, double u,
              double v) {
  const double k = schlick_k(std::clamp(double(p.g), -.999, .999));
  const double cos = (2 * u - 1 + k) / (1 - k + 2 * k * u);
  const double sin = std::sqrt(std::fmax(0, 1 - cos * cos)), phi = 2 * kPi * v;
  return weighted(p, view,
                  Axes(-view.wo).to_scene({sin * std::cos(phi), sin * std::sin(phi), cos}));
}

}  // namespace yat::reference
