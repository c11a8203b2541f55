#pragma once
// What a render writes into: one film with its feature pictures, or two half pictures of it.

#include <cstdint>
#include <optional>
#include <vector>

#include "film/features.h"
#include "film/halves.h"
#include "film/output.h"

namespace yat {

class FilmParts {
 public:
  struct Part {
    Film film;
    std::optional<FeatureFilm> features;
    FeatureFilm* features_or_null() { return features ? &*features : nullptr; }
  };

  /// count: 1 or 2.
  FilmParts(uint32_t width, uint32_t height, FeatureSet features, uint32_t count);
  Part& operator[](size_t i) { return parts_[i]; }
  const Part& operator[](size_t i) const { return parts_[i]; }
  uint32_t width() const { return parts_[0].film.width(); }
  uint32_t height() const { return parts_[0].film.height(); }

  FeatureSet features() const { return parts_[0].features ? parts_[0].features->set() : 0; }
  uint64_t total_samples() const;
  size_t bytes() const;
  /// Of two halves; see estimate_noise().
  NoiseEstimate noise(ThreadPool& pool) const {
    return estimate_noise(parts_[0].film, parts_[1].film, weigh, pool);
  }
  /// The picture: width * height * 3, linear Rec.709.
  std::vector<float> resolve() const;
  /// All feature pictures. Light and albedo are weighed as the picture is; depth, position, normals
  /// and the like are the mean of all samples.
  std::vector<PictureLayer> resolve_features() const;

  Weigh weigh = Weigh::kByCount;  ///< of halves

 private:
  std::vector<Part> parts_;
};

}  // namespace yat
