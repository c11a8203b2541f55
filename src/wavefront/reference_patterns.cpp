// Patterns and noise of the oracle.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "kernels/textures/noise_table.h"
#include "wavefront/reference_textures.h"

namespace yat::reference {

namespace {

constexpr double kPi = std::numbers::pi;

double fraction(double x) {
  return x - std::floor(x);
}

Vec in_vec(const StepPlace& place) {
  return {place.in(0, 0), place.in(0, 1), place.in(0, 2)};
}

void choose(StepPlace& place, bool first) {
  place.out(place.colour(first ? 1 : 2));
}

/// Perlin's noise as in lxs A.5: gradients at the eight corners of the cell.
double noise(const Vec& p) {
  const Vec whole = glm::floor(p), t = p - whole;
  const auto table = [](int64_t i) { return int64_t(kNoisePermutation[size_t(i & 255)]); };
  const auto ease = [](double x) { return ((6 * x - 15) * x + 10) * x * x * x; };
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const int64_t dx = corner & 1, dy = corner >> 1 & 1, dz = corner >> 2 & 1;
    const int64_t h =
        table(table(table(int64_t(whole.x) + dx) + int64_t(whole.y) + dy) + int64_t(whole.z) + dz) &
        15;
    const double x = t.x - double(dx), y = t.y - double(dy), z = t.z - double(dz);
    const double a = h < 8 || h == 12 || h == 13 ? x : y, b = h < 4 || h == 12 || h == 13 ? y : z;
    const double weight = (dx ? ease(t.x) : 1 - ease(t.x)) * (dy ? ease(t.y) : 1 - ease(t.y)) *
                          (dz ? ease(t.z) : 1 - ease(t.z));
    sum += weight * ((h & 1 ? -a : a) + (h & 2 ? -b : b));
  }
  return sum;
}

double octaves_of(const Vec& p, double roughness, int octaves, bool magnitudes) {
  double sum = 0;
  for (int k = 0; k < octaves; ++k) {
    const double n = noise(std::pow(double(1.99f), k) * p);
    sum += std::pow(roughness, k) * (magnitudes ? std::fabs(n) : n);
  }
  return sum;
}

}  // namespace

void run_pattern(const CheckerboardParameters<Value>&, StepPlace& place) {
  const Vec f = glm::floor(in_vec(place));
  const double sum = f.x + f.y + (place.form(2) == 1 ? f.z : 0);
  choose(place, std::fmod(std::fabs(sum), 2) == 0);
}

void run_pattern(const BilerpParameters<Value>&, StepPlace& place) {
  const double s = fraction(place.in(0, 0)), t = fraction(place.in(0, 1));
  place.out((1 - s) * (1 - t) * place.colour(1) + (1 - s) * t * place.colour(2) +
            s * (1 - t) * place.colour(3) + s * t * place.colour(4));
}

void run_pattern(const UvColourParameters<Value>&, StepPlace& place) {
  place.out(Vec(fraction(place.in(0, 0)), fraction(place.in(0, 1)), 0));
}

void run_pattern(const UvMaskParameters<Value>&, StepPlace& place) {
  const double s = place.in(0, 0), t = place.in(0, 1);
  choose(place, s >= 0 && s <= 1 && t >= 0 && t <= 1);
}

void run_pattern(const DotsParameters<Value>&, StepPlace& place) {
  const double s = place.in(0, 0), t = place.in(0, 1);
  const double cs = std::floor(s + .5), ct = std::floor(t + .5);
  if (!(noise({cs + .5, ct + .5, .5}) > 0)) return choose(place, false);
  const double x = cs + .15 * noise({cs + 1.5, ct + double(2.8f), .5});
  const double y = ct + .15 * noise({cs + 4.5, ct + double(9.8f), .5});
  choose(place, std::hypot(s - x, t - y) < .35);
}

void run_pattern(const BrickParameters<Value>& p, StepPlace& place) {
  const double mortar = double(p.mortar), border = mortar + double(.001f);
  const Vec size(p.width, p.depth, p.height);
  const Vec at = (in_vec(place) + border) / size + Vec(0, p.offset_y, 0);
  const double course = std::floor(at.z), run = double(p.run);
  const bool brick = fraction(at.x + course * run) > mortar / size.x &&
                     fraction(at.y - course * run) > mortar / size.y &&
                     fraction(at.z) > mortar / size.z;
  place.out(brick ? place.colour(1) * place.colour(3) : place.colour(2));
}

