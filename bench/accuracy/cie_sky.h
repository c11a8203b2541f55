#pragma once
// The CIE standard general sky (ISO 15469:2004) over a uniform ground, and what it sends through
// openings, by quadrature. Luminances are per horizontal illuminance of the whole sky.

#include <functional>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace yat::accuracy {

class CieSky {
 public:
  /// type 1..15; sun: unit vector towards it, above the horizon. Throws std::invalid_argument.
  CieSky(int type, const glm::dvec3& sun);
  /// Of the direction d (unit): the sky's above the horizon,
  ///   L ~ (1 + a exp(b / cos Z)) (1 + c (exp(d chi) - exp(d pi / 2)) + e cos^2 chi)
  /// with Z the zenith angle and chi the angle to the sun; below it kGround / pi.
  double luminance(const glm::dvec3& d) const;
  static constexpr double kGround = .3;  ///< albedo of the ground

  /// Writes the luminance as a lat-long picture of 2048 x 1024 texels in floats (.exr), row 0 at
  /// the zenith, columns from +x to +y, each with the value at its middle. Bilinear, it differs
  /// from the formula by less than 2e-5 of it where the sky is smooth.
  void write(const std::string& path) const;

 private:
  double relative(const glm::dvec3& d) const;
  double a_, b_, c_, d_, e_, scale_ = 1;
  glm::dvec3 sun_;
};

/// The rectangle corner + [0, 1] u + [0, 1] v.
struct Rectangle {
  glm::dvec3 corner, u, v;
};
/// An upright box.
struct Block {
  glm::dvec3 least, most;
};

/// Irradiance at p on a surface with normal n from what is seen through the opening: the integral
/// over it of radiance(direction) cos cos / d^2. The radiance may have steps along lines of equal v
/// at the heights `steps` (in 0..1).
double through_opening(const glm::dvec3& p, const glm::dvec3& n, const Rectangle& opening,
                       std::vector<double> steps, int panels,
                       const std::function<double(const glm::dvec3&)>& radiance);

/// Irradiance at p, outside of a black block that stands on the ground, on an upright surface that
/// faces +y: sky and ground around the block.
double upright_irradiance(const CieSky& sky, const glm::dvec3& p, const Block& block);
/// The same on a surface that faces down: the ground.
double underside_irradiance(const glm::dvec3& p, const Block& block);

}  // namespace yat::accuracy
