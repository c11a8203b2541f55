#pragma once
// Feature pictures (AOVs) beside the radiance: what the camera sees at first, and parts of the
// light. Only those that are asked for take memory and time. Sums are exact as the film's, so that
// these pictures do not depend on threads either (invariant 3).
//
// A sample's features are those of the first surface that scatters (null surfaces are not there),
// with the sample's filter weight. Denoisers expect them noisy where the radiance is: they are not
// made smoother than it.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "film/film.h"

namespace yat {

enum class Feature : uint32_t {
  kAlbedo,           ///< albedo.R .G .B: share of light that the surface scatters, linear Rec.709
  kNormal,           ///< normal.X .Y .Z: shading normal, world space, on the viewer's side
  kGeometricNormal,  ///< geometric_normal.X .Y .Z
  kDepth,            ///< Z: distance from the camera [m]
  kPosition,         ///< position.X .Y .Z: world space [m]
  kUv,               ///< uv.U .V: texture coordinates
  kDirect,           ///< direct.R .G .B: emission seen, and light scattered once
  kIndirect,         ///< indirect.R .G .B: light scattered more than once
  kVariance,         ///< variance.R .G .B: of a sample; over sample_count, of the pixel
  kSampleCount,      ///< sample_count
  kObjectId,         ///< object_id: a number per object, from 1 on; 0 in the background
  kMaterialId,       ///< material_id: the same per material
  kCount
};
inline constexpr uint32_t kFeatures = uint32_t(Feature::kCount);

/// Where a feature shows nothing: samples of the background count as zeros (albedo, normals), or
/// not at all (depth, position, uv), which then hold the mean of the samples that hit. Numbers of
/// things have no mean: they are those of the first sample that hit.
enum class FeatureMean { kOverSamples, kOverHits, kOfFirstHit };

struct FeatureInfo {
  std::string_view name;      ///< as on the command line
  std::string_view channels;  ///< comma-separated, as in the EXR
  uint32_t count;             ///< of channels: 1, 2 or 3
  FeatureMean mean;
  float background;  ///< value of a pixel without a hit
};
const FeatureInfo& feature_info(Feature feature);

/// Bit per Feature.
using FeatureSet = uint32_t;
constexpr FeatureSet feature_bit(Feature feature) {
  return 1u << uint32_t(feature);
}

/// "albedo,normal" or "all"; throws UsageError for an unknown name.
FeatureSet parse_features(std::string_view option, std::string_view list);
std::string feature_names(FeatureSet set);

/// The sums of one feature, a row per pixel. Thread safety as Film's.
class FeaturePlane {
 public:
  explicit FeaturePlane(size_t pixels) : sums_(pixels) {}
  /// Adds one sample's value; counted as a hit. Values beyond kLargestSample are clamped, NaN is 0.
  void add(size_t pixel, float x, float y, float z) noexcept;
  const FilmPixel& at(size_t pixel) const { return sums_[pixel]; }
  void merge(const FeaturePlane& other);
  size_t bytes() const { return sums_.size() * sizeof(FilmPixel); }

 private:
  std::vector<FilmPixel> sums_;  ///< `samples`: hits
};

/// Numbers of what a pixel shows: of its first sample that hit anything, whatever the order in
/// which samples come.
class IdPlane {
 public:
  struct Ids {
    uint32_t sample = 0xffffffffu, object = 0, material = 0;
  };
  explicit IdPlane(size_t pixels) : ids_(pixels) {}
  void add(size_t pixel, const Ids& ids) noexcept {
    if (ids.sample < ids_[pixel].sample) ids_[pixel] = ids;
  }
  const Ids& at(size_t pixel) const { return ids_[pixel]; }
  void merge(const IdPlane& other) {
    for (size_t i = 0; i < ids_.size(); ++i) add(i, other.ids_[i]);
  }
  size_t bytes() const { return ids_.size() * sizeof(Ids); }

 private:
  std::vector<Ids> ids_;
};

/// All features that are asked for.
class FeatureFilm {
 public:
  FeatureFilm(uint32_t width, uint32_t height, FeatureSet set);
  FeatureSet set() const { return set_; }
  bool has(Feature feature) const { return set_ & feature_bit(feature); }
  bool has_ids() const { return has(Feature::kObjectId) || has(Feature::kMaterialId); }
  IdPlane& ids() { return ids_; }
  /// Precondition: has(feature), and neither kSampleCount, which the film itself knows, nor an id.
  FeaturePlane& plane(Feature feature) { return planes_[place_[uint32_t(feature)]]; }
  const FeaturePlane& plane(Feature feature) const { return planes_[place_[uint32_t(feature)]]; }
  /// Throws std::invalid_argument when sizes or sets differ.
  void merge(const FeatureFilm& other);
  size_t bytes() const;

  /// One picture: width * height * count channels, in the order of feature_info().channels. `film`
  /// holds the samples that the features belong to.
  std::vector<float> resolve(Feature feature, const Film& film) const;

 private:
  uint32_t width_, height_;
  FeatureSet set_;
  uint32_t place_[kFeatures] = {};
  std::vector<FeaturePlane> planes_;
  IdPlane ids_;  ///< empty without has_ids()
};

}  // namespace yat