void run_pattern(const HarlequinParameters<Value>&, StepPlace& place) {
  const auto channel = [&](uint32_t k) {
    return double(harlequin_bits(place.at.prim, k) >> 24) / 255;
  };
  place.out(Vec(channel(0), channel(1), channel(2)));
}

void run_pattern(const NoiseParameters<Value>& p, StepPlace& place) {
  const Vec at = in_vec(place);
  if (place.form(3) == 2)
    place.out(0, std::fabs(octaves_of(.1 * at, .5, 3, false)) * octaves_of(at, .5, 6, false));
  else
    place.out(0, octaves_of(at, double(p.roughness), int(p.octaves), place.form(3) == 1));
}

void run_pattern(const MarbleParameters<Value>& p, StepPlace& place) {
  const Vec at = double(p.scale) * in_vec(place);
  const double m =
      at.y + double(p.variation) * octaves_of(at, double(p.roughness), int(p.octaves), false);
  const double t = (.5 + .5 * std::sin(m)) * 6;
  const int segment = std::clamp(int(std::floor(t)), 0, 5);
  // De Casteljau.
  Vec c[4];
  for (int k = 0; k < 4; ++k)
    for (int channel = 0; channel < 3; ++channel)
      c[k][channel] = double(kMarbleColours[channel][segment + k]);
  for (int round = 3; round > 0; --round)
    for (int k = 0; k < round; ++k) c[k] += (t - segment) * (c[k + 1] - c[k]);
  place.out(1.5 * c[0]);
}

void run_pattern(const BlenderParameters<Value>& p, StepPlace& place) {
  const Vec at = in_vec(place);
  const uint32_t type = place.variant >> 8 & 15;
  const bool hard = (place.variant & kBlenderHard) != 0;
  const auto shape = BlenderWave(place.variant >> 13 & 3);
  const auto unit_noise = [&](const Vec& q) { return .5 + .5 * noise(q / double(p.size)); };
  const auto shown = [&](double n) { return hard ? std::fabs(2 * n - 1) : n; };
  const auto turbulence = [&] {
    const int depth = int(p.depth);
    double sum = 0;
    for (int k = 0; k <= depth; ++k)
      sum += shown(unit_noise(std::ldexp(1, k) * at)) / std::ldexp(1, k);
    return sum * std::ldexp(1, depth) / (std::ldexp(1, depth + 1) - 1);
  };
  const auto wave = [&](double a) {
    const double turn = fraction(a / (2 * kPi));
    if (shape == BlenderWave::kSaw) return turn;
    return shape == BlenderWave::kTriangle ? std::fabs(2 * turn - 1) : .5 + .5 * std::sin(a);
  };
  double v = 0;
  switch (place.form(5)) {
    case 0:
      v = turbulence();
      break;
    case 1:
      v = type == 0 || type == 2 ? 10 * (at.x + at.y + at.z) : 20 * glm::length(at);
      if (type >= 2) v += double(p.turbulence) * shown(unit_noise(at));
      v = wave(v);
      break;
    case 2:
      v = std::pow(wave(5 * (at.x + at.y + at.z) + double(p.turbulence) * turbulence()),
                   type == 0   ? 1
                   : type == 1 ? .5
                               : .25);
      break;
    case 3: {
      const bool flip = (place.variant & kBlenderFlip) != 0;
      const double x = flip ? at.y : at.x, y = flip ? at.x : at.y, ramp = (1 + x) / 2;
      const double t = std::clamp(ramp, 0., 1.), ball = std::max(0., 1 - glm::length(at));
      const double shapes[] = {
          ramp,        ramp < 0 ? 0 : ramp * ramp,       t * t * (3 - 2 * t), (2 + x + y) / 4, ball,
          ball * ball, std::atan2(y, x) / (2 * kPi) + .5};
      v = shapes[type];
      break;
    }
    default: {
      double way = double(p.turbulence) / 200;
      if (type >= 1) way *= unit_noise(at) * unit_noise(at);
      // The way counts in cells of the noise.
      v = .5 + .5 * noise(Vec(at.x, at.y, at.z + way) / double(p.size));
      place.out(0, type == 2 ? 1 - v : v);
      return;
    }
  }
  place.out(0, std::clamp((v - .5) * double(p.contrast) + double(p.bright) - .5, 0., 1.));
}

}  // namespace yat::reference
